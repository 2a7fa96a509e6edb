//! Texts with very many mistakes: the work grows with their number, not with its square.

use super::found;

/// Names that mean nothing are compared with what there is for the first hundred only, and each once.
#[test]
fn a_name_is_suggested_only_while_few_are_unknown() {
    let unknown = |count: usize| -> String {
        let lines = (0..count).map(|i| format!("(defun f{i} (x) (lenth{i} x))\n"));
        lines.collect()
    };
    let text = unknown(300) + "(defun last-one (x) (lenght x))\n";
    let found_all = found("a.plan", &text);
    assert_eq!(found_all.len(), 301);
    let suggested = found_all
        .iter()
        .filter(|text| text.contains("did you mean"));
    assert!(suggested.count() <= 100);
    assert_eq!(
        found_all[300],
        "301:22: The function LENGHT is not defined."
    );
    let few = unknown(3) + "(defun last-one (x) (lenght x))\n";
    assert_eq!(
        found("a.plan", &few)[3],
        "4:22: The function LENGHT is not defined; did you mean LENGTH?"
    );
}

#[test]
fn many_uses_of_one_name_are_all_found() {
    let lines = (0..3000).map(|i| format!("(defun f{i} (x) (lenght x {i}))\n"));
    let text: String = lines.collect();
    let found = found("a.plan", &text);
    assert_eq!(found.len(), 3000);
    assert!(
        found
            .iter()
            .all(|text| text.ends_with("did you mean LENGTH?"))
    );
}

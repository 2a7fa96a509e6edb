//! Who uses what, and what is traced, restarted and expanded on request.

use super::client::{Client, Served, quoted};

/// The labels and places that `xref` tells for a name in a package.
fn users(client: &mut Client, kind: &str, name: &str) -> String {
    client.call_in("PP-TUT", &format!("(swank:xref '{kind} {})", quoted(name)))
}

#[test]
fn uses_are_found_in_code() {
    let served = Served::start();
    let mut client = served.client();
    let define = "(in-package :pp-tut) (defvar *sum* 0) (defun add (a) (incf *sum* a)) \
                  (defun add-all (as) (mapc #'add as) (flet ((again (a) (add a))) (again 1))) \
                  (defun bound () (let ((*sum* 1)) (add 1))) \
                  (defclass tool () ()) (defmethod used ((tool tool) (n (eql 1))) (add n)) \
                  (defun go-there (?p) (perform (an action (type going) (target ?p))))";
    client.shown(define);
    let mut labels = |kind: &str, name: &str| {
        let told = users(&mut client, kind, name);
        let items = told.split("((\"").flat_map(|part| part.split(") (\""));
        let items = items.filter_map(|item| item.split_once("\" (:location"));
        items.map(|(label, _)| label.to_owned()).collect::<Vec<_>>()
    };
    assert_eq!(
        labels(":calls", "add"),
        ["ADD-ALL", "ADD-ALL", "(METHOD USED (TOOL 1))", "BOUND"]
    );
    assert_eq!(labels(":callers", "pp-tut::bound"), Vec::<String>::new());
    assert_eq!(labels(":calls-who", "bound"), ["ADD"]);
    assert_eq!(labels(":references", "*sum*"), ["ADD"]);
    assert_eq!(labels(":sets", "*sum*"), ["ADD"]);
    assert_eq!(labels(":binds", "*sum*"), ["BOUND"]);
    assert_eq!(labels(":specializes", "tool"), ["(METHOD USED (TOOL 1))"]);
    assert!(labels(":calls", "going").contains(&"(DEFUN GO-THERE)".to_owned()));
    assert!(
        labels(":macroexpands", "cpl:with-retry-counters")
            .contains(&"(DEF-ACTION LOOKING)".to_owned())
    );
}

#[test]
fn what_is_not_known_about_uses_is_said() {
    let served = Served::start();
    let mut client = served.client();
    let mut told = |kind: &str, name: &str| users(&mut client, kind, name);
    assert_eq!(told(":calls", "no-such-name"), "(:ok nil)");
    assert_eq!(told(":calls", "no-such-package:f"), "(:ok nil)");
    assert_eq!(told(":calls", ""), "(:ok nil)");
    assert!(told(":calls", "car").starts_with("(:abort \"calls of it are compiled in place"));
    assert_eq!(
        told(":dreams-of", "car"),
        "(:abort \"planwright has no cross references for dreams-of\")"
    );
    for form in ["(swank:xref)", "(swank:xref 5 5)"] {
        let told = client.call(form);
        assert!(told.starts_with("(:abort"), "{told}");
    }
    assert_eq!(
        client.call("(swank:xrefs '(:calls :sets :dreams-of) \"car\")"),
        "(:ok nil)"
    );
    assert_eq!(client.call("(swank:xrefs 5 nil)"), "(:ok nil)");
}

#[test]
fn traces_are_toggled() {
    let served = Served::start();
    let mut client = served.client();
    client.shown("(in-package :pp-tut)");
    let mut toggled = |form: &str| client.call_in("PP-TUT", form);
    let toggle = "(swank:swank-toggle-trace \"going\")";
    assert_eq!(toggled(toggle), "(:ok \"GOING is now traced.\")");
    assert_eq!(
        toggled("(swank-trace-dialog:dialog-toggle-trace (swank::from-string \"going\"))"),
        "(:ok \"GOING is no longer traced.\")"
    );
    toggled(toggle);
    assert_eq!(toggled("(swank:untrace-all)"), "(:ok nil)");
    assert_eq!(client.shown("(trace)"), "NIL\n");
    assert_eq!(
        client.call("(swank:swank-toggle-trace nil)"),
        "(:abort \"a name is needed\")"
    );
}

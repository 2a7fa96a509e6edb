//! Random plans: each ends, twice in the same way.

use super::prompt::Prompt;
use proptest::prelude::*;

/// Forms without parts; `N` and `M` stand for small numbers.
const LEAVES: &[&str] = &[
    "(progn (princ N) N)",
    "(sleep N/10)",
    "(fail 'f1)",
    "(fail 'f3)",
    "(error \"lisp\")",
    "(setf (value fN) t)",
    "(setf (value fN) nil)",
    "(pulse fN)",
    "(wait-for fN)",
    "(wait-for fN :timeout M/10)",
    "(wait-for (pulsed fN))",
    "(wait-for (fl-or fN (not fM)))",
    "(evaporate tN)",
    "(suspend tN)",
    "(wake-up tN)",
    "(progn (princ (value (status t0))) (princ (value (status tN))))",
    "(return N)",
];

/// Forms with parts: `A`, `B` and `C` stand for other forms.
const BRANCHES: &[&str] = &[
    "(seq A B)",
    "(par A B)",
    "(par A B C)",
    "(pursue A B)",
    "(try-all A B)",
    "(try-in-order A B)",
    "(without-scheduling A)",
    "(par-loop (x '(1 2)) A)",
    "(with-failure-handling ((f1 (e) (princ :h1)) (error (e) (return (princ :he)))) A)",
    "(with-failure-handling ((plan-failure (e) (do-retry c (retry)) (return :given-up))) A B)",
    "(on-suspension (princ :s) A)",
    "(handler-case A (f3 () B))",
    "(unwind-protect A (princ :c) B)",
    "(:tag tN A)",
    "(with-task-suspended (tN) A)",
];

/// A plan with a few fluents, tags and marks in the output.
fn forms() -> BoxedStrategy<String> {
    let leaf = (0..LEAVES.len(), 0..3, 0..3)
        .prop_map(|(i, n, m)| filled(LEAVES[i], n, m))
        .boxed();
    leaf.prop_recursive(5, 40, 3, |inner| {
        (0..BRANCHES.len(), 0..3, prop::collection::vec(inner, 3))
            .prop_map(|(i, n, parts)| {
                filled(BRANCHES[i], n, n)
                    .replace('A', &parts[0])
                    .replace('B', &parts[1])
                    .replace('C', &parts[2])
            })
            .boxed()
    })
    .boxed()
}

fn filled(form: &str, n: i32, m: i32) -> String {
    form.replace('N', &n.to_string())
        .replace('M', &m.to_string())
}

fn run(plan: &str) -> String {
    let text = format!(
        "(let ((f0 (make-fluent :name 'f0)) (f1 (make-fluent :name 'f1 :value t)) (f2 (make-fluent :name 'f2)))
           (with-retry-counters ((c 3))
             (tl (with-tags {plan}))))"
    );
    let mut prompt = Prompt::new();
    let mut shown = prompt.eval(&text);
    assert!(
        prompt.scheduler.tasks(&prompt.image).is_empty(),
        "tasks are left over of {plan}"
    );
    shown.push_str(&format!(" at {}", prompt.scheduler.now(&prompt.image)));
    shown.push_str(&prompt.eval("*current-task*"));
    shown
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn a_plan_ends_and_ends_the_same_way_again(plan in forms()) {
        let first = run(&plan);
        prop_assert!(!first.contains("unreachable"), "{plan}\n{first}");
        prop_assert!(first.ends_with("NIL"), "{plan}\n{first}");
        prop_assert_eq!(first, run(&plan), "{}", plan);
    }
}

//! Warnings at the prompt, from `load` and from `compile`.

use std::fs;

use crate::dialogue::screen::input_name;
use crate::dialogue::{Evaluate, Event, Outcome};
use crate::{Session, SessionOptions};

/// What the inputs print, values left out.
fn printed(inputs: &[&str]) -> Vec<String> {
    let mut session = Session::new(&SessionOptions::default()).unwrap();
    let mut all = Vec::new();
    for (number, input) in inputs.iter().enumerate() {
        let mut text = String::new();
        session.evaluate(&input_name(number + 1), input, &mut |event| match event {
            Event::Output(output) => text.push_str(&output),
            Event::Values(values) => text.push_str(&format!("=> {}\n", values.join(" ; "))),
            Event::Aborted(abort) => text.push_str(&format!("!! {}\n", abort.report)),
            _ => {}
        });
        all.push(text);
    }
    all
}

fn check(cases: &[(&str, &str)]) {
    let inputs: Vec<&str> = cases.iter().map(|(input, _)| *input).collect();
    let printed = printed(&inputs);
    let mut wrong = Vec::new();
    for ((input, expected), printed) in cases.iter().zip(printed) {
        if printed != *expected {
            wrong.push(format!(
                "{input}\n  expected {expected:?}\n  printed  {printed:?}"
            ));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_definition_at_the_prompt_is_judged() {
    check(&[
        ("(defun f (x) (* x 2))", "=> F\n"),
        (
            "(defun g (x) (lenght x))",
            "STYLE-WARNING: The function LENGHT is not defined; did you mean LENGTH?\n=> G\n",
        ),
        (
            "(defun h (x y) (f x))",
            "STYLE-WARNING: The variable Y is never used.\n=> H\n",
        ),
        (
            "(defun h (x)\n  (f x 2))",
            "WARNING: F takes 1 argument, but is called with 2.\n; at line 2, column 3\n=> H\n",
        ),
        (
            "(defun h (x) (setq x 2) nil)",
            "STYLE-WARNING: The variable X is assigned but never read.\n=> H\n",
        ),
        (
            "(defun h () (print nowhere))",
            "WARNING: The variable NOWHERE is unbound.\n=> H\n",
        ),
        (
            "(defun h () (handler-case (f 1) (nope () 1)))",
            "WARNING: There is no type NOPE.\n=> H\n",
        ),
        // What is defined later in the same input, or ignored on purpose, is right.
        (
            "(defun even (n) (odd n)) (defun odd (n) (even n))",
            "=> EVEN\n=> ODD\n",
        ),
        ("(defun k (x) (declare (ignore x)) 1)", "=> K\n"),
        ("(defun k (_x) 1)", "=> K\n"),
        ("(defun k (n) (if (= n 0) 1 (k (- n 1))))", "=> K\n"),
        // What is evaluated reports its mistakes itself.
        ("(list (f 1))", "=> (2)\n"),
        (
            "(undefined-thing)",
            "!! The function COMMON-LISP-USER::UNDEFINED-THING is undefined.\n",
        ),
        ("(eval '(defun z (x) (nowhere)))", "=> Z\n"),
    ]);
}

#[test]
fn compile_says_whether_there_were_warnings() {
    check(&[
        (
            "(progn (compile 'sq '(lambda (x) (* x x))) (multiple-value-list (compile 'sq '(lambda (x) (* x x)))))",
            "=> (SQ NIL NIL)\n",
        ),
        (
            "(rest (multiple-value-list (compile nil '(lambda (x) 1))))",
            "STYLE-WARNING: The variable X is never used.\n=> (T NIL)\n",
        ),
        (
            "(rest (multiple-value-list (compile nil '(lambda () (car 1 2)))))",
            "WARNING: CAR takes 1 argument, but is called with 2.\n=> (T T)\n",
        ),
        (
            "(handler-bind ((warning #'muffle-warning)) (functionp (compile nil '(lambda (x) 1))))",
            "=> T\n",
        ),
    ]);
}

#[test]
fn load_warns_with_the_places_of_the_file() {
    let folder = std::env::temp_dir().join(format!("planwright-warnings-{}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    let path = folder.join("a.plan");
    fs::write(
        &path,
        "(defun first-one (x)\n  (second-one x))\n(defun second-one (y)\n  (third-one y))\n(defun idle (z)\n  (print 1))\n",
    )
    .unwrap();
    let name = path.display().to_string();
    let form = format!("(load {name:?})");
    let expected = format!(
        "STYLE-WARNING: The variable Z is never used.\n; at {name}:5:14\n\
         STYLE-WARNING: The function THIRD-ONE is not defined.\n; at {name}:4:4\n=> T\n"
    );
    let muffled = format!("(handler-bind ((warning #'muffle-warning)) (load {name:?}))");
    let printed = printed(&[&form, &muffled]);
    fs::remove_dir_all(&folder).unwrap();
    assert_eq!(printed[0], expected);
    assert_eq!(printed[1], "=> T\n");
}

#[test]
fn a_warning_does_not_stop_the_evaluation() {
    let mut session = Session::new(&SessionOptions::default()).unwrap();
    let outcome = session.evaluate(&input_name(1), "(defun f (x) (g))", &mut |_| {});
    assert_eq!(outcome, Outcome::Finished);
}

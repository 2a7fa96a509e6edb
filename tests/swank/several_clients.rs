//! Several clients of one session.

use super::client::Served;

#[test]
fn each_client_has_its_package_and_values() {
    let served = Served::start();
    let (mut one, mut two) = (served.client(), served.client());
    one.shown("(in-package :pp-tut)");
    one.shown("(+ 1 2)");
    two.shown("(+ 3 4)");
    assert_eq!(one.shown("*"), "3\n");
    assert_eq!(two.shown("*"), "7\n");
    assert_eq!(two.shown("*package*"), "#<PACKAGE \"COMMON-LISP-USER\">\n");
    assert_eq!(
        one.shown("*package*"),
        "#<PACKAGE \"CRAM-PICK-PLACE-TUTORIAL\">\n"
    );
    // The session is one.
    one.shown("(defparameter cl-user::*shared* 5)");
    assert_eq!(two.shown("*shared*"), "5\n");
}

#[test]
fn names_are_known_while_another_client_evaluates() {
    let served = Served::start();
    let (mut busy, mut idle) = (served.client(), served.client());
    busy.begin("(loop)");
    assert_eq!(
        idle.call("(swank:operator-arglist \"car\" \"CL-USER\")"),
        "(:ok \"(car list)\")"
    );
    assert!(
        busy.call("(swank:completions \"mapc\" nil)")
            .contains("\"mapcar\"")
    );
    // An evaluation waits; an interrupt takes it back and leaves the other one alone.
    let waiting = idle.type_in("(+ 1 1)");
    idle.send("(:emacs-interrupt :repl-thread)");
    assert_eq!(
        idle.answer(waiting).last().unwrap(),
        &format!("(:return (:abort \"NIL\") {waiting})")
    );
    assert!(
        busy.call("(swank:completions \"mapc\" nil)")
            .contains("\"mapcar\"")
    );
    busy.send("(:emacs-interrupt :repl-thread)");
    busy.until("(:debug-activate 1 1 nil)");
    // Others may look around meanwhile.
    assert_eq!(idle.shown("(+ 1 1)"), "2\n");
    busy.call("(swank:throw-to-toplevel)");
    assert_eq!(idle.shown("(+ 1 1)"), "2\n");
}

#[test]
fn nobody_decides_for_another_client() {
    let served = Served::start();
    let (mut one, mut two) = (served.client(), served.client());
    let first = one.type_in("(car 1)");
    one.until("(:debug-activate 1 1 nil)");
    assert!(
        two.call("(swank:throw-to-toplevel)")
            .starts_with("(:abort \"another client")
    );
    let second = two.type_in("(car 2)");
    two.until("(:debug-activate 1 2 nil)");
    assert!(
        one.call("(swank:throw-to-toplevel)")
            .starts_with("(:abort \"another client")
    );
    two.request("(swank:throw-to-toplevel)");
    two.answer(second);
    assert_eq!(two.shown("(+ 1 1)"), "2\n");
    one.request("(swank:throw-to-toplevel)");
    one.answer(first);
    assert_eq!(one.shown("(+ 1 1)"), "2\n");
}

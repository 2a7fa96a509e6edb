//! What a client asks from its first message on.

use super::client::{Client, Served, quoted, shown};
use crate::swank::{Ended, ServerOptions, Version};

#[test]
fn a_client_connects_and_evaluates() {
    let served = Served::start();
    let mut client = served.stranger();
    let info = client.call("(swank:connection-info)");
    assert!(info.contains(":style :spawn"), "{info}");
    assert!(info.contains(":version \"2.27\""), "{info}");
    assert_eq!(
        client.call("(swank:swank-require '(swank-indentation swank-repl))"),
        "(:ok (\"SWANK-INDENTATION\" \"SWANK-REPL\"))"
    );
    assert_eq!(
        client.call("(swank-repl:create-repl nil :coding-system \"utf-8-unix\")"),
        "(:ok (\"COMMON-LISP-USER\" \"CL-USER\"))"
    );
    assert_eq!(client.shown("(+ 1 2) (values 1 \"ü\")"), "3\n1\n\"ü\"\n");
    assert_eq!(client.shown("(values)"), "; No value\n");
    assert_eq!(
        client.shown("(progn (princ \"äöü→ π 𝒳\") 1)"),
        "äöü→ π 𝒳\n1\n"
    );
    assert_eq!(client.shown("* **"), "1\n1\n");
    let id = client.type_in("(in-package :pp-tut)");
    let messages = client.answer(id);
    assert!(
        messages.contains(&"(:new-package \"CRAM-PICK-PLACE-TUTORIAL\" \"PP-TUT\")".to_owned()),
        "{messages:?}"
    );
    assert_eq!(
        client.shown("*package*"),
        "#<PACKAGE \"CRAM-PICK-PLACE-TUTORIAL\">\n"
    );
}

#[test]
fn values_can_be_pointed_at() {
    let served = Served::start();
    let mut client = served.client();
    client.call("(swank:init-presentations)");
    let id = client.type_in("(list 1 2)");
    let messages = client.answer(id);
    assert_eq!(messages[0], "(:presentation-start 0 :repl-result)");
    assert_eq!(messages[2], "(:presentation-end 0 :repl-result)");
    let inspected = client.call("(swank:inspect-presentation '0 t)");
    assert!(inspected.contains("(:value \"2\" 1)"), "{inspected}");
    let part = client.call("(swank:inspect-nth-part 1)");
    assert!(part.contains(":title \"2, of type"), "{part}");
    let back = client.call("(swank:inspector-pop)");
    assert_eq!(back.replace(' ', ""), inspected.replace(' ', ""));
    assert_eq!(client.call("(swank:inspector-pop)"), "(:ok nil)");
    assert_eq!(
        client.call("(swank:inspector-eval \"(length *)\")"),
        "(:ok \"=> 2\")"
    );
    assert_eq!(client.call("(swank:quit-inspector)"), "(:ok nil)");
    assert_eq!(
        client.call("(swank:inspect-presentation '77 t)"),
        "(:abort \"the value is no longer known\")"
    );
}

#[test]
fn names_are_completed_and_explained() {
    let served = Served::start();
    let mut client = served.client();
    client.shown("(defun add (left &key (right 1)) \"Adds two numbers.\" (+ left right))");
    for (form, answer) in [
        (
            "(swank:autodoc '(\"add\" \"\" swank::%cursor-marker%) :print-right-margin 80)",
            "(:ok (\"(add ===> left <=== &key (right 1))\" t))",
        ),
        (
            "(swank:autodoc '(\"no-such\" swank::%cursor-marker%))",
            "(:ok (:not-available t))",
        ),
        ("(swank:autodoc 5)", "(:ok (:not-available t))"),
        (
            "(swank:operator-arglist \"add\" \"CL-USER\")",
            "(:ok \"(add left &key (right 1))\")",
        ),
        ("(swank:operator-arglist \"no-such\" nil)", "(:ok nil)"),
        (
            "(swank:completions \"m-v-b\" '\"CL-USER\")",
            "(:ok ((\"multiple-value-bind\") \"multiple-value-bind\"))",
        ),
        (
            "(swank:completions \"cl:CADD\" '\"CL-USER\")",
            "(:ok ((\"cl:CADDAR\" \"cl:CADDDR\" \"cl:CADDR\") \"cl:CADD\"))",
        ),
        (
            "(swank:completions-for-keyword \":r\" '(\"add\" \"1\" \":r\" swank::%cursor-marker%))",
            "(:ok ((\":right\") \":right\"))",
        ),
        (
            "(swank:fuzzy-completions \"mvbin\" \"CL-USER\" :limit 1 :time-limit-in-msec 1500)",
            "(:ok (((\"multiple-value-bind\" \"3.51\" ((0 \"m\") (9 \"v\") (15 \"bin\")) \"-f---m--\")) nil))",
        ),
        (
            "(swank:documentation-symbol \"add\")",
            "(:ok \"Documentation for the function ADD:\n\nAdds two numbers.\n\")",
        ),
        (
            "(swank:find-definitions-for-emacs \"no-such\")",
            "(:ok nil)",
        ),
        (
            "(swank:swank-macroexpand-1 \"(when a b) ; so\")",
            "(:ok \"(if a\n    b)\")",
        ),
        (
            "(swank:interactive-eval \"(values 1 2)\")",
            "(:ok \"=> 1, 2\")",
        ),
        (
            "(swank:interactive-eval \"(values)\")",
            "(:ok \"; No value\")",
        ),
        (
            "(swank:eval-and-grab-output \"(progn (princ 1) 2)\")",
            "(:ok (\"1\" \"2\"))",
        ),
        ("(swank:buffer-first-change \"/x\")", "(:ok nil)"),
        (
            "(swank:set-package \"#:pp-tut\")",
            "(:ok (\"CRAM-PICK-PLACE-TUTORIAL\" \"PP-TUT\"))",
        ),
        ("(swank:undefine-function \"gone\")", "(:ok \"GONE\")"),
        (
            "(swank:interactive-eval \"(fboundp 'gone)\")",
            "(:ok \"=> NIL\")",
        ),
        (
            "(swank:export-symbol-for-emacs \"pp-tut::exported-here\" \"PP-TUT\")",
            "(:ok \"T\")",
        ),
        (
            "(swank:interactive-eval \"(nth-value 1 (find-symbol \\\"EXPORTED-HERE\\\" :pp-tut))\")",
            "(:ok \"=> :EXTERNAL\")",
        ),
        (
            "(swank:commit-edited-value \"(get 'edited 'x)\" \"(1 ,(+ 1 1))\")",
            "(:ok \"(1 2)\")",
        ),
        (
            "(swank:value-for-editing \"(get 'edited 'x)\")",
            "(:ok \"(1 2)\")",
        ),
        (
            "(swank:no-such-thing 1)",
            "(:abort \"planwright has no no-such-thing\")",
        ),
    ] {
        assert_eq!(client.call(form), answer, "{form}");
    }
    let described = client.call("(swank:describe-symbol \"add\")");
    assert!(described.contains("Adds two numbers."), "{described}");
    let packages = client.call("(swank:list-all-package-names t)");
    assert!(packages.contains("\"CL-USER\""), "{packages}");
    let packages = client.call("(swank:list-all-package-names)");
    assert!(packages.contains("\"COMMON-LISP-USER\""), "{packages}");
    assert!(!packages.contains("\"CL-USER\""), "{packages}");
    let exported = client.call("(swank:apropos-list-for-emacs \"\" t nil \"ROS-LOAD\")");
    assert!(exported.contains("ROS-LOAD:LOAD-SYSTEM"), "{exported}");
    assert!(!exported.contains("MULTIPLE-VALUE-BIND"), "{exported}");
    let apropos = client.call("(swank:apropos-list-for-emacs \"multiple-value-b\" t nil nil)");
    assert!(
        apropos.contains(":designator \"CL:MULTIPLE-VALUE-BIND\" :macro"),
        "{apropos}"
    );
}

#[test]
fn later_versions_are_told_completions_otherwise() {
    let served = Served::with(ServerOptions {
        version: Version::named("2.32.git"),
        ..ServerOptions::default()
    });
    let mut client = served.client();
    assert_eq!(
        client.call("(swank:completions \"multiple-value-b\" '\"CL-USER\")"),
        "(:ok ((\"multiple-value-bind\" \"-f---m---\" \"CL:MULTIPLE-VALUE-BIND\")))"
    );
}

#[test]
fn mistakes_are_found_where_they_are() {
    let served = Served::start();
    let mut client = served.client();
    let folder = crate::tests::scratch_folder();
    let file = folder.join("swank-mistakes.lisp");
    let file = file.to_str().unwrap();
    let text =
        "(in-package :pp-tut)\n; ü\n(defun wrong ()\n  (no-such-function 1))\n(defun right () 7)\n";
    std::fs::write(file, text).unwrap();
    let told = client.call(&format!("(swank:compile-file-for-emacs {file:?} t)"));
    let place = format!("(:location (:file {file:?}) (:line 4 3) nil)");
    assert!(
        told.contains(&place) && told.contains(":severity :warning"),
        "{told}"
    );
    assert!(
        told.starts_with("(:ok (:compilation-result ((:message"),
        "{told}"
    );
    // The file was loaded, and its package has not stayed.
    assert_eq!(client.shown("(pp-tut::right)"), "7\n");
    assert_eq!(
        client.shown("*package*"),
        "#<PACKAGE \"COMMON-LISP-USER\">\n"
    );
    let definitions = client.call_in("PP-TUT", "(swank:find-definitions-for-emacs \"right\")");
    let place = format!("(\"(DEFUN RIGHT)\" (:location (:file {file:?}) (:line 5 0) nil))");
    assert_eq!(definitions, format!("(:ok ({place}))"));

    let form = "(defun right ()\n (no-such-variable))";
    let places = "'((:position 60) (:line 5 1))";
    let told = client.call_in(
        "#:pp-tut",
        &format!(
            "(swank:compile-string-for-emacs {} \"b\" {places} {file:?} 'nil)",
            quoted(form)
        ),
    );
    assert!(told.contains("(:line 6 2)"), "{told}");
    let unreadable = client.call(&format!(
        "(swank:compile-string-for-emacs \"(list #<)\" \"b\" {places} nil 'nil)"
    ));
    assert!(unreadable.contains(":severity :error"), "{unreadable}");
    assert!(unreadable.contains("(:buffer \"b\")"), "{unreadable}");
    let missing = client.call("(swank:compile-file-for-emacs \"/no/such.lisp\" t)");
    assert!(
        missing.starts_with("(:abort \"/no/such.lisp cannot be read"),
        "{missing}"
    );
}

#[test]
fn a_program_can_quit() {
    let served = Served::start();
    let mut client = served.client();
    client.type_in("(quit 7)");
    while client.receive().is_some() {}
    assert_eq!(served.wait(), Ended::Quit(7));
}

#[test]
fn a_program_reads_what_the_client_types() {
    let served = Served::start();
    let mut client = served.client();
    let asks = |client: &mut Client| {
        let messages = client.until("(:read-string 1 ");
        let question = messages.last().unwrap();
        let tag = question.trim_end_matches(')').rsplit(' ').next().unwrap();
        (shown(&messages), tag.to_owned())
    };
    let text = "(progn (princ \"Name? \") (list (read-line) (read) (read-char) (listen)))";
    let id = client.type_in(text);
    let (prompt, tag) = asks(&mut client);
    assert_eq!(prompt, "Name? ");
    // Names are known meanwhile.
    assert_eq!(
        client.call("(swank:operator-arglist \"car\" nil)"),
        "(:ok \"(car list)\")"
    );
    client.send(&format!("(:emacs-return-string 1 {tag} \"Jo ü\n\")"));
    let (_, tag) = asks(&mut client);
    client.send(&format!("(:emacs-return-string 1 {tag} \"(1\n\")"));
    let (_, tag) = asks(&mut client);
    client.send(&format!("(:emacs-return-string 1 {tag} \" 2) xy\n\")"));
    assert_eq!(shown(&client.answer(id)), "(\"Jo ü\" (1 2) #\\x T)\n");
    // What is left over was typed for that program.
    let id = client.type_in("(read-line)");
    client.until("(:read-string 1 ");
    client.send("(:emacs-interrupt :repl-thread)");
    client.until("(:read-aborted 1 ");
    client.until("(:debug-activate 1 1 nil)");
    client.request("(swank:throw-to-toplevel)");
    client.answer(id);
    assert_eq!(client.shown("(+ 1 2)"), "3\n");
}

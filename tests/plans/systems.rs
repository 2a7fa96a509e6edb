//! Systems, the libraries of Common Lisp, are loaded from folders that the user names.

use std::fs;
use std::path::PathBuf;

use super::{said, said_and_printed};
use session::dialogue::{Evaluate, Event};
use session::{Session, SessionOptions};

/// A folder of systems, which is deleted at the end of the test.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str, files: &[(&str, &str)]) -> Folder {
        let name = format!("planwright-systems-{}-{name}", std::process::id());
        let folder = Folder(std::env::temp_dir().join(name));
        for (file, text) in files {
            let path = folder.0.join(file);
            fs::create_dir_all(path.parent().expect("it is in the folder")).unwrap();
            fs::write(path, text).unwrap();
        }
        folder
    }

    /// A session that looks for systems in the folder.
    fn session(&self) -> Session {
        let folder = self.0.to_str().expect("the name is text").to_owned();
        let options = SessionOptions {
            systems: vec![folder],
            ..SessionOptions::default()
        };
        Session::new(&options).expect("a session starts")
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // What is left in a folder for temporary files does no harm.
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// A file that notes that it has been loaded.
macro_rules! noting {
    ($name:literal) => {
        concat!("(push ", $name, " cl-user::*loaded*)")
    };
}

#[test]
fn files_are_loaded_in_the_order_that_the_description_says() {
    let folder = Folder::new(
        "order",
        &[
            (
                "deep/in/kitchen-tools.asd",
                "(defpackage #:kitchen-tools-system (:use :cl :asdf))\n\
                 (in-package #:kitchen-tools-system)\n\
                 #.(error \"Nothing is evaluated.\")\n\
                 (defsystem kitchen-tools :version (:read-file-form \"version.sexp\")\n\
                   :depends-on (:alexandria (:feature :sbcl :sb-posix) (:version \"spoons\" \"1.0\"))\n\
                   :components ((:static-file \"version.sexp\")\n\
                                (:file \"last\" :depends-on (\"first\" tools))\n\
                                (:file \"extra\" :if-feature (:and :sbcl))\n\
                                (:module tools :serial t :pathname \"src\" :depends-on (\"first\")\n\
                                         :components ((:file \"b\") (:file \"a\")))\n\
                                (:file \"first\"))\n\
                   :perform (test-op (o c) (uiop:symbol-call :fiveam '#:run!)))\n\
                 (defmethod perform ((o test-op) (c (eql (find-system :kitchen-tools))))\n\
                   (some-package::run))",
            ),
            ("deep/in/first.lisp", noting!(":first")),
            ("deep/in/last.lisp", noting!(":last")),
            ("deep/in/src/a.lisp", noting!(":a")),
            ("deep/in/src/b.lisp", noting!(":b")),
            (
                "spoons/spoons.asd",
                "(asdf:defsystem #:spoons :components ((:file \"spoons\")))\n\
                 (asdf:defsystem #:spoons/test :pathname \"t\" :components ((:file \"spoons\")))",
            ),
            (
                "spoons/spoons.lisp",
                "(defpackage :spoons (:use :cl)) (in-package :spoons)\n\
                 (setf *readtable* (copy-readtable))\n\
                 (push :spoons cl-user::*loaded*)\n\
                 (push (file-namestring *load-truename*) cl-user::*loaded*)",
            ),
            ("spoons/t/spoons.lisp", noting!(":test")),
        ],
    );
    let mut session = folder.session();
    let mut said = |text: &str| said(&mut session, text);
    said("(defvar *loaded* '()) (defvar *mine* *readtable*)");
    assert_eq!(said("(ql:quickload :kitchen-tools)"), "(:KITCHEN-TOOLS)");
    assert_eq!(
        said("(reverse *loaded*)"),
        "(:SPOONS \"spoons.lisp\" :FIRST :B :A :LAST)"
    );
    assert_eq!(
        said("(list (eq *mine* *readtable*) (package-name *package*))"),
        "(T \"COMMON-LISP-USER\")"
    );
    // Once is enough, unless it is forced.
    assert_eq!(
        said("(progn (asdf:load-system :spoons) (length *loaded*))"),
        "6"
    );
    assert_eq!(
        said("(progn (asdf:load-system :spoons :force t) (length *loaded*))"),
        "8"
    );
    assert_eq!(
        said("(progn (require :spoons/test) (first *loaded*))"),
        ":TEST"
    );
    assert_eq!(
        said("(asdf:registered-systems)"),
        "(\"kitchen-tools\" \"spoons\")"
    );
    let directory = said("(asdf:system-source-directory :spoons/test)");
    assert!(directory.ends_with("/spoons/\""), "{directory}");
}

#[test]
fn a_system_that_cannot_be_loaded_is_refused_with_the_reason() {
    let system = |name: &str, options: &str| {
        (
            format!("{name}.asd"),
            format!("(defsystem \"{name}\" {options})"),
        )
    };
    let systems = [
        system("needs-spoon", ":depends-on (:spoon)"),
        system("spoons", ":components ((:file \"spoon\"))"),
        system("chicken", ":depends-on (:egg)"),
        system("egg", ":depends-on (:chicken)"),
        system("foreign", ":depends-on (:cffi)"),
        system("threads", ":depends-on (\"lparallel\")"),
        system("grovel", ":components ((:cffi-grovel-file \"a\"))"),
        system(
            "round",
            ":components ((:file \"a\" :depends-on (\"b\")) (:file \"b\" :depends-on (\"a\")))",
        ),
        system(
            "nowhere",
            ":components ((:file \"alpha\") (:file \"b\" :depends-on (\"alhpa\")))",
        ),
        system("computed", ":components #.(list 1)"),
        system("inferred", ":class :package-inferred-system"),
        system("odd", ":components"),
        system("strange", ":components ((:file \"a\") \"b\")"),
        system("entry", ":depends-on ((:if x))"),
        (
            "broken.asd".to_owned(),
            "(defsystem \"broken\" :components (".to_owned(),
        ),
        ("other.asd".to_owned(), "(defsystem \"another\")".to_owned()),
        ("alpha.lisp".to_owned(), String::new()),
        ("spoons.lisp".to_owned(), String::new()),
    ];
    let files: Vec<(&str, &str)> = systems
        .iter()
        .map(|(file, text)| (file.as_str(), text.as_str()))
        .collect();
    let folder = Folder::new("refused", &files);
    let place = format!("{}/", folder.0.display());
    let mut session = folder.session();
    let mut refused = |name: &str| {
        let report = said(&mut session, &format!("(asdf:load-system {name})"));
        report.replace(&place, "")
    };
    for (name, expected) in [
        (
            ":needs-spoon",
            "There is no system \"spoon\", on which needs-spoon depends; did you mean spoons? ",
        ),
        (
            ":chicken",
            "Systems depend on each other in a circle: chicken, which needs egg, which needs chicken.",
        ),
        (
            ":foreign",
            "The system \"cffi\", on which foreign depends, calls foreign functions, which there are not.",
        ),
        (
            ":threads",
            "The system \"lparallel\", on which threads depends, needs threads of the machine, which there are not; ",
        ),
        (
            ":grovel",
            "grovel.asd: the component \"a\" is of the kind :CFFI-GROVEL-FILE: foreign functions there are not.",
        ),
        (
            ":round",
            "round.asd: components depend on each other in a circle: a, which needs b, which needs a.",
        ),
        (
            ":nowhere",
            "nowhere.asd: the component \"b\" depends on \"alhpa\", which is not there; did you mean alpha?",
        ),
        (
            ":spoons",
            "spoons.asd: there is no file spoon.lisp; did you mean spoons.lisp?",
        ),
        (
            ":computed",
            "computed.asd: a component is written (:file \"name\" …) or (:module \"name\" :components (…)), not 1.",
        ),
        (
            ":inferred",
            "inferred.asd: the system \"inferred\" is a package-inferred one; only those with components can be loaded.",
        ),
        (
            ":odd",
            "odd.asd: the options of the system \"odd\" are not a list of keywords with values.",
        ),
        (
            ":strange",
            "strange.asd: a component is written (:file \"name\" …) or (:module \"name\" :components (…)), not \"b\".",
        ),
        (
            ":entry",
            "entry.asd: (:IF ASDF-USER::X) is no system to depend on; a name, ",
        ),
        (":broken", "broken.asd cannot be read: "),
        (":other", "other.asd: there is no system \"other\" in it."),
        ("7", "The value\n  7\nis not of type"),
    ] {
        let report = refused(name);
        assert!(report.starts_with(expected), "{name}: {report}");
    }
}

#[test]
fn descriptions_are_evaluated_where_reading_is_not_enough() {
    let folder = Folder::new(
        "evaluated",
        &[
            (
                "a/b/c/d/e/f/computed.asd",
                "(defvar *parts* '((:file \"one\")))\n\
                 (defsystem \"computed\" :version (:read-file-form \"version.sexp\")\n\
                   :components #.(append *parts* '((:file \"two\"))))",
            ),
            ("a/b/c/d/e/f/version.sexp", "\"1.4\""),
            (
                "a/b/c/d/e/f/one.lisp",
                "(defvar cl-user::*loaded* '())\n\
                 (eval-when (:compile-toplevel :load-toplevel) (push :compiled cl-user::*loaded*))\n\
                 (eval-when (:execute) (push :executed cl-user::*loaded*))",
            ),
            ("a/b/c/d/e/f/two.lisp", noting!(":two")),
            (
                "wrapped.asd",
                "(when (uiop:featurep :planwright)\n\
                   (defsystem :wrapped :version \"2.0\" :components ((:file \"three\"))))",
            ),
            ("three.lisp", noting!(":three")),
            ("wrong.asd", "(when t (car 5))"),
        ],
    );
    let mut session = folder.session();
    for (text, expected) in [
        ("(asdf:load-system :computed)", "T"),
        ("cl-user::*loaded*", "(:TWO :EXECUTED :COMPILED)"),
        ("(asdf:component-version :computed)", "\"1.4\""),
        ("(asdf:load-system :wrapped)", "T"),
        ("(first cl-user::*loaded*)", ":THREE"),
        ("(asdf:component-version :wrapped)", "\"2.0\""),
        ("(asdf:component-loaded-p :wrapped)", "T"),
        ("(asdf:load-system :bordeaux-threads)", "T"),
        (
            "(let ((l (bt:make-lock))) (cpl:top-level (bt:acquire-lock l) (cpl:par (bt:with-lock-held (l) (push :inside cl-user::*loaded*)) (progn (cpl:sleep 1) (push :before cl-user::*loaded*) (bt:release-lock l)))) (list (first cl-user::*loaded*) (second cl-user::*loaded*)))",
            "(:INSIDE :BEFORE)",
        ),
    ] {
        assert_eq!(said(&mut session, text), expected, "{text}");
    }
    // What is loaded by itself is not compiled.
    let file = folder.0.join("a/b/c/d/e/f/one.lisp");
    let load = format!("(load {file:?})");
    assert_eq!(said(&mut session, &load), "T");
    assert_eq!(said(&mut session, "(first cl-user::*loaded*)"), ":EXECUTED");
    let wrong = said(&mut session, "(asdf:load-system :wrong)");
    assert!(wrong.contains("wrong.asd cannot be evaluated: "), "{wrong}");
}

#[test]
fn features_kinds_of_components_and_pathnames_are_those_of_the_file() {
    let folder = Folder::new(
        "own-kinds",
        &[
            (
                "cutlery.asd",
                "(defpackage :cutlery-system (:use :cl :asdf) (:export #:sharp #:blunt))\n\
                 (in-package :cutlery-system)\n\
                 (defclass recipe-file (doc-file) ((type :initform \"txt\")))\n\
                 (eval-when (:compile-toplevel :load-toplevel :execute)\n\
                   (pushnew 'cutlery-system:sharp cl:*features*))\n\
                 (defsystem :cutlery :depends-on (#:asdf #:closer-mop)\n\
                   :components ((:module \"doc\" :components ((:recipe-file \"soup\")))\n\
                                (:module \"knives\" :pathname #p\"src/knives/\"\n\
                                         :components (#+cutlery-system:sharp (:file \"sharp\")\n\
                                                      #+cutlery-system:blunt (:file \"blunt\")\n\
                                                      #-cutlery-system:blunt (:file \"pointed\")))))",
            ),
            ("doc/soup.txt", "Onions."),
            ("src/knives/sharp.lisp", noting!(":sharp")),
            ("src/knives/blunt.lisp", noting!(":blunt")),
            ("src/knives/pointed.lisp", noting!(":pointed")),
            (
                "forks.asd",
                "(defsystem :forks :components ((:fork-source \"fork\") #+sbcl (:file \"none\")))",
            ),
            ("fork.lisp", noting!(":fork")),
            (
                "spoons.asd",
                "(defsystem :spoons :components ((:file \"spon\")))",
            ),
            ("spoon.lisp", ""),
        ],
    );
    let mut session = folder.session();
    for (text, says) in [
        (
            "(defvar *loaded* '()) (asdf:operate 'asdf:load-op :cutlery) (reverse *loaded*)",
            "(:SHARP :POINTED)",
        ),
        (
            "(setf *loaded* '()) (asdf:load-system :forks) *loaded*",
            "(:FORK)",
        ),
        (
            "(defmethod asdf:operate :after ((operation t) (system t) &key) (push (list operation system) *loaded*))\n\
             (asdf:operate 'asdf:load-op :forks) *loaded*",
            "((ASDF:LOAD-OP :FORKS) :FORK)",
        ),
        (
            "(defpackage :of-both (:use :closer-common-lisp)) (in-package :of-both)\n\
             (prog1 (list (class-direct-superclasses (find-class 'integer)) nil t) (in-package :cl-user))",
            "((#<BUILT-IN-CLASS COMMON-LISP:RATIONAL>) NIL T)",
        ),
    ] {
        assert_eq!(said(&mut session, text), says, "{text}");
    }
    let missing = said(&mut session, "(asdf:load-system :spoons)");
    assert!(missing.contains("did you mean spoon.lisp?"), "{missing}");
}

/// `QUIT` and `EXIT` are no names of the language: libraries define functions of these names.
#[test]
fn a_package_of_the_language_alone_has_names_of_its_own_for_leaving() {
    let folder = Folder::new("leaving", &[]);
    let mut session = folder.session();
    for (text, says) in [
        (
            "(defpackage :shop (:use :cl)) (in-package :shop) (defun exit (door) (list :by door)) (exit 2)",
            "(:BY 2)",
        ),
        ("(fboundp 'cl-user::exit)", "T"),
        ("(find-symbol \"QUIT\" :cl)", "NIL ; NIL"),
        ("(eq 'sb-ext:exit 'planwright:exit)", "T"),
    ] {
        assert_eq!(said(&mut session, text), says, "{text}");
    }
}

#[test]
fn a_tutorial_whose_files_are_not_there_says_so() {
    let name = "(ros-load:load-system \"cram_beginner_tutorial\" :cram-beginner-tutorial)";
    let mut session = Session::new(&SessionOptions::default()).expect("a session starts");
    let mut text = String::new();
    session.evaluate("test", name, &mut |event| {
        if let Event::Output(output) = event {
            text.push_str(&output);
        }
    });
    assert!(
        text.contains("of this tutorial only the package is here"),
        "{text}"
    );
    let folder = Folder::new(
        "tutorial",
        &[
            (
                "cram-beginner-tutorial.asd",
                "(defsystem cram-beginner-tutorial :components ((:file \"package\")))",
            ),
            (
                "package.lisp",
                "(defpackage :cram-beginner-tutorial (:nicknames :tut) (:use :cpl))\n\
                 (in-package :tut) (defun drawn () :drawn)",
            ),
        ],
    );
    let mut session = folder.session();
    assert_eq!(said(&mut session, name), "T");
    assert_eq!(said(&mut session, "(tut::drawn)"), ":DRAWN");
}

#[test]
fn a_file_has_its_own_binding_of_a_file_local_variable() {
    let folder = Folder::new(
        "file-local",
        &[
            (
                "locals.asd",
                "(defsystem :locals :serial t :depends-on (:net.didierverna.asdf-flv)\n\
                   :components ((:file \"define\") (:file \"change\")))",
            ),
            (
                "define.lisp",
                "(defvar cl-user::*suite* :none)\n\
                 (net.didierverna.asdf-flv:set-file-local-variable cl-user::*suite*)",
            ),
            (
                "change.lisp",
                "(setf cl-user::*suite* :mine cl-user::*seen* cl-user::*suite*)",
            ),
        ],
    );
    let mut session = folder.session();
    said(&mut session, "(defvar *seen* nil)");
    assert_eq!(said(&mut session, "(asdf:load-system :locals)"), "T");
    assert_eq!(said(&mut session, "(list *seen* *suite*)"), "(:MINE :NONE)");
}

#[test]
fn the_tests_of_a_system_are_run_as_its_description_says() {
    let folder = Folder::new(
        "tests",
        &[
            (
                "cup.asd",
                "(asdf:defsystem :cup :components ((:file \"cup\"))
                   :in-order-to ((asdf:test-op (test-op \"cup/tests\"))))
                 (defsystem cup/tests :depends-on (cup) :components ((:file \"cup-tests\"))
                   :perform (test-op (o c) (uiop:symbol-call :cup-tests '#:run \"a:b\" :c)))",
            ),
            (
                "mug.asd",
                "(defsystem \"mug\" :components ((:file \"cup\")))
                 (defmethod perform ((o test-op) (c (eql (find-system :mug))))
                   (push :mug cl-user::*ran*))",
            ),
            (
                "pan.asd",
                "(defsystem :pan :components ((:file \"cup\"))
                   :perform (test-op (o c) (no-such-package:run)))",
            ),
            ("cup.lisp", "(defvar cl-user::*ran* '())"),
            (
                "cup-tests.lisp",
                "(defpackage :cup-tests (:use :cl))
                 (cl-user::in-package :cup-tests)
                 (defun run (&rest arguments) (push arguments cl-user::*ran*))",
            ),
        ],
    );
    let mut session = folder.session();
    assert_eq!(said(&mut session, "(asdf:test-system :cup)"), "T");
    assert_eq!(said(&mut session, "cl-user::*ran*"), "((\"a:b\" :C))");
    assert_eq!(said(&mut session, "(asdf:test-system :mug)"), "T");
    assert_eq!(said(&mut session, "(first cl-user::*ran*)"), ":MUG");
    let wrong = said(&mut session, "(asdf:test-system :pan)");
    assert!(
        wrong.contains("there is no package NO-SUCH-PACKAGE"),
        "{wrong}"
    );
    let none = said(&mut session, "(asdf:test-system \"cram_language\")");
    assert!(none.contains("is built in; its tests are not"), "{none}");
}

#[test]
fn systems_that_are_not_here_are_told_and_do_not_stop_others() {
    let folder = Folder::new(
        "absent",
        &[
            (
                "my-demo.asd",
                "(defsystem my-demo :depends-on (roslisp cram-language actionlib tmc_msgs-msg cl-tf cram-giskard)
                   :components ((:file \"package\") (:file \"demo\" :depends-on (\"package\"))))",
            ),
            (
                "package.lisp",
                "(defpackage :my-demo (:use :cpl :roslisp))",
            ),
            (
                "demo.lisp",
                "(in-package :my-demo)
                 (defun voice () (make-message 'tmc_msgs-msg:voice :sentence \"Hello\"))
                 (defun reach () (actionlib:call-goal 1 2))",
            ),
        ],
    );
    let mut session = folder.session();
    let told = said_and_printed(&mut session, "(asdf:load-system :my-demo)");
    for part in [
        "The system actionlib, on which my-demo depends, is not here: there is no action server to call",
        "The system cram-giskard, on which my-demo depends, is not here",
    ] {
        assert!(told.contains(part), "{told}");
    }
    assert!(told.ends_with('T'), "{told}");
    let voice = said(
        &mut session,
        "(roslisp:msg-slot-value (my-demo::voice) :sentence)",
    );
    assert_eq!(voice, "\"Hello\"");
    let refused = said(&mut session, "(my-demo::reach)");
    assert!(refused.contains("there is no action server"), "{refused}");
    let alone = said(&mut session, "(asdf:load-system :cram-moveit)");
    assert!(
        alone.contains("The system cram-moveit is not here"),
        "{alone}"
    );
}

//! Pathnames: wild and logical ones, merging, what can be read again.

use super::standard::check;

const HOST: &str = "(setf (logical-pathname-translations \"robot\")
    '((\"demo;**;*.*\" \"/plans/demo/**/*.*\") (\"**;*.*.*\" \"/home/**/*.*\")))";

#[test]
fn pathnames_are_translated_by_patterns() {
    check(&[
        (
            "(namestring (translate-pathname \"/a/b/c/x.lisp\" \"/a/**/*.lisp\" \"/old/**/y-*.bak\"))",
            "\"/old/b/c/y-x.bak\"",
        ),
        (
            "(namestring (translate-pathname \"foobar\" \"foo*r\" \"*-*\"))",
            "\"ba-\"",
        ),
        (
            "(namestring (translate-pathname \"/a/bcd/x\" \"/a/b*d/*\" \"/q/*/z*/\"))",
            "\"/q/c/z/x\"",
        ),
        (
            "(handler-case (translate-pathname \"a.lisp\" \"*.plan\" \"*.bak\") (error () :no-match))",
            ":NO-MATCH",
        ),
    ]);
}

#[test]
fn logical_pathnames_stand_for_files() {
    let host = |form: &str| format!("(progn {HOST} {form})");
    let cases = [
        (
            "(logical-pathname \"robot:demo;a.lisp\")",
            "#P\"ROBOT:DEMO;A.LISP\"",
        ),
        (
            "(translate-logical-pathname \"robot:demo;deep;a.lisp\")",
            "#P\"/plans/demo/deep/a.lisp\"",
        ),
        (
            "(translate-logical-pathname \"robot:other;a.lisp.newest\")",
            "#P\"/home/other/a.lisp\"",
        ),
        ("(typep (pathname \"robot:a\") 'logical-pathname)", "T"),
        (
            "(pathname-host (merge-pathnames \"b.lisp\" (logical-pathname \"robot:demo;a.lisp\")))",
            "\"ROBOT\"",
        ),
        ("(pathname-version (logical-pathname \"robot:a.b.7\"))", "7"),
        ("(probe-file \"robot:no-such-file.lisp\")", "NIL"),
        (
            "(handler-case (logical-pathname \"a.lisp\") (type-error () :refused))",
            ":REFUSED",
        ),
        (
            "(handler-case (logical-pathname \"robot:a/b.lisp\") (parse-error () :refused))",
            ":REFUSED",
        ),
        (
            "(handler-case (logical-pathname-translations \"nobody\") (error () :unknown))",
            ":UNKNOWN",
        ),
    ];
    for (form, expected) in cases {
        check(&[(&host(form), expected)]);
    }
}

#[test]
fn no_version_is_the_newest_one() {
    check(&[
        (
            "(pathname-version (merge-pathnames \"a\" \"b\"))",
            ":NEWEST",
        ),
        (
            "(pathname-version (merge-pathnames \"a\" (make-pathname :version 3) nil))",
            "NIL",
        ),
        (
            "(equal (make-pathname :name \"a\" :version :newest) #P\"a\")",
            "T",
        ),
    ]);
}

#[test]
fn what_cannot_be_read_again_is_not_printed_readably() {
    check(&[
        (
            "(let ((*print-readably* t)) (prin1-to-string #P\"a.lisp\"))",
            "\"#P\\\"a.lisp\\\"\"",
        ),
        (
            "(handler-case (write-to-string (make-pathname :type \"txt\") :readably t) (print-not-readable () :no))",
            ":NO",
        ),
        (
            "(handler-case (write-to-string (list 1 #'car) :readably t) (print-not-readable (e) (functionp (print-not-readable-object e))))",
            "T",
        ),
    ]);
}

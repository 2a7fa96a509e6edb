//! Files and the pathnames that name them.

use super::standard::check;

#[test]
fn files_have_characters_or_bytes() {
    let folder = std::env::temp_dir().join(format!("planwright-files-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let name = |file: &str| format!("{:?}", folder.join(file).to_str().unwrap());
    let bytes = format!(
        "(progn (with-open-file (s {0} :direction :output :element-type '(unsigned-byte 16)) (write-sequence #(1 65535) s) (write-byte 258 s)) (with-open-file (s {0} :element-type '(unsigned-byte 8)) (list (file-length s) (loop for b = (read-byte s nil) while b collect b) (stream-element-type s))))",
        name("bytes")
    );
    let signed = format!(
        "(with-open-file (s {} :element-type '(signed-byte 16)) (file-position s 1) (list (read-byte s) (file-position s) (typep s 'file-stream)))",
        name("bytes")
    );
    let both = format!(
        "(progn (with-open-file (s {0} :direction :io :if-does-not-exist :create) (write-string \"naïve\" s) (file-position s 0) (read-char s) (write-char #\\A s) (finish-output s) (read-line s)) (with-open-file (s {0}) (read-line s)))",
        name("both")
    );
    let files = format!(
        "(let ((all (directory {}))) (mapcar #'pathname-name all))",
        name("*")
    );
    let load = format!(
        "(progn (with-open-file (s {0} :direction :output) (print '(defparameter cl-user::*seen* *load-truename*) s) (print '(setq *package* (find-package :keyword)) s)) (load (pathname {0})) (list (package-name *package*) (pathname-name cl-user::*seen*)))",
        name("load.lisp")
    );
    check(&[
        (&bytes, "(6 (1 0 255 255 2 1) (UNSIGNED-BYTE 8))"),
        (&signed, "(-1 2 T)"),
        (&both, "\"nAïve\" ; T"),
        (&files, "(\"both\" \"bytes\")"),
        (&load, "(\"COMMON-LISP-USER\" \"load\")"),
        (
            "(read-byte (make-string-input-stream \"a\"))",
            "!! The elements of the stream are characters, not bytes; give OPEN an :ELEMENT-TYPE such as (UNSIGNED-BYTE 8).",
        ),
    ]);
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn pathnames_are_objects() {
    check(&[
        (
            "(let ((p (make-pathname :directory '(:absolute \"a\") :name \"b\" :type \"c\"))) (list p (pathnamep p) (stringp p) (equal p #P\"/a/b.c\") (princ-to-string p)))",
            "(#P\"/a/b.c\" T NIL T \"/a/b.c\")",
        ),
        (
            "(list (merge-pathnames \"x.lisp\" #P\"/a/b.c\") (merge-pathnames \"../y\" \"/a/b.c\") (enough-namestring \"/a/b\" \"/a/\"))",
            "(#P\"/a/x.lisp\" #P\"/a/../y.c\" \"b\")",
        ),
        (
            "(mapcar (lambda (p) (pathname-match-p p \"/a/**/*-x.lisp\")) '(\"/a/1-x.lisp\" \"/a/b/c/2-x.lisp\" \"/b/1-x.lisp\" \"/a/1-x.plan\"))",
            "(T T NIL NIL)",
        ),
        (
            "(make-pathname :directory 5)",
            "!! 5 is no directory; it is a string, or a list of :ABSOLUTE or :RELATIVE and names.",
        ),
        (
            "(open \"a*.lisp\")",
            "!! \"a*.lisp\" stands for several files; one is needed here.",
        ),
        (
            "(let ((s (make-string-output-stream))) (close s) (list (typep s 'string-stream) (typep (make-broadcast-stream) 'broadcast-stream) (class-name (class-of (make-concatenated-stream)))))",
            "(T T CONCATENATED-STREAM)",
        ),
        (
            "(handler-case (make-two-way-stream (make-broadcast-stream) (make-broadcast-stream)) (type-error (c) (typep (type-error-datum c) (type-error-expected-type c))))",
            "NIL",
        ),
    ]);
}

#[test]
fn loading_tells_what_it_loads_if_asked() {
    check(&[
        (
            "(with-output-to-string (*standard-output*) (with-input-from-string (s \"(+ 1 2)\") (load s :verbose t :print t)))",
            "\"; Loading stream ; 3 \"",
        ),
        (
            "(with-output-to-string (*standard-output*) (let ((*load-print* t)) (with-input-from-string (s \"(+ 1 2)\") (load s))))",
            "\"; 3 \"",
        ),
        (
            "(with-output-to-string (*standard-output*) (with-input-from-string (s \"(+ 1 2)\") (load s)))",
            "\"\"",
        ),
        ("(pathname-device \"a.lisp\")", "NIL"),
    ]);
}

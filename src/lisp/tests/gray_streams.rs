//! Streams whose elements come from methods of a program.

use super::standard::check;

const CLASSES: &str = "
    (defclass letters (gray-streams:fundamental-character-input-stream)
      ((text :initarg :text) (at :initform 0)))
    (defmethod gray-streams:stream-read-char ((s letters))
      (with-slots (text at) s
        (if (< at (length text)) (prog1 (char text at) (incf at)) :eof)))
    (defmethod gray-streams:stream-unread-char ((s letters) character)
      (declare (ignore character))
      (decf (slot-value s 'at))
      nil)
    (defclass shout (gray-streams:fundamental-character-output-stream)
      ((letters :initform '())))
    (defmethod gray-streams:stream-write-char ((s shout) character)
      (push (char-upcase character) (slot-value s 'letters))
      character)
    (defun letters (text) (make-instance 'letters :text text))
    (defun shouted (s) (coerce (reverse (slot-value s 'letters)) 'string))";

fn check_with_classes(rows: &[(&str, &str)]) {
    let rows: Vec<(String, &str)> = rows
        .iter()
        .map(|(form, expected)| (format!("{CLASSES} {form}"), *expected))
        .collect();
    let rows: Vec<(&str, &str)> = rows.iter().map(|(form, e)| (form.as_str(), *e)).collect();
    check(&rows);
}

#[test]
fn text_is_read_from_methods() {
    check_with_classes(&[
        (
            "(let ((s (letters (format nil \"ab~%c\"))))
               (list (peek-char nil s) (read-char s) (read-line s) (multiple-value-list (read-line s))
                     (read-char s nil :end) (read-line s nil :end)))",
            "(#\\a #\\a \"b\" (\"c\" T) :END :END)",
        ),
        (
            "(let ((s (letters \"  x\"))) (list (peek-char t s) (listen s) (read-char s) (listen s)))",
            "(#\\x T #\\x NIL)",
        ),
        (
            "(let ((s (letters \"abcdef\")) (to (make-string 4 :initial-element #\\-)))
               (list (read-sequence to s :start 1 :end 3) to (read-char s)))",
            "(3 \"-ab-\" #\\c)",
        ),
        (
            "(handler-case (read-char (letters \"\")) (end-of-file (e) (type-of (stream-error-stream e))))",
            "LETTERS",
        ),
    ]);
}

#[test]
fn forms_are_read_from_methods() {
    check_with_classes(&[
        (
            "(let ((s (letters \"(a \\\"b)\\\" . c) foo #(1 2) #\\\\( 'x 12\")))
               (list (read s) (read s) (read s) (read s) (read s) (read s) (read s nil :end)))",
            "((A \"b)\" . C) FOO #(1 2) #\\( 'X 12 :END)",
        ),
        (
            "(handler-case (read (letters \"(a b\")) (end-of-file () :open))",
            ":OPEN",
        ),
        (
            "(loop for text in '(\"(a #\\\\( \\\"b)\\\" |c)|) rest\" \"#| ( #| ( |# |# (x #| ) |# y) rest\"
                                \"|a (b| rest\" \"\\\\( rest\" \"\\\"a\\\\\\\"(\\\" rest\")
                   always (let ((s (letters text)))
                            (and (equal (read s) (read-from-string text)) (equal (read-line s) \"rest\"))))",
            "T",
        ),
        // Looking at the whole text again at each blank would take minutes.
        (
            "(length (read (letters (format nil \"(~{(~d)~%~})\" (loop for i below 20000 collect i)))))",
            "20000",
        ),
        (
            "(let ((s (letters \"a b) c\"))) (list (read-delimited-list #\\) s) (read s)))",
            "((A B) C)",
        ),
    ]);
}

#[test]
fn what_is_printed_goes_to_methods() {
    check_with_classes(&[
        (
            "(let ((s (make-instance 'shout)))
               (list (format s \"~a-~s\" \"x\" :k) (write-string \"abcd\" s :start 1 :end 3)
                     (print 'y s) (terpri s) (write-line \"z\" s) (prin1 \"q\" s) (substitute #\\/ #\\newline (shouted s))))",
            "(NIL \"abcd\" Y NIL \"z\" \"q\" \"X-:KBC/Y /Z/\\\"Q\\\"\")",
        ),
        (
            "(let* ((s (make-instance 'shout)) (*standard-output* s))
               (princ \"to \") (format t \"~5,'_d\" 7) (shouted s))",
            "\"TO ____7\"",
        ),
        (
            "(defvar *shout* (make-instance 'shout))
             (let ((s (make-synonym-stream '*shout*))) (write-char #\\a s) (format s \"~a\" 'b))
             (shouted *shout*)",
            "\"AB\"",
        ),
        (
            "(let ((s (make-instance 'shout))) (mapc (lambda (c) (write-char c s)) '(#\\a #\\b)) (shouted s))",
            "\"AB\"",
        ),
    ]);
}

#[test]
fn such_streams_are_streams() {
    check_with_classes(&[
        (
            "(let ((s (letters \"a\")))
               (list (streamp s) (typep s 'stream) (input-stream-p s) (output-stream-p s)
                     (open-stream-p s) (close s) (open-stream-p s)))",
            "(T T T NIL T T NIL)",
        ),
        (
            "(let ((closed 0))
               (defmethod close ((s letters) &key abort) (declare (ignore abort)) (incf closed) t)
               (with-open-stream (s (letters \"ab\")) (read-char s))
               closed)",
            "1",
        ),
        (
            "(defclass numbers (gray-streams:fundamental-binary-input-stream) ((next :initform 0)))
             (defmethod gray-streams:stream-read-byte ((s numbers)) (incf (slot-value s 'next)))
             (let ((s (make-instance 'numbers)) (to (make-array 3)))
               (list (read-byte s) (read-sequence to s) to))",
            "(1 3 #(2 3 4))",
        ),
    ]);
}

#[test]
fn what_a_class_of_streams_lacks_is_named() {
    check_with_classes(&[
        (
            "(handler-case (write-char #\\a (letters \"a\")) (error (e) (princ-to-string e)))",
            "\"The class LETTERS of streams has no method of GRAY-STREAMS:STREAM-WRITE-CHAR.\"",
        ),
        (
            "(handler-case (read-char (make-instance 'standard-object)) (type-error (e) (type-error-expected-type e)))",
            "STREAM",
        ),
    ]);
}

#[test]
fn objects_are_parts_of_two_way_and_broadcast_streams() {
    check(&[
        (
            "(progn (defclass twice (gray-streams:fundamental-character-input-stream gray-streams:fundamental-character-output-stream) ((text :initarg :text) (at :initform 0) (written :initform '())))
               (defmethod gray-streams:stream-read-char ((s twice)) (with-slots (text at) s (if (< at (length text)) (prog1 (char text at) (incf at)) :eof)))
               (defmethod gray-streams:stream-unread-char ((s twice) c) (declare (ignore c)) (decf (slot-value s 'at)) nil)
               (defmethod gray-streams:stream-write-char ((s twice) c) (push (char-upcase c) (slot-value s 'written)))
               (defvar *part* (make-instance 'twice :text \"h (1 2) rest of it\"))
               (defvar *both* (make-two-way-stream *part* *part*))
               (list (read-char *both*) (read *both*) (peek-char t *both*) (read-line *both*) (read-char *both* nil :end)))",
            "(#\\h (1 2) #\\r \"rest of it\" :END)",
        ),
        (
            "(progn (format *both* \"a~a\" 1) (write-string \"xy\" *both*) (princ 'q *both*) (let ((*standard-output* *both*)) (princ \"z\")) (coerce (reverse (slot-value *part* 'written)) 'string))",
            "\"A1XYQZ\"",
        ),
        (
            "(list (typep *both* 'two-way-stream) (eq *part* (two-way-stream-input-stream *both*)) (input-stream-p *both*) (output-stream-p *both*) (progn (close *both*) (open-stream-p *both*)) (open-stream-p *part*))",
            "(T T T T NIL T)",
        ),
        (
            "(let* ((text (make-string-output-stream)) (all (make-broadcast-stream *part* text))) (write-string \"b\" all) (format all \"~a\" 'c) (list (get-output-stream-string text) (subseq (slot-value *part* 'written) 0 2) (length (broadcast-stream-streams all))))",
            "(\"bC\" (#\\C #\\B) 2)",
        ),
        (
            "(progn (defvar *named* *both*) (write-char #\\n (make-synonym-stream '*named*)) (write 'w :stream *both*) (print-unreadable-object (*part* *both*) (princ 'u *both*)) (subseq (slot-value *part* 'written) 0 6))",
            "(#\\> #\\U #\\< #\\# #\\W #\\N)",
        ),
        (
            "(handler-case (make-two-way-stream *part* (make-string-input-stream \"\")) (error (e) (not (null (search \"cannot be written to\" (princ-to-string e))))))",
            "T",
        ),
        (
            "(let ((*query-io* (let ((part (make-instance 'twice :text (format nil \"y~%\")))) (make-two-way-stream part part)))) (y-or-n-p \"Ok?\"))",
            "T",
        ),
    ]);
}

//! What `formatter` makes: functions that return the arguments they leave.

use super::standard::check;

#[test]
fn formatters_return_the_arguments_that_are_left() {
    check(&[
        (
            "(list (funcall (formatter \"~a~*\") (make-broadcast-stream) 1 2 3 4) (with-output-to-string (s) (funcall (formatter \"~a-~a\") s 1 2 3)))",
            "((3 4) \"1-2\")",
        ),
        (
            "(funcall (formatter \"~@{~a~^ ~}\") (make-broadcast-stream) 1 2)",
            "NIL",
        ),
        (
            "(with-output-to-string (s) (pprint-logical-block (s nil) (format s \"<~@?>\" \"~a\" 1) (funcall (formatter \"~a\") s 2)))",
            "\"<1>2\"",
        ),
        (
            "(funcall (formatter \"~a\") 5 1)",
            "!! The value 5 is not of type STREAM",
        ),
    ]);
}

#[test]
fn iterations_end_where_their_parameters_say() {
    check(&[
        // NIL in place of a parameter leaves it out: two are equal.
        ("(format nil \"~{~v,v,v^~a~}\" '(1 1 nil 5))", "\"\""),
        ("(format nil \"~{~v,v^~a~}\" '(1 2 x 3 3 y))", "\"X\""),
        (
            "(format nil \"~{~a~}\" '(1 . 2))",
            "!! The value 2 is not of type LIST",
        ),
        // A newline that is left out is a body.
        ("(format nil \"~{~\n  ~}\" '())", "\"\""),
    ]);
}

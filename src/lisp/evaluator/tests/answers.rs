//! Values that are given in place of operations that failed.

use crate::image::Image;
use crate::print;
use crate::reader;
use crate::value::Value;
use crate::value::symbol::known;
use crate::vm::fiber::Fiber;
use crate::vm::machine::{Event, Machine};

/// Evaluates a form whose first error is answered by a value in place of the call that failed.
fn evaluate_with_answer(text: &str, answer: Value) -> String {
    let mut image = Image::new();
    let source = image.sources.add("test", text);
    let forms = reader::read_all(&mut image, source).unwrap_or_else(|e| panic!("{e}"));
    let mut fiber = Fiber::default();
    let mut machine = Machine::new(&mut image, &mut fiber);
    let event = machine.start(known::EVAL.into(), vec![forms[0].0.clone()]);
    assert!(matches!(event, Event::Unhandled(_)), "{text}");
    match machine.resume(answer) {
        Event::Done(value) => print::to_string(&image, &value, true),
        _ => panic!("{text} does not end"),
    }
}

#[test]
fn a_value_in_place_of_a_failed_comparison_decides_where_to_go_on() {
    for test in [
        "(< x y)",
        "(< x 1)",
        "(> (car (list x)) 1)",
        "(= (car (list x)) (car (list y)))",
        "(and y (<= x y))",
        "(or (null y) (>= x y))",
        "(not (not (< x 1)))",
    ] {
        let text = format!("(let ((x 'a) (y 1)) (list (if {test} 'yes 'no) x y))");
        assert_eq!(evaluate_with_answer(&text, Value::T), "(YES A 1)", "{test}");
        assert_eq!(
            evaluate_with_answer(&text, Value::NIL),
            "(NO A 1)",
            "{test}"
        );
    }
}

#[test]
fn a_value_in_place_of_a_failed_addition_is_assigned() {
    let text = "(let ((x 'a) (y 1)) (setq x (+ x 1)) (list x y))";
    assert_eq!(evaluate_with_answer(text, Value::Int(7)), "(7 1)");
    let text = "(let ((x 'a) (y 1)) (setq x (cdr x)) (list x y))";
    assert_eq!(evaluate_with_answer(text, Value::Int(7)), "(7 1)");
}

#[test]
fn a_value_in_place_of_a_failed_path_is_the_value_of_all_of_it() {
    let text = "(let ((x '(1 . 2))) (list (cadr x) (cdr x)))";
    assert_eq!(evaluate_with_answer(text, Value::Int(7)), "(7 2)");
}

/// Evaluates a form, with 55 in place of every operation that fails.
fn evaluate_with_55(text: &str) -> String {
    let mut image = Image::new();
    let source = image.sources.add("test", text);
    let forms = reader::read_all(&mut image, source).unwrap_or_else(|e| panic!("{e}"));
    let mut fiber = Fiber::default();
    let mut machine = Machine::new(&mut image, &mut fiber);
    let form = forms.into_iter().next().map(|(form, _)| form);
    let mut event = machine.start(known::EVAL.into(), form.into_iter().collect());
    loop {
        event = match event {
            Event::Unhandled(_) => machine.resume(Value::Int(55)),
            Event::Done(value) => return print::to_string(&image, &value, true),
            _ => panic!("{text} has stopped"),
        };
    }
}

#[test]
fn a_value_takes_the_place_of_an_operation_that_fails() {
    for (form, expected) in [
        ("(let ((x 'a) (n 0)) (list (+ (incf n) x) n))", "(55 1)"),
        ("(let ((x 'a) (n 0)) (list (- x (incf n)) n))", "(55 1)"),
        ("(let ((x 'a)) (list 1 (1+ x) (+ x 7) 2))", "(1 55 55 2)"),
        ("(let ((x 'a)) (list 1 (* (car (list x)) 2) 3))", "(1 55 3)"),
        ("(let ((x 'a)) (setq x (1+ x)) (list x))", "(55)"),
        ("(let ((x 5)) (setq x (cdr x)) (list x))", "(55)"),
        (
            "(let ((x 5)) (list 1 (car x) (cdr x) (cadr x) 2))",
            "(1 55 55 55 2)",
        ),
        ("(list 1 (if (< (car '(a)) 3) 2 4) 5)", "(1 2 5)"),
        ("(let ((x 'a)) (list 1 (if (< x 3) 2 4) 5))", "(1 2 5)"),
        (
            "(let ((x 'a)) (list 1 (if (not (< x 3)) 2 4) 5))",
            "(1 4 5)",
        ),
        (
            "(let ((x 'a) (y 1)) (list 1 (if (= y x) 2 4) 5))",
            "(1 2 5)",
        ),
        (
            "(let ((y 1)) (list 1 (if (> y (car '(a))) 2 4) 5))",
            "(1 2 5)",
        ),
        ("(let ((y 1)) (list 1 (> y (car '(a))) 5))", "(1 55 5)"),
        (
            "(let ((v 5) (i 0)) (list 1 (aref v i) (svref v i) 2))",
            "(1 55 55 2)",
        ),
        (
            "(let ((v 5) (i 0)) (setf (aref v i) 1) (list v i))",
            "(5 0)",
        ),
        (
            "(let ((v (vector 1)) (i 3)) (list (setf (aref v i) 1) v))",
            "(55 #(1))",
        ),
        (
            "(let ((c 5)) (rplaca c 1) (rplacd c 1) (list c (rplaca c 1)))",
            "(5 55)",
        ),
        ("(let ((x 2)) (list 1 (nowhere x x) 3))", "(1 55 3)"),
        (
            "(let ((x 2)) (list 1 (funcall 'nowhere x x) (funcall x x) 3))",
            "(1 55 55 3)",
        ),
        ("(list 1 (throw 'nowhere 2) 3)", "(1 55 3)"),
        ("(flet ((f (x) x)) (list 1 (f) (f 2 3) 3))", "(1 55 55 3)"),
        (
            "(progn (defgeneric g (x)) (list 1 (g 2) (g) 3))",
            "(1 55 55 3)",
        ),
    ] {
        assert_eq!(evaluate_with_55(form), expected, "{form}");
    }
}

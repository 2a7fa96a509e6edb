//! Code that is interrupted at any of its polls.

use crate::compile::compile_lambda;
use crate::image::Image;
use crate::print;
use crate::reader;
use crate::value::Value;
use crate::value::symbol::known;
use crate::vm::fiber::Fiber;
use crate::vm::machine::{Event, Machine};

/// Evaluates a form, interrupted at one of its polls and continued; and the number of its polls. There
/// is no value if it was interrupted within a builtin, such as the compiler.
fn evaluate_interrupted(text: &str, at: Option<u64>) -> (Option<String>, u64) {
    let mut image = Image::new();
    let source = image.sources.add("test", text);
    let forms = reader::read_all(&mut image, source).unwrap_or_else(|e| panic!("{e}"));
    let form = forms
        .into_iter()
        .next()
        .map_or(Value::NIL, |(form, _)| form);
    image.limits.polls.begin(at);
    let mut fiber = Fiber::default();
    let mut machine = Machine::new(&mut image, &mut fiber);
    let mut event = machine.start(known::EVAL.into(), vec![form]);
    loop {
        match event {
            Event::Interrupted => {
                // What stands still can be looked at.
                assert!(!machine.calls().is_empty());
                event = machine.run();
            }
            Event::Done(value) => {
                let polls = machine.image.limits.polls.count();
                return (Some(print::to_string(&image, &value, true)), polls);
            }
            Event::Unhandled(condition) => {
                assert_eq!(print::to_string(&image, &condition, false), "Interrupted.");
                return (None, 0);
            }
            _ => panic!("{text} has stopped"),
        }
    }
}

#[test]
fn code_that_is_interrupted_at_any_poll_goes_on_as_if_it_had_not_been() {
    for form in [
        "(labels ((tak (x y z) (if (< y x) (tak (tak (1- x) y z) (tak (1- y) z x) (tak (1- z) x y)) z)))
           (tak 12 8 4))",
        "(progn
           (defun ctak (x y z)
             (if (< y x)
                 (ctak (catch 'v (ctak (1- x) y z)) (catch 'v (ctak (1- y) z x))
                       (catch 'v (ctak (1- z) x y)))
                 (throw 'v z)))
           (catch 'v (ctak 12 8 4)))",
        "(let ((l nil) (sum 0))
           (dotimes (i 300) (push i l))
           (dotimes (i 10)
             (do ((rest l (cdr rest))) ((null rest)) (rplaca rest (+ (car rest) i)))
             (setq l (nreverse l))
             (dolist (x l) (setq sum (+ sum x))))
           (list sum (length l) (car l)))",
        "(progn
           (defvar *depth* 0)
           (defun down (n) (let ((*depth* (1+ *depth*))) (if (= n 0) *depth* (+ (down (- n 1)) (down (- n 1))))))
           (list (down 11) *depth*))",
        "(progn
           (defclass counter () ((count :initform 0 :accessor counted)))
           (defgeneric advance (counter n))
           (defmethod advance ((counter counter) n) (incf (counted counter) n))
           (defmethod advance :around (counter (n float)) (call-next-method))
           (let ((counter (make-instance 'counter)))
             (dotimes (i 300) (advance counter i) (advance counter 1.0))
             (counted counter)))",
        "(let ((v (make-array 50 :initial-element 1)) (log nil))
           (dotimes (i 1500)
             (let ((k (mod i 50)))
               (block nil
                 (unwind-protect
                     (funcall (lambda () (if (evenp i) (return) (setf (aref v k) (+ (aref v k) i)))))
                   (push k log)))))
           (list v (length log)))",
        "(progn
           (defun turn (n) (if (= n 900) (redefine n) (turn (1+ n))))
           (defun redefine (n)
             (eval '(defun turn (n) (if (= n 1900) (list 'new n) (turn (1+ n)))))
             (turn n))
           (turn 0))",
        "(let ((tries 0))
           (dotimes (i 1500 tries)
             (handler-case (let ((x 'a)) (+ i x))
               (type-error () (incf tries)))))",
    ] {
        let (expected, polls) = evaluate_interrupted(form, None);
        let mut continued = 0;
        for at in 1..=polls {
            let (value, _) = evaluate_interrupted(form, Some(at));
            if value.is_some() {
                assert_eq!(value, expected, "{form} at {at}");
                continued += 1;
            }
        }
        assert!(continued > 3, "{form}");
    }
}

/// Evaluates a form that is interrupted at one of its polls. Where that leaves a call or a computation
/// in the middle, its value is 55. Returns the value and the number of polls.
fn evaluate_answering(text: &str, at: Option<u64>) -> Option<(String, u64)> {
    let mut image = Image::new();
    let source = image.sources.add("test", text);
    let forms = reader::read_all(&mut image, source).unwrap_or_else(|e| panic!("{e}"));
    let (form, _) = forms.into_iter().next()?;
    let lambda = Value::list([known::LAMBDA.into(), Value::NIL, form]);
    let function = compile_lambda(&mut image, &lambda).unwrap_or_else(|_| panic!("{text}"));
    image.limits.polls.begin(at);
    let mut fiber = Fiber::default();
    let mut machine = Machine::new(&mut image, &mut fiber);
    let mut event = machine.start(Value::Function(function), Vec::new());
    loop {
        event = match event {
            Event::Interrupted => machine.run(),
            Event::Unhandled(condition) => {
                if print::to_string(machine.image, &condition, false) != "Interrupted." {
                    // 55 was not what comes next.
                    return None;
                }
                machine.resume(Value::Int(55))
            }
            Event::Done(value) => {
                let polls = machine.image.limits.polls.count();
                return Some((print::to_string(&image, &value, true), polls));
            }
            _ => panic!("{text} has stopped"),
        };
    }
}

#[test]
fn a_value_in_place_of_what_was_left_by_an_interrupt_evaluates_nothing_again() {
    for (form, whole, answered) in [
        (
            "(let ((l (make-list 100000)) (n 0)) (list 10 (incf n) (length l) n 20))",
            "(10 1 100000 1 20)",
            "(10 1 55 1 20)",
        ),
        (
            "(let ((l (make-list 100000)) (n 0)) (list 10 (incf n) (funcall #'length l) n 20))",
            "(10 1 100000 1 20)",
            "(10 1 55 1 20)",
        ),
        (
            "(let ((x (1+ (ash 1 300000))) (n 0)) (list 10 (incf n) (eql (* x x) 55) n 20))",
            "(10 1 NIL 1 20)",
            "(10 1 T 1 20)",
        ),
    ] {
        let polls = evaluate_answering(form, None).map_or(0, |(_, polls)| polls);
        let values: Vec<String> = (1..=polls)
            .filter_map(|at| evaluate_answering(form, Some(at)))
            .map(|(value, _)| value)
            .collect();
        assert!(
            values.iter().any(|value| value == answered),
            "{form}: {polls} polls"
        );
        for value in values {
            assert!(value == whole || value == answered, "{form}: {value}");
        }
    }
}

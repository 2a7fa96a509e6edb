//! Waiting for values, changes and pulses of fluents.

use super::prompt::check;

#[test]
fn a_value_a_change_and_a_pulse_are_waited_for_differently() {
    check(&[
        (
            "(let ((f (make-fluent))) (list (wait-for f :timeout 1) (wait-for (fl-value-changed f) :timeout 1)))",
            "(NIL NIL)",
        ),
        (
            "(let ((f (make-fluent :value :set))) (list (wait-for f) (wait-for (fl-value-changed f) :timeout 1) (wait-for (pulsed f) :timeout 1)))",
            "(:SET NIL NIL)",
        ),
        (
            "(let ((f (make-fluent :value :set)) l) (tl (par (push (wait-for (fl-value-changed f)) l) (push (wait-for (pulsed f)) l) (seq (sleep 1) (setf (value f) :other)))) l)",
            "(T T)",
        ),
        (
            "(flet ((now () (/ (get-internal-real-time) internal-time-units-per-second))) (let ((from (now))) (wait-for (make-fluent) :timeout 2) (- (now) from)))",
            "2",
        ),
    ]);
}

#[test]
fn all_that_wait_for_a_network_are_woken() {
    check(&[
        (
            "(let ((f (make-fluent :value :x)) (n 0)) (tl (par (par-loop (i '(1 2 3 4 5 6 7 8 9 10)) (wait-for (not (eq f :x))) (incf n)) (seq (sleep 0.1) (setf (value f) :y)))) n)",
            "10",
        ),
        (
            // A change to a value that is not awaited wakes nobody.
            "(let ((f (make-fluent :value 0)) (n 0) early) (tl (par (par-loop (i '(1 2 3 4 5 6 7 8 9 10)) (wait-for (fl-funcall #'member f '(2 3))) (incf n)) (seq (sleep 0.1) (setf (value f) 1) (sleep 1) (setf early n) (setf (value f) 3)))) (list early n))",
            "(0 10)",
        ),
        (
            "(let* ((a (make-fluent :value 0)) (b (make-fluent :value 0)) (s (+ a b))) (tl (par (dotimes (i 100) (incf (value a))) (dotimes (i 100) (incf (value b))) (wait-for (= s 200)))) (value s))",
            "200",
        ),
    ]);
}

#[test]
fn bodies_of_whenever_run_as_often_as_they_should() {
    check(&[
        (
            "(let (ran) (list (tl (pursue (whenever ((make-fluent)) (setf ran t)) (seq (sleep 5) :hung))) ran))",
            "(:HUNG NIL)",
        ),
        (
            "(let (ran (f (make-fluent))) (list (tl (pursue (whenever (f) (setf ran t) (sleep 1)) (seq (dotimes (i 5) (pulse f) (sleep 1)) :hung))) ran))",
            "(:HUNG NIL)",
        ),
        (
            "(let ((f (make-fluent))) (tl (par (whenever (f) (return 42)) (seq (sleep 1) (setf (value f) t)))))",
            "42",
        ),
        (
            // The body takes longer than the pulses.
            "(let ((f (make-fluent)) (n 0)) (tl (pursue (whenever ((pulsed f :handle-missed-pulses :always)) (incf n) (sleep 0.3)) (seq (sleep 0.1) (setf (value f) 1) (dotimes (i 4) (pulse f)) (sleep 9)))) n)",
            "5",
        ),
        (
            // 25 consumers, each with its own speed, see each of 50 pulses.
            "(let ((f (make-fluent :value 0)) (counts (make-array 25 :initial-element 0))) (tl (pursue (par-loop (i (loop for i below 25 collect i)) (whenever ((pulsed f :handle-missed-pulses :always)) (incf (aref counts i)) (sleep (* 0.01 (1+ (mod i 4)))))) (seq (sleep 0.1) (dotimes (i 50) (pulse f) (when (oddp i) (sleep 0.001))) (sleep 60)))) (remove-duplicates counts))",
            "#(50)",
        ),
    ]);
}

#[test]
fn networks_over_the_states_of_tasks() {
    check(&[
        (
            "(let (f before) (tl (with-tags (par (:tag a (sleep 1)) (seq (sleep 0.5) (setf f (fl-funcall #'cl:eq (status a) :running)) (setf before (value f)))) (list (typep f 'fluent) before (value f)))))",
            "(T T NIL)",
        ),
        (
            // Fluents inside a list are data.
            "(tl (with-tags (par (fl-funcall #'find :running (list (status a))) (:tag a (sleep 1)))))",
            "NIL",
        ),
        (
            // Those of a spread list are arguments.
            "(let (f before) (tl (with-tags (par (:tag a (sleep 1)) (:tag b (sleep 2)) (seq (sleep 0.5) (setf f (cpl-impl:fl-apply (lambda (x y) (find :running (list x y))) (status a) (list (status b)))) (setf before (value f)))) (list (typep f 'fluent) before (value f)))))",
            "(T :RUNNING NIL)",
        ),
        (
            "(def-cpl-parameter *knobs* 42) (let ((before *knobs*)) (setf *knobs* (list 2)) (push 1 *knobs*) (list before *knobs*))",
            "(42 (1 2))",
        ),
    ]);
}

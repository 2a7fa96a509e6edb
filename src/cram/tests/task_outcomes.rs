//! What tasks end as, and what their ends leave of others, in hierarchies and combinators.

use super::prompt::check;

#[test]
fn children_end_before_their_parents() {
    check(&[
        (
            "(tl (with-tags (:tag p (par (:tag c (sleep 0.025)) (sleep 0.1))) (list (value (status p)) (value (status c)))))",
            "(:SUCCEEDED :SUCCEEDED)",
        ),
        (
            "(tl (with-tags (:tag p (pursue (:tag c (wait-for *never*)) (sleep 0.025))) (list (value (status p)) (value (status c)))))",
            "(:SUCCEEDED :EVAPORATED)",
        ),
        (
            "(tl (with-tags (with-failure-handling ((plan-failure (e) (return nil))) (:tag p (pursue (:tag c (sleep 9)) (seq (sleep 0.1) (fail))))) (list (value (status p)) (value (status c)))))",
            "(:FAILED :EVAPORATED)",
        ),
        (
            // Three levels: a task, 20 children, and one to five children of each of these.
            "(let (tasks) (tl (with-tags (:tag p (par-loop (i (loop for i below 20 collect i)) (push *current-task* tasks) (par-loop (j (loop for j to (mod i 5) collect j)) (push *current-task* tasks) (sleep (* 0.01 j))) (sleep 0.05)) (sleep 0.1)) (push p tasks))) (list (length tasks) (remove-duplicates (mapcar (lambda (task) (value (status task))) tasks))))",
            "(81 (:SUCCEEDED))",
        ),
    ]);
}

#[test]
fn suspension_of_parents_and_of_children() {
    check(&[
        (
            "(let ((knob (make-fluent)) log) (tl (with-tags (par (:tag p (par (:tag c (wait-for knob)))) (seq (sleep 0.1) (with-task-suspended (p) (push (value (status c)) log) (setf (value knob) t) (sleep 1) (push (task-dead-p c) log)))) (append (reverse log) (list (value (status p)) (value (status c)))))))",
            "(:SUSPENDED NIL :SUCCEEDED :SUCCEEDED)",
        ),
        (
            "(let (log) (tl (with-tags (par (:tag p (pursue (:tag c (wait-for *never*)) (sleep 1))) (seq (sleep 0.1) (suspend c) (sleep 0.1) (setf log (list (value (status p)) (value (status c)))))) (append log (list (value (status p)) (value (status c)))))))",
            "(:RUNNING :SUSPENDED :SUCCEEDED :EVAPORATED)",
        ),
        (
            // The child is woken at the moment at which the parent's other child ends.
            "(tl (with-tags (par (:tag p (pursue (:tag c (wait-for *never*)) (sleep 1))) (seq (sleep 0.1) (suspend c) (sleep 0.9) (wake-up c))) (list (value (status p)) (value (status c)))))",
            "(:SUCCEEDED :EVAPORATED)",
        ),
        (
            // Who is suspended for a time notices no less of it.
            "(let (from to) (flet ((now () (/ (get-internal-real-time) internal-time-units-per-second))) (tl (with-tags (par (:tag held (on-suspension (setf from (now)) (sleep 0.6)) (setf to (now))) (seq (sleep 0.5) (with-task-suspended (held) (sleep 0.25)))))) (<= 1/4 (- to from))))",
            "T",
        ),
        (
            // After suspension and waking up a task can be ended.
            "(tl (with-tags (par (:tag waiter (wait-for *never*)) (:tag controller (sleep 0.1) (suspend waiter) (sleep 0.1) (wake-up waiter) (sleep 0.1) (evaporate waiter))) (list (value (status waiter)) (value (status controller)))))",
            "(:EVAPORATED :SUCCEEDED)",
        ),
    ]);
}

#[test]
fn of_those_that_end_at_one_moment_the_first_decides() {
    check(&[(
        "(let ((go (make-fluent))) (tl (with-tags (with-failure-handling ((plan-failure (e) (return nil))) (pursue (:tag winner (wait-for go)) (:tag loser (wait-for go) (fail)) (:tag third (sleep 99)) (seq (sleep 1) (setf (value go) t) (sleep 99)))) (sleep 1) (list (not (task-running-p winner)) (not (task-running-p loser)) (value (status third))))))",
        "(T T :EVAPORATED)",
    )]);
}

#[test]
fn errors_keep_their_class_across_tasks() {
    check(&[
        (
            "(tl (with-failure-handling ((error (e) (return (list (type-of e) (princ-to-string e))))) (pursue (error \"plain\") (sleep 9))))",
            "(SIMPLE-ERROR \"plain\")",
        ),
        (
            // A plan failure is not an error.
            "(handler-case (tl (with-failure-handling ((error (e) (return :error))) (fail \"x\"))) (plan-failure () :failure))",
            ":FAILURE",
        ),
        (
            "(let ((*debug-on-lisp-errors* nil)) (handler-case (tl (par (par (error \"deep\") (sleep 9)) (sleep 9))) (error (e) (type-of e))))",
            "SIMPLE-ERROR",
        ),
        (
            "(let ((*debug-on-lisp-errors* nil)) (tl (with-failure-handling ((error (e) (return (princ-to-string e)))) (par (par (error \"deep\") (sleep 9)) (sleep 9)))))",
            "\"deep\"",
        ),
    ]);
}

#[test]
fn attempts_are_made_until_one_succeeds() {
    check(&[
        (
            "(let (l) (handler-case (tl (try-all (seq (push 1 l) (fail)) (seq (push 2 l) (fail)) (seq (push 3 l) (fail)))) (composite-failure (c) (list (length (composite-failures c)) (sort l #'cl:<)))))",
            "(3 (1 2 3))",
        ),
        (
            "(let (l) (tl (try-in-order (seq (push 'a l) (fail) (push 'x l)) (seq (push 'b l) (fail) (push 'y l)) (seq (push 'c l) (fail) (push 'z l)) (seq (push 'd l) (sleep 1) (push 4 l)) (push 5 l))) (reverse l))",
            "(A B C D 4)",
        ),
        (
            "(let (l) (handler-case (tl (try-in-order (seq (push 1 l) (fail)) (seq (push 2 l) (fail)) (seq (push 3 l) (fail)))) (composite-failure () (reverse l))))",
            "(1 2 3)",
        ),
        ("(tl (try-each-in-order (x '(1 2 3)) x))", "1"),
        (
            "(let (l) (handler-case (tl (try-each-in-order (x '(1 2 3)) (push x l) (fail))) (composite-failure () (reverse l))))",
            "(1 2 3)",
        ),
    ]);
}

#[test]
fn orders_hold_between_the_tasks_that_they_name() {
    check(&[
        (
            "(let (l) (tl (with-tags (partial-order ((:tag one (sleep 0.2) (push 1 l)) (:tag two (push 2 l)) (:tag three (push 3 l))) (:order one three) (:order three two)))) (reverse l))",
            "(1 3 2)",
        ),
        (
            "(let (l) (tl (with-tags (partial-order ((:tag c (push :c l)) (:tag a (sleep 1) (push :a l)) (:tag b (sleep 0.5) (push :b l))) (:order a c) (:order b c)))) (reverse l))",
            "(:B :A :C)",
        ),
    ]);
}

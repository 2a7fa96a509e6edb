//! Tasks among each other: what fails, ends, waits and goes on when.

use super::prompt::{Prompt, check};

#[test]
fn children_of_one_form_talk_through_fluents() {
    check(&[
        (
            "(let ((f (make-fluent))) (tl (par (seq (setf (value f) :ping) (wait-for (eq f :pong)) :done) (seq (wait-for (eq f :ping)) (setf (value f) :pong)))))",
            ":DONE",
        ),
        (
            "(let ((v (vector 0 0))) (tl (par (setf (aref v 0) 1) (setf (aref v 1) 2))) v)",
            "#(1 2)",
        ),
    ]);
}

#[test]
fn a_failure_ends_the_siblings_before_they_go_on() {
    check(&[
        (
            "(let (flag) (handler-case (tl (par (seq (sleep 0.01) (fail)) (seq (sleep 1) (setf flag t)))) (plan-failure () nil)) flag)",
            "NIL",
        ),
        (
            "(tl (with-tags (with-failure-handling ((plan-failure (e) (return nil))) (par (:tag producer (sleep 0.1) (fail)) (:tag w1 (par (:tag w2 (loop (sleep 0.01))) (:tag w3 (loop (sleep 0.01))))))) (sleep 1) (mapcar (lambda (task) (value (status task))) (list producer w1 w2 w3))))",
            "(:FAILED :EVAPORATED :EVAPORATED :EVAPORATED)",
        ),
        (
            "(tl (with-tags (with-failure-handling ((plan-failure (e) (return nil))) (pursue (:tag a (sleep 0.2)) (:tag b (sleep 0.05) (fail)))) (sleep 1) (list (value (status a)) (value (status b)))))",
            "(:EVAPORATED :FAILED)",
        ),
        (
            "(let (l) (tl (with-tags (pursue (:tag a (sleep 0.2) (push :a l)) (:tag b (sleep 0.05) (push :b l))) (push (value (status a)) l) (push (value (status b)) l))) (reverse l))",
            "(:B :EVAPORATED :SUCCEEDED)",
        ),
        (
            "(let (l) (tl (with-tags (try-all (:tag a (push :a l)) (seq (sleep 0.5) (push :b l))) (push (value (status a)) l))) (sleep 1) (reverse l))",
            "(:A :SUCCEEDED)",
        ),
    ]);
}

#[test]
fn tags_add_no_parallelism() {
    check(&[(
        "(let (l) (tl (with-tags (seq (:tag a (sleep 0.5) (push :a l)) (:tag b (sleep 0.1) (push :b l)) (:tag c (push :c l)) (:tag d (sleep 0.2) (push :d l)) (:tag e (push :e l))))) (reverse l))",
        "(:A :B :C :D :E)",
    )]);
}

#[test]
fn tags_are_found_in_macros_and_all_forms_but_not_in_data() {
    check(&[
        (
            "(defmacro tagged-twice (form) `(seq (:tag one ,form) (:tag two ,form))) (tl (with-tags (tagged-twice 5) (list (result one) (result two))))",
            "(5 5)",
        ),
        (
            "(tl (with-tags (let ((x 1)) (flet ((f () (:tag a (1+ x)))) (mapcar (lambda (y) (:tag b y)) '(7)) (f))) (list (result a) (result b))))",
            "(2 7)",
        ),
        ("(tl (with-tags '(:tag a 1)))", "(:TAG A 1)"),
        ("(let ((a 5)) (tl (with-tags (case :tag (:tag a)))))", "5"),
        (
            "(def-cram-function tagging () (:tag a 1) (value (status a))) (tl (tagging))",
            ":SUCCEEDED",
        ),
    ]);
}

#[test]
fn suspension_freezes_a_subtree() {
    check(&[
        (
            "(tl (with-tags (par (:tag a (sleep 9)) (seq (sleep 1) (with-task-suspended (a) (value (status a))) (prog1 (value (status a)) (evaporate a))))))",
            "",
        ),
        (
            "(tl (with-tags (pursue (seq (:tag a (sleep 9))) (seq (sleep 1) (list (with-task-suspended (a) (value (status a))) (value (status a)))))))",
            "(:SUSPENDED :RUNNING)",
        ),
        (
            "(let ((f (make-fluent))) (tl (with-tags (par (:tag a (pursue (seq (wait-for f) :a) (seq (wait-for f) (sleep 1) :b) (seq (wait-for f) (sleep 1) :c))) (seq (sleep 1) (with-task-suspended (a) (setf (value f) t) (sleep 1)))))))",
            ":A",
        ),
        (
            "(let ((f (make-fluent)) (n 0) (seen nil)) (tl (with-tags (par (:tag a (par-loop (i '(1 2 3 4 5)) (wait-for f) (incf n))) (seq (sleep 1) (with-task-suspended (a) (setf (value f) t) (sleep 0.1) (setf seen n)))))) (list seen n))",
            "(0 5)",
        ),
        (
            "(let ((knob (make-fluent))) (tl (with-tags (with-failure-handling ((f1 (e) (return :failed))) (par (:tag a (pursue (seq (wait-for knob) (fail 'f1)) (sleep 9))) (seq (sleep 1) (with-task-suspended (a) (setf (value knob) t) (sleep 1))))))))",
            ":FAILED",
        ),
        (
            // A suspended task can be ended.
            "(tl (with-tags (par (:tag a (sleep 9)) (seq (sleep 1) (suspend a) (evaporate a))) (value (status a))))",
            ":EVAPORATED",
        ),
        (
            // Only the child is suspended; the parent ends it.
            "(tl (with-tags (:tag p (pursue (:tag c (sleep 9)) (seq (sleep 1) (suspend c) (sleep 1) :done))) (list (result p) (value (status c)))))",
            "(:DONE :EVAPORATED)",
        ),
        (
            // Grandchildren that are being started at that moment are held, too.
            "(let ((n 0) (go (make-fluent))) (tl (with-tags (par (:tag a (wait-for go) (par (par (incf n) (incf n)) (par (incf n) (incf n)))) (seq (setf (value go) t) (with-task-suspended (a) (let ((m n)) (sleep 0.1) (list m n))))))) n)",
            "4",
        ),
        (
            "(let ((n 0) (go (make-fluent)) seen) (tl (with-tags (par (:tag a (wait-for go) (par (par (incf n) (incf n)) (par (incf n) (incf n)))) (seq (setf (value go) t) (with-task-suspended (a) (let ((m n)) (sleep 0.1) (setf seen (= m n)))))))) (list seen n))",
            "(T 4)",
        ),
        (
            // A task that is suspended before it begins is suspended where it may first wait, even if
            // there is nothing to wait for any more.
            "(let ((f (make-fluent)) l) (tl (with-tags (par (seq (suspend a) (setf (value f) t) (sleep 1) (push (value (status a)) l) (wake-up a)) (:tag a (push :begun l) (sleep 0) (push :on l))))) (reverse l))",
            "(:BEGUN :SUSPENDED :ON)",
        ),
        (
            "(let (l) (tl (with-tags (par (seq (suspend a) (sleep 1) (evaporate a)) (:tag a (sleep 0) (push :on l))))) l)",
            "NIL",
        ),
        (
            // A sleep goes on while the task is suspended, its end waits.
            "(tl (with-tags (par (seq (:tag a (sleep 1)) :a) (seq (with-task-suspended (a) (sleep 5))))))",
            ":A",
        ),
    ]);
}

#[test]
fn a_task_that_returns_ends_what_is_below_it() {
    check(&[
        (
            "(tl (with-tags (with-failure-handling ((f1 (e) (return :handled))) (:tag p (par (:tag c1 (fail 'f1)) (:tag c2 (sleep 9))))) (sleep 0.1) (mapcar (lambda (task) (value (status task))) (list p c1 c2))))",
            "(:FAILED :FAILED :EVAPORATED)",
        ),
        (
            "(tl (with-tags (par (:tag p (par (:tag c (sleep 9)))) (seq (sleep 1) (evaporate p))) (list (value (status p)) (value (status c)))))",
            "(:EVAPORATED :EVAPORATED)",
        ),
        (
            "(tl (with-tags (par (:tag p (par (:tag c (sleep 9)) 1)) (seq (sleep 1) (evaporate c))) (list (value (status p)) (value (status c)))))",
            "(:SUCCEEDED :EVAPORATED)",
        ),
    ]);
}

#[test]
fn cleanup_may_take_time() {
    check(&[
        (
            "(let (l) (tl (pursue (unwind-protect (sleep 9) (sleep 1) (push :slow l)) (sleep 1))) (push :after l) (reverse l))",
            "(:SLOW :AFTER)",
        ),
        (
            // The plan is over when the siblings of the failure have cleaned up.
            "(let (l) (handler-case (tl (par (unwind-protect (sleep 9) (sleep 1) (push :slow l)) (fail))) (plan-failure () (push :handled l))) (sleep 5) (reverse l))",
            "(:HANDLED :SLOW)",
        ),
        (
            // Cleanup that never ends does not hold up the others for ever.
            "(tl (pursue (unwind-protect (sleep 9) (wait-for *never*)) :won))",
            ":WON",
        ),
        (
            // An error in cleanup code does not stop the rest of it.
            "(let (l) (tl (pursue (unwind-protect (unwind-protect (sleep 9) (error \"x\")) (push :outer l)) :won)) l)",
            "(:OUTER)",
        ),
        (
            // Cleanup code that leaves to a block cannot keep the task alive.
            "(tl (pursue (loop (block b (unwind-protect (sleep 9) (return-from b 1)))) :won))",
            ":WON",
        ),
    ]);
}

#[test]
fn pulses_are_counted() {
    check(&[
        (
            "(let ((f (make-fluent :value 0)) (n 0)) (tl (pursue (whenever ((pulsed f :handle-missed-pulses :always)) (incf n)) (seq (setf (value f) 1) (dotimes (i 4) (pulse f)) (sleep 1)))) n)",
            "5",
        ),
        (
            "(let ((f (make-fluent)) (n 0)) (tl (pursue (par-loop (i '(1 2 3 4 5 6 7 8 9 10)) (wait-for (pulsed f)) (incf n)) (seq (sleep 1) (pulse f) (sleep 1)))) n)",
            "10",
        ),
        (
            "(let ((f (make-fluent :value 0)) (seen nil)) (tl (pursue (whenever ((pulsed f :handle-missed-pulses :once)) (push (value f) seen) (sleep 0.5)) (seq (loop for i from 1 to 9 do (setf (value f) i) (sleep 0.1)) (sleep 2)))) (first seen))",
            "9",
        ),
        (
            "(let ((f (make-fluent :value 1))) (tl (pursue (seq (wait-for (fl-value-changed f)) :changed) (seq (pulse f) (sleep 1) :only-pulsed))))",
            ":ONLY-PULSED",
        ),
        (
            "(let ((f (make-fluent :value :x)) (n 0)) (tl (par (par-loop (i '(1 2 3)) (wait-for (not (eq f :x))) (incf n)) (seq (sleep 1) (setf (value f) :y)))) n)",
            "3",
        ),
        (
            "(let ((f (make-fluent :value 0))) (tl (par (wait-for (fl-funcall #'member f '(2 3))) (seq (sleep 1) (setf (value f) 3)))))",
            "(3)",
        ),
        (
            "(let* ((a (make-fluent :value 0)) (b (make-fluent :value 0)) (s (+ a b)) (n 0)) (register-update-callback s :n (lambda (v) (setf n v))) (tl (par (dotimes (i 100) (incf (value a)) (sleep 0.01)) (dotimes (i 100) (incf (value b)) (sleep 0.01)))) n)",
            "200",
        ),
    ]);
}

#[test]
fn joining() {
    check(&[
        (
            "(tl (with-tags (par (:tag a (sleep 1) (values 1 2)) (multiple-value-list (join-task a)))))",
            "1 ; 2",
        ),
        (
            "(tl (with-tags (par (join-task a) (:tag a (sleep 1) :a))))",
            "!! SIMPLE-ERROR The task A has not begun: nothing runs it.",
        ),
        (
            "(tl (with-tags (par (seq (sleep 0.1) (join-task a)) (:tag a (sleep 1) :a))))",
            ":A",
        ),
        (
            "(tl (join-task *current-task*))",
            "!! SIMPLE-ERROR Cannot join current task.",
        ),
    ]);
}

#[test]
fn a_deadlock_names_who_waits_for_what() {
    let mut prompt = Prompt::new();
    let shown = prompt.eval(
        "(tl (with-tags (par (:tag a (wait-for *never*)) (:tag b (wait-for (not (status a)))))))",
    );
    assert!(
        shown.starts_with("!! SIMPLE-ERROR Nothing can continue"),
        "{shown}"
    );
    assert!(
        shown.contains("A waits for #<FLUENT NEVER [NIL]>."),
        "{shown}"
    );
}

#[test]
fn nothing_is_left_over_of_an_aborted_plan() {
    let mut prompt = Prompt::new();
    let shown = prompt.eval("(tl (par (sleep 9) (par (sleep 9) (seq (sleep 1) (fail \"x\")))))");
    assert_eq!(shown, "!! SIMPLE-PLAN-FAILURE x");
    assert!(prompt.scheduler.tasks(&prompt.image).is_empty());
    assert_eq!(prompt.scheduler.depth(), 0);
    assert_eq!(prompt.eval("(tl (par 1 2))"), "1");
}

#[test]
fn simulated_time_costs_none() {
    let mut prompt = Prompt::new();
    prompt.eval("(sleep 100000000)");
    assert_eq!(prompt.scheduler.now(&prompt.image), 1e8);
}

#[test]
fn finished_tasks_are_forgotten() {
    let mut prompt = Prompt::new();
    let shown = prompt.eval(
        "(def-cram-function one-step (i) i) (tl (dotimes (i 20000 :done) (par (one-step i) 2)))",
    );
    assert_eq!(shown, ":DONE");
    assert!(prompt.scheduler.tasks(&prompt.image).is_empty());
}

#[test]
fn tasks_nest_deeply() {
    check(&[
        (
            "(def-cram-function down (n) (if (= n 0) :bottom (down (- n 1)))) (tl (down 20000))",
            ":BOTTOM",
        ),
        (
            "(def-cram-function down (n) (if (= n 0) (fail 'f3) (down (- n 1)))) (tl (down 20000))",
            "!! F3 f3 report text",
        ),
        (
            "(def-cram-function down (n) (if (= n 0) (sleep 9) (down (- n 1)))) (tl (pursue (down 20000) (sleep 1)))",
            "NIL",
        ),
        (
            "(let ((f (make-fluent :value 0))) (value (reduce #'+ (loop for i below 20000 collect 1) :initial-value f)))",
            "20000",
        ),
    ]);
}

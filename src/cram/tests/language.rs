//! The plan language, example by example.

use super::prompt::check;

#[test]
fn top_level() {
    check(&[
        ("(tl 1 2 3)", "3"),
        ("(tl (values 1 2))", "1 ; 2"),
        ("(tl)", "NIL"),
        (
            "(tl (tl 1))",
            "!! SIMPLE-ERROR top-level calls cannot be nested.",
        ),
        ("(tl (fail 'f3))", "!! F3 f3 report text"),
        ("(tl (error \"plain\"))", "!! SIMPLE-ERROR plain"),
        (
            "(def-top-level-cram-function main (x) (list x cpl-impl:*current-path*)) (main 3)",
            "(3 ((TOP-LEVEL MAIN)))",
        ),
        (
            "(def-top-level-cram-function main (x) x) (tl (main 3))",
            "!! SIMPLE-ERROR top-level calls cannot be nested.",
        ),
        (
            "(def-top-level-cram-function main () 1) (main) (cpl:get-top-level-task-tree 'main)",
            "#<TASK-TREE-NODE :PATH NIL :CHILD-COUNT 1 {…",
        ),
        (
            "(def-top-level-cram-function main () (values 1 2)) (main)",
            "1 ; 2",
        ),
        (
            "(def-top-level-cram-function main () (fail 'f1)) (with-failure-handling ((f1 (e) (return :outside))) (main))",
            ":OUTSIDE",
        ),
        ("(cpl-impl::named-top-level (:name :x) 1 2)", "2"),
        ("(tl (return 5) 6)", "5"),
        (
            "(let ((*x* 1)) (declare (special *x*)) (tl (boundp '*x*)))",
            "NIL",
        ),
    ]);
}

#[test]
fn parallel_forms() {
    check(&[
        ("(tl (par 1 2 3))", "1"),
        ("(tl (par (seq (sleep 0.2) :slow) :fast))", ":SLOW"),
        ("(tl (par (values 1 2) (values 3 4)))", "1 ; 2"),
        ("(tl (par nil))", "NIL"),
        (
            "(tl (par))",
            "!! SIMPLE-ERROR wait-for called with nil argument.",
        ),
        (
            "(tl (par (fail \"boo\") (sleep 1)))",
            "!! SIMPLE-PLAN-FAILURE boo",
        ),
        (
            "(let ((x 0)) (tl (par (setf x 1) (seq (sleep 0.05) (setf x (+ x 10))))) x)",
            "11",
        ),
        ("(tl (pursue (seq (sleep 0.2) :a) :b))", ":B"),
        (
            "(tl (pursue (seq (sleep 0.2) :a) (fail \"x\")))",
            "!! SIMPLE-PLAN-FAILURE x",
        ),
        ("(tl (pursue 1))", "1"),
        (
            "(tl (pursue))",
            "!! SIMPLE-ERROR wait-for called with nil argument.",
        ),
        (
            "(let (l) (tl (pursue (unwind-protect (sleep 3) (push :evap l)) (seq (sleep 0.1) 1))) l)",
            "(:EVAP)",
        ),
        ("(tl (try-all (fail \"a\") :ok))", ":OK"),
        (
            "(tl (try-all (seq (sleep 0.2) 1) (seq (sleep 0.1) 2)))",
            "2",
        ),
        (
            "(tl (try-all (fail \"a\") (fail \"b\")))",
            "!! COMPOSITE-FAILURE …",
        ),
        (
            "(handler-case (tl (try-all (fail \"a\") (fail \"b\"))) (composite-failure (c) (mapcar #'princ-to-string (composite-failures c))))",
            "(\"b\" \"a\")",
        ),
        (
            "(tl (try-all))",
            "!! SIMPLE-ERROR wait-for called with nil argument.",
        ),
        ("(tl (try-in-order (fail \"a\") 2 3))", "2"),
        ("(tl (try-in-order))", "!! COMPOSITE-FAILURE …"),
        (
            "(tl (try-in-order (error \"lisp\") 2))",
            "!! SIMPLE-ERROR lisp",
        ),
        (
            "(tl (with-failure-handling ((f1 (e) (return :f1))) (try-in-order (fail \"a\") (fail 'f1))))",
            "!! COMPOSITE-FAILURE …",
        ),
        (
            "(tl (try-each-in-order (x '(1 2 3)) (if (oddp x) (fail \"odd ~a\" x) (* 10 x))))",
            "20",
        ),
        ("(tl (try-each-in-order (x '(1 2)) (values x 2)))", "1 ; 2"),
        ("(tl (par-loop (x '(1 2 3)) (* x x)))", "1"),
        ("(tl (par-loop (x '()) x))", "NIL"),
        (
            "(tl (with-tags (partial-order ((:tag a (sleep 0.05) 1) (:tag b 2)) (:order a b))))",
            "1",
        ),
        ("(par 1 2)", "!! SIMPLE-ERROR 'PAR' form not inside a plan."),
        ("(tl (seq (values 1 2)))", "1 ; 2"),
        (
            "(let (l) (tl (seq (push 1 l) (sleep 0.05) (push 2 l))) l)",
            "(2 1)",
        ),
        (
            "(tl (with-failure-handling ((f1 (e) (return :stopped))) (seq 1 (fail 'f1) (print :never))))",
            ":STOPPED",
        ),
        (
            "(let (l) (tl (par-loop (x '(1 2 3)) (sleep (/ x 20.0)) (push x l))) l)",
            "(3 2 1)",
        ),
        (
            "(tl (with-failure-handling ((plan-failure (e) (return (princ-to-string e)))) (par-loop (x '(1 2 3)) (if (= x 2) (fail \"no ~a\" x) (sleep 1)))))",
            "\"no 2\"",
        ),
        (
            "(tl (try-in-order (seq (print 1) (fail \"q\")) (seq (print 2) :two)))",
            "\n1 \n2 | :TWO",
        ),
    ]);
}

#[test]
fn partial_order() {
    check(&[
        (
            "(let (l) (tl (with-tags (partial-order ((:tag a (sleep 0.1) (push :a l)) (:tag b (push :b l)) (:tag c (push :c l))) (:order a b) (:order b c)))) (reverse l))",
            "(:A :B :C)",
        ),
        (
            "(let (l) (tl (with-tags (partial-order ((:tag a (sleep 0.1) (push :a l)) (:tag b (push :b l)))))) (reverse l))",
            "(:B :A)",
        ),
        (
            "(let (l) (list (tl (with-failure-handling ((f1 (e) (return :handled))) (with-tags (partial-order ((:tag a (fail 'f1)) (:tag b (push :b l))) (:order a b))))) l))",
            "(:HANDLED NIL)",
        ),
        (
            "(tl (with-tags (partial-order ((:tag a 1) (:tag b 2)) (:order a b) (:order b a))))",
            "!! SIMPLE-ERROR The order is circular: A before B before A.",
        ),
        (
            "(tl (with-tags (partial-order ((:tag a 1)) (order a a))))",
            "!! SIMPLE-ERROR Malformed ordering constraint.",
        ),
    ]);
}

#[test]
fn functions_and_paths() {
    check(&[
        (
            "(def-cram-function greet (x &optional (y 2) &key z) (list x y z))",
            "GREET",
        ),
        (
            "(def-cram-function greet (x &optional (y 2) &key z) (list x y z)) (tl (list (greet 1) (greet 1 5 :z 9)))",
            "((1 2 NIL) (1 5 9))",
        ),
        (
            "(def-cram-function greet (x) x) (tl (greet))",
            "!! SIMPLE-PROGRAM-ERROR invalid number of arguments: 0",
        ),
        (
            "(def-cram-function greet (x) x) (greet 1)",
            "!! TYPE-ERROR The value\n  NIL\nis not of type\n  TASK-TREE-NODE",
        ),
        (
            "(def-cram-function pathy () *current-path*) (tl (pathy))",
            "((PATHY))",
        ),
        (
            "(def-cram-function pathy () *current-path*) (tl (list (pathy) (pathy) (pathy)))",
            "(((PATHY)) ((PATHY :CALL 2)) ((PATHY :CALL 3)))",
        ),
        (
            "(def-cram-function in () *current-path*) (def-cram-function out () (in)) (tl (out))",
            "((IN) (OUT))",
        ),
        (
            "(tl (with-tags (:tag a 1) (list (value (status a)) (result a) a)))",
            "(:SUCCEEDED 1 #<TASK \"A\" {…",
        ),
        (
            "(tl (with-tags (seq (:tag a 1) (:tag b 2)) (list (task-path a) (task-path b))))",
            "(((TAGGED A)) ((TAGGED B)))",
        ),
        (
            "(tl (with-tags (dotimes (i 3) (:tag a i)) (list (task-path a) (result a))))",
            "(((TAGGED A :CALL 3)) 2)",
        ),
        (
            "(mapcar-clean (lambda (x) (when (oddp x) x)) '(1 2 3))",
            "(1 3)",
        ),
        ("(mapcar-clean #'identity '(nil 1 nil 2))", "(1 2)"),
        ("(mapcar-clean #'list '())", "NIL"),
        ("(tl (with-task-tree-node (:path-part '(x 1)) 5))", "5"),
        (
            "(tl (with-task-tree-node (:path-part '(x 1)) (with-task-tree-node (:path-part '(y)) *current-path*)))",
            "((Y) (X 1))",
        ),
        (
            "(def-cram-function leave () (return-from leave :early) :late) (tl (leave))",
            ":EARLY",
        ),
        ("(tl *current-task*)", "#<TOPLEVEL-TASK \"[TOP-LEVEL]-…"),
        (
            "(declare-goal achieve-it (what)) (def-goal (achieve-it (loc ?o ?l)) (list ?o ?l)) (tl (achieve-it '(loc cup table)))",
            "(CUP TABLE)",
        ),
        (
            "(declare-goal achieve-it (what)) (def-goal (achieve-it (loc ?o ?o)) (succeed :early ?o) :late) (tl (achieve-it '(loc cup cup)))",
            ":EARLY ; CUP",
        ),
        (
            "(declare-goal achieve-it (what)) (tl (achieve-it '(zzz cup)))",
            "!! SIMPLE-ERROR No goal found that matches arguments: ACHIEVE-IT ((ZZZ CUP))",
        ),
        (
            "(def-cpl-parameter *p* 42) (tl (par (setf *p* (list *p*)))) *p*",
            "(42)",
        ),
        (
            "(def-cpl-parameter *p* '(1)) (tl (par (push 2 *p*))) *p*",
            "(2 1)",
        ),
    ]);
}

#[test]
fn fluents() {
    check(&[
        (
            "(let* ((f (make-fluent :value 1)) (g (+ f 10))) (list (value g) (progn (setf (value f) 5) (value g))))",
            "(11 15)",
        ),
        (
            "(value (fl-funcall #'list (make-fluent :value 1) 2))",
            "(1 2)",
        ),
        (
            "(let ((f (make-fluent :value nil)) (g (make-fluent :value 3))) (list (value (fl-or f g)) (value (fl-and f g)) (fl-or nil 2) (fl-and) (fl-or)))",
            "(3 NIL 2 T NIL)",
        ),
        ("(value (not (make-fluent)))", "T"),
        ("(wait-for (make-fluent :value 7))", "7"),
        ("(wait-for (make-fluent) :timeout 0.2)", "NIL"),
        (
            "(wait-for (make-fluent) :timeout 1d30)",
            "!! SIMPLE-ERROR The clock cannot wait 1e30 s: simulated time ends at 4294967296 s.",
        ),
        (
            "(sleep 1d30)",
            "!! SIMPLE-ERROR The clock cannot wait 1e30 s: simulated time ends at 4294967296 s.",
        ),
        (
            "(handler-case (sleep -1) (type-error (e) (type-error-datum e)))",
            "-1",
        ),
        ("(wait-for (< (make-fluent :value 3) 5))", "T"),
        (
            "(wait-for nil)",
            "!! SIMPLE-ERROR wait-for called with nil argument.",
        ),
        ("(wait-for 5)", "5"),
        (
            "(let ((f (make-fluent))) (tl (par (seq (sleep 0.1) (setf (value f) :go)) (wait-for f))))",
            ":GO",
        ),
        (
            "(let ((f (make-fluent :value 0))) (tl (pursue (whenever ((> f 2)) (return (list :reached (value f)))) (loop (sleep 0.02) (setf (value f) (1+ (value f)))))))",
            "(:REACHED 3)",
        ),
        (
            "(let ((f (make-fluent :value 1)) (n 0)) (tl (pursue (whenever ((pulsed f :handle-missed-pulses :always)) (incf n)) (seq (pulse f) (pulse f) (setf (value f) 2) (setf (value f) 2) (sleep 1)))) n)",
            "3",
        ),
        (
            "(let ((f (make-fluent :value 1))) (value (+ f \"a\")))",
            "!! TYPE-ERROR The value\n  \"a\"\nis not of type\n  NUMBER",
        ),
        ("(let ((f (make-fluent :value 1))) (value (eq f f)))", "T"),
        (
            "(let ((f (make-fluent :value 2))) (value (+ f f (* f f))))",
            "8",
        ),
        ("(whenever ((make-fluent :value 1)) (return 42))", "42"),
        ("(whenever ((make-fluent :value 0)) (return :ran))", ":RAN"),
        (
            "(let ((f (make-fluent :value 1)) (g (make-fluent :value 2))) (mapcar #'value (list (+ f g) (* f g) (< f g) (= f 1) (eq f 1) (- f))))",
            "(3 2 T T T -1)",
        ),
        (
            "(let ((f (make-fluent :value 1))) (value (fl-and (> f 0) (< f 10))))",
            "T",
        ),
        (
            "(let ((f (make-fluent :value 1)) (g (make-fluent))) (list (value (fl-or g f)) (value (fl-and f :x)) (fl-and 1 2 3) (fl-or nil nil)))",
            "(1 :X 3 NIL)",
        ),
        (
            "(let ((f (make-fluent))) (tl (pursue (seq (wait-for f) :woken) (seq (pulse f) (sleep 1) :not-woken))))",
            ":NOT-WOKEN",
        ),
        (
            "(let ((f (make-fluent))) (tl (pursue (seq (wait-for (pulsed f)) :woken) (seq (pulse f) (sleep 1) :not-woken))))",
            ":WOKEN",
        ),
        ("(pulse (make-fluent))", "NIL"),
        ("(make-fluent)", "#<FLUENT FLUENT-…"),
        ("(+ (make-fluent :value 1) 1)", "#<FLUENT FN-FL+…"),
        (
            "(let* ((f (make-fluent :value 1)) (g (fl-funcall (lambda (x) (* 2 x)) f))) (list (value g) (setf (value f) 4) (value g)))",
            "(2 4 8)",
        ),
        (
            "(let* ((f (make-fluent :value 1)) (seen nil) (g (fl-funcall (lambda (x) (floor x 2)) f))) (register-update-callback g :see (lambda (v) (push v seen))) (dolist (x '(1 2 3 4)) (setf (value f) x)) (reverse seen))",
            "(1 2)",
        ),
        (
            "(let* ((f (make-fluent :value 1)) (g (fl-value-changed f :test #'= :key #'abs))) (list (value g) (progn (setf (value f) -1) (value g)) (progn (setf (value f) 2) (value g)) (value g)))",
            "(NIL NIL T NIL)",
        ),
        (
            "(let* ((l (list (make-fluent :value 1) (make-fluent :value 2))) (g (cpl-impl:fl-apply #'list 0 l))) (setf (value (second l)) 5) (value g))",
            "(0 (1 5))",
        ),
        (
            "(let ((*x* (make-fluent :value nil))) (value (fl-funcall #'list (list *x*))))",
            "((#<FLUENT FLUENT-…",
        ),
        (
            "(let ((f (make-fluent))) (wait-for f))",
            "!! SIMPLE-ERROR Nothing can continue: …",
        ),
        (
            "(let ((f (make-fluent))) (setf (value (not f)) 1))",
            "!! TYPE-ERROR…",
        ),
        ("(sleep -1)", "!! TYPE-ERROR…"),
        ("(progn (sleep 3600) (sleep* 1/2) (cl:sleep 0))", "NIL"),
    ]);
}

#[test]
fn suspension_and_evaporation() {
    check(&[
        (
            "(tl (with-tags (par (:tag a (on-suspension (print :suspended) (sleep 0.5)) :a-done) (with-task-suspended (a) (sleep 0.1) :b))))",
            "\n:SUSPENDED | :A-DONE",
        ),
        (
            "(tl (with-tags (par (:tag a (sleep 3) :done) (seq (sleep 0.05) (evaporate a) :b))))",
            "",
        ),
        (
            "(tl (with-tags (par (:tag a (sleep 0.2)) (with-task-suspended (a) (sleep 0.05))) (value (status a))))",
            ":SUCCEEDED",
        ),
        (
            "(tl (with-tags (pursue (:tag a (sleep 2)) (sleep 0.05)) (value (status a))))",
            ":EVAPORATED",
        ),
        (
            "(tl (with-tags (with-failure-handling ((f1 (e) (return (list (value (status a)) (type-of (result a)))))) (:tag a (fail 'f1)))))",
            "(:FAILED F1)",
        ),
        (
            "(tl (with-tags (par (:tag a 1) (:tag b 2)) (list (result a) (result b))))",
            "(1 2)",
        ),
        (
            "(tl (with-tags (list (value (status a)) (progn (:tag a :x) (value (status a))))))",
            "(:CREATED :SUCCEEDED)",
        ),
        (
            "(let (l) (tl (with-tags (par (:tag a (without-scheduling (sleep 1) (push :undisturbed l)) (sleep 1) (push :never l)) (seq (sleep 0.5) (evaporate a) (push :gone l))))) (reverse l))",
            "(:UNDISTURBED :GONE)",
        ),
        (
            "(:tag foo 1)",
            "!! SIMPLE-ERROR (:TAG FOO ..) used outside of WITH-TAGS.",
        ),
        (
            "(tl (suspend *current-task*) :woken)",
            "!! SIMPLE-ERROR Nothing can continue: …",
        ),
        (
            "(tl (with-tags (par (seq (:tag a (suspend *current-task*) :a)) (seq (sleep 1) (wake-up a)))))",
            ":A",
        ),
    ]);
}

#[test]
fn policies() {
    const POLICY: &str = "(define-policy pol (n) \"doc\" (:check (> n 5)) (:recover (princ \"[rec]\")) (:clean-up (princ \"[clean]\")))";
    let with = |form: &str| format!("{POLICY} {form}");
    check(&[
        (
            &with("(tl (with-policy pol (1) (sleep .1) :body))"),
            "[clean] | :BODY",
        ),
        (
            &with(
                "(tl (handler-case (with-named-policy 'pol (9) (sleep 1)) (policy-check-condition-met (c) (princ-to-string c))))",
            ),
            "[rec][clean] | \"Policy check condition met for policy POL.\nParameters: (9).\n\"",
        ),
        (
            &with("(tl (with-named-policy 'nopol () 1))"),
            "!! POLICY-NOT-FOUND Policy NOPOL not found.\n",
        ),
        (
            "(define-policy pol2 () (:init nil)) (tl (with-policy pol2 () 1))",
            "!! POLICY-INIT-FAILED Initialization of policy POL2 failed.\nParameters: NIL\n",
        ),
        (
            "(tl (with-policy timeout-policy (1) (sleep 5) :late))",
            "!! POLICY-CHECK-CONDITION-MET Policy check condition met for policy TIMEOUT-POLICY…",
        ),
        (
            "(tl (with-policy timeout-policy (1) (sleep 0.5) :in-time))",
            ":IN-TIME",
        ),
        (
            "(define-policy vars () (:init (policy-setf 'a 10) t) (:clean-up (princ (policy-get 'a)))) (tl (with-policy vars () :body))",
            "10 | :BODY",
        ),
        (
            &with("(tl (with-policies ((pol (1)) (timeout-policy (9))) :both))"),
            "[clean] | :BOTH",
        ),
    ]);
}

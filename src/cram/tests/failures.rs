//! Failures and conditions in plans: how they are handled, and how they reach other tasks.

use super::prompt::check;

#[test]
fn failure_handling() {
    check(&[
        ("(tl (with-failure-handling () 1 2 3))", "3"),
        ("(tl (with-failure-handling () (return 42) 43))", "42"),
        (
            "(with-failure-handling ((plan-failure (e) (return (list :caught (princ-to-string e))))) (fail \"outside\"))",
            "(:CAUGHT \"outside\")",
        ),
        (
            "(with-failure-handling ((f3 (e) :ignored-value)) (fail 'f3))",
            "!! F3 f3 report text",
        ),
        (
            "(with-failure-handling ((f1 (e) (return (list :outer (type-of e))))) (with-failure-handling ((f1 (e) (print :inner))) (fail 'f2)))",
            "\n:INNER | (:OUTER F2)",
        ),
        (
            "(with-failure-handling ((f1 (e) (return :f1))) (with-failure-handling ((f1 (e) (fail 'f3))) (fail 'f1)))",
            "!! F3 f3 report text",
        ),
        (
            "(with-failure-handling ((f3 (e) (return (list :outer-got (princ-to-string e))))) (with-failure-handling ((f1 (e) (fail 'f3))) (fail 'f1)))",
            "(:OUTER-GOT \"f3 report text\")",
        ),
        (
            "(let (l) (handler-case (with-failure-handling ((f2 (e) (push 1 l)) (f1 (e) (push 2 l)) (plan-failure (e) (push 3 l))) (fail 'f2)) (f2 () (reverse l))))",
            "(1 2 3)",
        ),
        (
            "(let ((n 0)) (tl (with-failure-handling ((plan-failure (e) (when (< n 3) (retry)) (return (list :gave-up n)))) (incf n) (fail))))",
            "(:GAVE-UP 3)",
        ),
        (
            "(let ((n 0)) (with-retry-counters ((c 2)) (with-failure-handling ((plan-failure (e) (do-retry c (retry)) (return (list :tries n)))) (incf n) (fail))))",
            "(:TRIES 3)",
        ),
        (
            "(let ((n 0)) (with-retry-counters ((c 0)) (with-failure-handling ((plan-failure (e) (do-retry c (retry)) (return (list :tries n)))) (incf n) (fail))))",
            "(:TRIES 1)",
        ),
        (
            "(with-retry-counters ((c 2) (d 5)) (list (get-counter c) (do-retry c :x) (get-counter c) (do-retry c :y) (do-retry c :z) (get-counter c) (reset-counter c) (get-counter c) (get-counter d)))",
            "(2 :X 1 :Y NIL 0 2 2 5)",
        ),
        ("(with-retry-counters ((c 1)) (do-retry c 1 2 3))", "3"),
        // The number is computed again.
        (
            "(let ((n 2)) (with-retry-counters ((c n)) (setq n 5) (reset-counter c) (get-counter c)))",
            "5",
        ),
        (
            "(with-retry-counters ((outer 2)) (with-retry-counters ((inner 1)) (list (do-retry outer :x) (do-retry inner :y) (get-counter outer) (reset-counter outer))))",
            "(:X :Y 1 2)",
        ),
        (
            "(with-retry-counters ((c 2)) (with-retry-counters ((c 5)) (get-counter c)))",
            "5",
        ),
        (
            "(with-retry-counters ((a 1)) (get-counter typo))",
            "!! SIMPLE-PROGRAM-ERROR GET-COUNTER: there is no retry counter TYPO here. Known is A.",
        ),
        (
            "(with-retry-counters ((a 1) (b 1)) (do-retry typo))",
            "!! SIMPLE-PROGRAM-ERROR DO-RETRY: there is no retry counter TYPO here. Known are A, B.",
        ),
        (
            "(reset-counter c)",
            "!! SIMPLE-PROGRAM-ERROR RESET-COUNTER: there is no retry counter C here; WITH-RETRY-COUNTERS around it makes some.",
        ),
        (
            "(with-retry-counters (c 1) 2)",
            "!! SIMPLE-PROGRAM-ERROR (C 1) in WITH-RETRY-COUNTERS: a list of counters, ((name count)…), was expected.",
        ),
        (
            "(handler-case (tl (with-failure-handling ((plan-failre (e) (return :handled))) (fail \"x\"))) (error (e) (princ-to-string e)))",
            "\"unknown type specifier: DEMO::PLAN-FAILRE. Did you mean CRAM-LANGUAGE-IMPLEMENTATION:PLAN-FAILURE?\"",
        ),
        (
            "(with-failure-handling (((or f1 f3) (e) (return (type-of e)))) (fail 'f3))",
            "F3",
        ),
        (
            "(with-failure-handling ((f1 (e) (return))) (fail 'f1))",
            "NIL",
        ),
        (
            "(with-failure-handling ((f1 (e) (return (values 1 2)))) (fail 'f1))",
            "1 ; 2",
        ),
        (
            "(dolist (i '(1 2 3) :end) (with-failure-handling ((f1 (e) (return i))) (fail 'f1)))",
            ":END",
        ),
        (
            "(with-failure-handling ((f1 (e) (return (f1-x e)))) (fail 'f1 :x 9))",
            "9",
        ),
        (
            "(fail 'no-such-condition)",
            "!! SIMPLE-TYPE-ERROR NO-SUCH-CONDITION does not designate a condition class; did you mean POLICY-CONDITION?",
        ),
        (
            "(fail 42)",
            "!! CASE-TYPE-ERROR 42 fell through ETYPECASE expression.\nWanted one of (CONDITION SYMBOL STRING).",
        ),
        (
            "(fail 'simple-error :format-control \"err\")",
            "!! SIMPLE-ERROR err",
        ),
        (
            "(fail \"with ~a and ~s\" \"str\" \"str\")",
            "!! SIMPLE-PLAN-FAILURE with str and \"str\"",
        ),
        ("(fail)", "!! SIMPLE-PLAN-FAILURE Plan failure."),
        ("(tl (handler-case (fail 'f1) (f1 () :hc)))", ":HC"),
        ("(tl (handler-case (par (fail 'f1) 2) (f1 () :hc)))", ":HC"),
        (
            "(tl (handler-case (fail 'f3) (error () :as-error) (serious-condition () :as-serious)))",
            ":AS-SERIOUS",
        ),
        (
            "(let ((n 0) (l nil)) (with-failure-handling ((f1 (e) (when (< n 2) (retry)) (return))) (unwind-protect (progn (push (incf n) l) (fail 'f1)) (push :u l))) (reverse l))",
            "(1 :U 2 :U)",
        ),
        ("(ignore-errors (fail \"x\"))", "!! SIMPLE-PLAN-FAILURE x"),
        (
            "(with-failure-handling ((simple-plan-failure (e) (format t \"~a\" e))) (fail \"boo\"))",
            "boo | !! SIMPLE-PLAN-FAILURE boo",
        ),
        (
            "(do-retry foo 1)",
            "!! SIMPLE-PROGRAM-ERROR DO-RETRY: there is no retry counter FOO here; WITH-RETRY-COUNTERS around it makes some.",
        ),
        (
            "(retry)",
            "!! UNDEFINED-FUNCTION The function CRAM-LANGUAGE-IMPLEMENTATION:RETRY is undefined.",
        ),
        (
            "(let ((n 0)) (with-failure-handling ((f1 (e) (funcall #'retry))) (incf n) (if (< n 3) (fail 'f1) n)))",
            "3",
        ),
    ]);
}

#[test]
fn failures_across_tasks() {
    check(&[
        (
            "(tl (with-failure-handling ((error (e) (return (princ-to-string e)))) (par (error \"plain\") 2)))",
            "\"plain\"",
        ),
        (
            "(tl (with-failure-handling ((simple-error (e) (return (princ-to-string e)))) (par (par (error \"deep\")) 2)))",
            "\"deep\"",
        ),
        (
            "(tl (with-failure-handling ((plan-failure (e) (return (type-of e)))) (par (error \"x\") 1)))",
            "COMMON-LISP-ERROR-ENVELOPE",
        ),
        (
            "(tl (with-failure-handling ((plan-failure (e) (return (princ-to-string (envelop-error e))))) (par (error \"x\") 1)))",
            "\"x\"",
        ),
        (
            // Cleanup of the child that fails, the handler, cleanup of its sibling.
            "(let (l) (tl (with-failure-handling ((f1 (e) (push :h l) (return))) (par (unwind-protect (sleep 9) (push :c2 l)) (unwind-protect (seq (sleep 1) (fail 'f1)) (push :c1 l))))) (reverse l))",
            "(:C1 :H :C2)",
        ),
        (
            "(let (l) (tl (with-failure-handling ((f1 (e) (retry))) (push :again l) (par (when (< (length l) 3) (fail 'f1)) (sleep 1)))) (length l))",
            "3",
        ),
        (
            "(tl (block b (par (return-from b 1) 2)))",
            "!! SIMPLE-CONTROL-ERROR Attempt to RETURN-FROM a block or GO to a tag that no longer exists",
        ),
        (
            "(tl (with-failure-handling ((plan-failure (e) (return :plan)) (error (e) (return :lisp))) (par (error \"x\"))))",
            ":LISP",
        ),
    ]);
}

#[test]
fn conditions() {
    check(&[
        (
            "(princ-to-string (make-condition 'plan-failure))",
            "\"Condition CRAM-LANGUAGE-IMPLEMENTATION:PLAN-FAILURE was signalled.\"",
        ),
        (
            "(princ-to-string (make-condition 'f1))",
            "\"Condition DEMO::F1 was signalled.\"",
        ),
        (
            "(progn (tl (with-failure-handling ((f1 (e) (print e) (return))) (fail 'f1))))",
            "\n#<DEMO::F1 {…",
        ),
        (
            "(fail 'common-fail:manipulation-pose-unreachable)",
            "!! MANIPULATION-POSE-UNREACHABLE Low-level failure happened",
        ),
        (
            "(fail 'common-fail:object-unreachable :object 1 :description \"too ~~ far\")",
            "!! OBJECT-UNREACHABLE too ~ far",
        ),
        (
            "(handler-case (fail 'common-fail:ptu-goal-not-reached :location 5) (common-fail:low-level-failure (e) (list (common-fail:ptu-failure-target e) (common-fail:error-description e))))",
            "(5 \"Low-level failure happened\")",
        ),
        (
            "(subtypep 'common-fail:gripper-closed-completely 'common-fail:manipulation-low-level-failure)",
            "T ; T",
        ),
        (
            "(fail 'common-fail:navigation-pose-unreachable :pose-stamped 1)",
            "!! NAVIGATION-POSE-UNREACHABLE Low-level failure happened",
        ),
        (
            "(tl (try-in-order (fail \"a\") (fail \"b\")))",
            "!! COMPOSITE-FAILURE All alternatives failed:\n  a\n  b",
        ),
    ]);
}

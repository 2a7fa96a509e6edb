;;;; CRAM-PROLOG: the proofs of a query as a lazy list. The search for the next proof goes on when the
;;;; rest of the list is asked for; `%next-proofs` returns those that cost no call of a function at once.

(in-package :cram-utilities)

(defun cram-prolog:prolog (query &optional bindings)
  "All proofs of a goal, under bindings that are known already: a lazy list of lists of bindings; NIL if
  there is none. What is found without calling functions is found at once, and so may be the whole list;
  else its rest is computed when it is asked for (LAZY-CDR, FORCE-LL).
  Examples:
  (prolog:prolog '(prolog:member ?x (1 2))) => (((?X . 1)) ((?X . 2)))
  (prolog:prolog '(prolog:member ?x (1 2)) '((?x . 2))) => (((?X . 2)))
  (cut:force-ll (prolog:prolog '(and (prolog:member ?x (1 2 3)) (prolog:lisp-pred oddp ?x)))) => (((?X . 1)) ((?X . 3)))"
  (%proofs (%begin-search query bindings)))

(defun cram-prolog:prove-all (query &optional bindings)
  "All proofs of a goal, as PROLOG.
  Examples:
  (prolog:prove-all '(prolog:member ?x (1 2))) => (((?X . 1)) ((?X . 2)))"
  (%proofs (%begin-search query bindings)))

(defun %proofs (search)
  "The proofs that a search has yet to find, as a lazy list."
  (destructuring-bind (more . proofs) (%next-proofs search)
    (if more
        (append proofs (%tail (lambda () (%proofs search))))
        proofs)))

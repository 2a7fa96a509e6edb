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

(defun cram-prolog:trace-prolog (&rest functors)
  "Shows on *TRACE-OUTPUT* how goals with these functors are proved, in whatever package they are written: a line
  when one is called, when it exits with a proof, when a further proof of it is searched for (redo), and
  when it fails, with what its variables are bound to. T stands for all goals. Returns what is traced now, and
  without functors nothing else. UNTRACE-PROLOG ends it.
  Examples:
  (prog1 (prolog:trace-prolog (quote prolog:member)) (prolog:untrace-prolog)) => (:MEMBER)"
  (dolist (functor functors)
    (let ((known (or (eq functor t) (%functor-named (string functor)))))
      (unless (eq known t)
        (error "There are no Prolog goals (~(~a~) …)~@[; did you mean ~a?~]" functor known))))
  (let ((traced (%traced-goals)))
    (cond ((member t functors) (%trace-goals t))
          ((and functors (listp traced))
           (%trace-goals (remove-duplicates (append traced (mapcar #'string functors))
                                            :test #'string= :from-end t)))))
  (%traced-functors))

(defun cram-prolog:untrace-prolog (&rest functors)
  "Ends TRACE-PROLOG for these functors, or altogether. Returns what is traced still.
  Examples:
  (prolog:untrace-prolog) => NIL"
  (let ((traced (%traced-goals)))
    (%trace-goals (and functors
                       (if (listp traced)
                           (remove-if (lambda (name) (member name functors :test #'string=)) traced)
                           (error "All goals are traced; (untrace-prolog) ends that."))))
    (%traced-functors)))

(defun %traced-functors ()
  "The functors of goals that are traced, or T."
  (let ((traced (%traced-goals)))
    (if (listp traced)
        (mapcar (lambda (name) (intern name :keyword)) traced)
        traced)))

;;;; CRAM-UTILITIES: patterns with ?variables, and with !?variables for parts of lists. Bindings are a
;;;; list of pairs (?VARIABLE . VALUE).

(in-package :cram-utilities)

(defun is-var (object)
  "Is this a ?variable?
  Examples:
  (cut:is-var '?x) => T"
  (%begins-with "?" object))

(defun %begins-with (prefix object)
  "Is the object a symbol whose name begins so?"
  (and (symbolp object)
       (values (alexandria:starts-with-subseq prefix (symbol-name object)))))

(defun is-unnamed-var (object)
  "Is this ?_, which matches anything and is never bound?
  Examples:
  (cut:is-unnamed-var 'cut:?_) => T"
  (and (symbolp object) (string= (symbol-name object) "?_")))

(defun is-segvar (object)
  "Is this a variable for a part of a list?
  Examples:
  (cut:is-segvar '!?x) => T"
  (%begins-with "!?" object))

(defun is-segform (object)
  "Is this a list that begins with a variable for a part of a list?
  Examples:
  (cut:is-segform '(!?x a)) => T"
  (and (consp object) (is-segvar (car object))))

(defun var-name (variable)
  "The ?variable of a variable for a part of a list; a ?variable itself.
  Examples:
  (cut:var-name '!?x) => ?X"
  (cond ((is-var variable) variable)
        ((is-segvar variable)
         (let ((name (subseq (symbol-name variable) 1)))
           (if (symbol-package variable)
               (values (intern name (symbol-package variable)))
               (make-symbol name))))
        (t (error "~s is no variable: its name begins with neither ? nor !?." variable))))

(defun gen-var (&optional (prefix "?"))
  "A fresh variable.
  Examples:
  (cut:is-var (cut:gen-var)) => T"
  (unless (and (stringp prefix) (alexandria:starts-with-subseq "?" prefix))
    (error "~s cannot begin the name of a variable; a string that begins with ? can." prefix))
  (gensym prefix))

(defun is-genvar (variable)
  "Is this a variable of GEN-VAR?
  Examples:
  (cut:is-genvar '?x) => NIL"
  (unless (is-var variable)
    (error "~s is no variable." variable))
  (null (symbol-package variable)))

(defun var-value (variable bindings)
  "What a ?variable is bound to in a list of bindings; itself if it is not.
  Examples:
  (cut:var-value '?x '((?x . 1))) => 1"
  (loop with value = variable
        ;; Variables may be bound to variables; a chain is no longer than the list.
        repeat (length bindings)
        for binding = (and (is-var value) (assoc value bindings))
        while binding
        do (setf value (cdr binding))
        finally (return value)))

(defun add-bdg (variable value bindings)
  "The bindings with a further one, and whether it agrees with those that there are.
  Examples:
  (cut:add-bdg '?x 1 '()) => ((?X . 1)) ; T
  (cut:add-bdg '?x 1 '((?x . 2))) => NIL ; NIL"
  (let ((known (assoc variable bindings)))
    (cond ((is-unnamed-var variable) (values bindings t))
          ((null known) (values (acons variable value bindings) t))
          ((equal (cdr known) value) (values bindings t))
          (t (values nil nil)))))

(defun is-bound (term bindings)
  "Is the term no variable, or one that is bound?
  Examples:
  (cut:is-bound '?x '((?x . (?y)))) => T"
  (not (is-var (var-value term bindings))))

(defun is-ground (term bindings)
  "Is there no unbound variable in the term?
  Examples:
  (cut:is-ground '?x '((?x . (?y)))) => NIL"
  (null (vars-in (substitute-vars term bindings))))

(defun substitute-vars (term bindings)
  "The term with the values of its variables.
  Examples:
  (cut:substitute-vars '(?x ?z) '((?x a ?y) (?y . b))) => ((A B) ?Z)"
  (cond ((is-var term)
         (let ((value (var-value term bindings)))
           (if (is-var value) value (substitute-vars value bindings))))
        ((consp term)
         (cons (substitute-vars (car term) bindings)
               (substitute-vars (cdr term) bindings)))
        (t term)))

(defun vars-in (term)
  "The variables of a term.
  Examples:
  (cut:vars-in '(?x (a ?y) ?x)) => (?X ?Y)"
  (let ((variables '()))
    (labels ((walk (term)
               (cond ((or (is-var term) (is-segvar term)) (pushnew (var-name term) variables))
                     ((consp term)
                      (walk (car term))
                      (walk (cdr term))))))
      (walk term))
    (nreverse variables)))

(defun rename-vars (term)
  "The term with fresh variables in place of its own.
  Examples:
  (cut:patterns-eq '(?x ?y ?x) (cut:rename-vars '(?x ?y ?x))) => T"
  (sublis (loop for variable in (vars-in term)
                unless (is-unnamed-var variable)
                  collect (cons variable (gen-var (symbol-name variable))))
          term))

(defun patterns-eq (one other)
  "Are the patterns the same but for the names of variables?
  Examples:
  (cut:patterns-eq '(?x ?y) '(?a ?b)) => T
  (cut:patterns-eq '(?x ?x) '(?a ?b)) => NIL"
  (let ((there '()) (back '()))
    (labels ((agree (one other)
               (cond ((and (is-var one) (is-var other))
                      (let ((a (assoc one there)) (b (assoc other back)))
                        (if (or a b)
                            (and a b (eq (cdr a) other) (eq (cdr b) one))
                            (progn (push (cons one other) there)
                                   (push (cons other one) back)
                                   t))))
                     ((and (consp one) (consp other))
                      (and (agree (car one) (car other)) (agree (cdr one) (cdr other))))
                     (t (equal one other)))))
      (agree one other))))

(defun bindings-equal (one other)
  "Do the bindings say the same, in whatever order?
  Examples:
  (cut:bindings-equal '((?x . 1) (?y . 2)) '((?y . 2) (?x . 1))) => T"
  (and (= (length one) (length other))
       (every (lambda (binding) (member binding other :test #'equal)) one)))

(defun pat-match (pattern term &optional bindings)
  "The bindings with which the pattern is the term, and whether there are such.
  Examples:
  (cut:pat-match '(a ?x !?rest) '(a b c d)) => ((?REST C D) (?X . B)) ; T
  (cut:pat-match '(?x ?x) '(1 2)) => NIL ; NIL"
  (when (or (vars-in term) (is-segvar term))
    (error "~s has variables; only the pattern may have them." term))
  (%match-pattern pattern term bindings #'%matched (lambda () (values nil nil))))

(defun %matched (bindings)
  "The result of a match."
  (values bindings t))

(defun %match-pattern (pattern term bindings succeed fail)
  "What one of two functions returns: SUCCEED, of the bindings of a match, which may call for the
  next one by returning NIL twice, or FAIL."
  (cond ((is-segvar pattern)
         (error "~s stands for a part of a list and has to be an element of one." pattern))
        ((is-var pattern)
         (multiple-value-bind (extended agrees) (add-bdg pattern term bindings)
           (if agrees (funcall succeed extended) (funcall fail))))
        ((is-segform pattern)
         (%match-part pattern term bindings succeed fail))
        ((and (consp pattern) (consp term))
         (%match-pattern (car pattern) (car term) bindings
                 (lambda (extended) (%match-pattern (cdr pattern) (cdr term) extended succeed fail))
                 fail))
        ((equal pattern term) (funcall succeed bindings))
        (t (funcall fail))))

(defun %match-part (pattern term bindings succeed fail)
  "Matches a list that begins with a variable for a part: the shortest part first."
  (if (not (and (listp term) (null (cdr (last term)))))
      (funcall fail)
      (loop for count from 0 to (length term)
            do (multiple-value-bind (extended agrees)
                   (add-bdg (var-name (car pattern)) (subseq term 0 count) bindings)
                 (when agrees
                   (multiple-value-bind (result matches)
                       (%match-pattern (cdr pattern) (nthcdr count term) extended succeed
                               (lambda () (values nil nil)))
                     (when matches
                       (return (values result t))))))
            finally (return (funcall fail)))))

(defun pat-match-p (pattern term &optional bindings)
  "Does the pattern match the term?
  Examples:
  (cut:pat-match-p '(a ?x) '(a b)) => T"
  (nth-value 1 (pat-match pattern term bindings)))

(defmacro with-vars-bound (variables bindings &body body)
  "Binds ?variables to what a list of bindings says of them.
  Examples:
  (cut:with-vars-bound (?x) '((?x . 1)) ?x) => 1"
  (let ((all (gensym "BINDINGS")))
    `(let* ((,all ,bindings)
            ,@(loop for variable in variables
                    collect `(,variable (var-value ',variable ,all))))
       ,@body)))

(defmacro with-vars-strictly-bound (variables bindings &body body)
  "Like WITH-VARS-BOUND; a variable that is not bound is an error.
  Examples:
  (cut:with-vars-strictly-bound (?x) '((?x . 1)) ?x) => 1"
  (let ((all (gensym "BINDINGS")))
    `(let ((,all ,bindings))
       (dolist (variable ',variables)
         (unless (is-bound variable ,all)
           (error "The variable ~s is not bound in ~s." variable ,all)))
       (with-vars-bound ,variables ,all ,@body))))

(defmacro with-pat-vars-bound (pattern term &body body)
  "Binds the variables of a pattern so that it is the term; an error if it cannot be.
  Examples:
  (cut:with-pat-vars-bound (?x b ?y) '(a b c) (list ?x ?y)) => (A C)"
  (let ((all (gensym "BINDINGS"))
        (matches (gensym "MATCHES"))
        (variables (vars-in pattern)))
    `(multiple-value-bind (,all ,matches) (pat-match ',pattern ,term)
       ,@(unless variables
           `((warn "There are no variables in the pattern ~s." ',pattern)))
       (unless ,matches
         (error "The pattern ~s does not match." ',pattern))
       (with-vars-bound ,variables ,all ,@body))))

(defun cram-prolog:unify (one other &optional bindings)
  "The bindings with which two terms are the same, and whether there are such. Both may have
  variables.
  Examples:
  (prolog:unify '(?x b) '(a ?y)) => ((?Y . B) (?X . A)) ; T
  (prolog:unify '(?x ?x) '(a b)) => NIL ; NIL"
  (%unify one other bindings #'%matched))

(defun cram-prolog:unify-p (one other &optional bindings)
  "Can two terms be made the same?
  Examples:
  (prolog:unify-p '(?x b) '(a ?y)) => T"
  (nth-value 1 (cram-prolog:unify one other bindings)))

(defun %unify (one other bindings succeed)
  "What a function returns of bindings with which the terms are the same: NIL twice asks for others."
  (let ((one (var-value one bindings))
        (other (var-value other bindings)))
    (cond ((or (is-segvar one) (is-segvar other))
           (error "~s stands for a part of a list and has to be an element of one."
                  (if (is-segvar one) one other)))
          ((or (is-unnamed-var one) (is-unnamed-var other) (eq one other))
           (funcall succeed bindings))
          ((is-var one) (funcall succeed (acons one other bindings)))
          ((is-var other) (funcall succeed (acons other one bindings)))
          ((is-segform one) (%unify-segment one other bindings succeed))
          ((is-segform other) (%unify-segment other one bindings succeed))
          ((and (consp one) (consp other))
           (%unify (car one) (car other) bindings
                   (lambda (extended) (%unify (cdr one) (cdr other) extended succeed))))
          ((equal one other) (funcall succeed bindings))
          (t (values nil nil)))))

(defun %unify-segment (list other bindings succeed)
  "Unifies a list that begins with a variable for a part: the shortest part first."
  (if (and (listp other) (null (cdr (last other))))
      (loop for count from 0 to (length other)
            do (multiple-value-bind (result is-one)
                   (%unify (var-name (car list)) (subseq other 0 count) bindings
                           (lambda (extended)
                             (%unify (cdr list) (nthcdr count other) extended succeed)))
                 (when is-one
                   (return (values result t))))
            finally (return (values nil nil)))
      (values nil nil)))

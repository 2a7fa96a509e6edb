;;; The full expansion of a form, for people to read. An environment is a list of what stands around
;;; the form, innermost first: heads such as (macrolet ((name …))), without bodies.

(in-package :common-lisp)

(defun %macroexpand-all (form &optional environment)
  "A form in which all macros are expanded, also those inside of it."
  (multiple-value-bind (expansion is-expanded) (%expand-within form environment)
    (cond ((and is-expanded (not (eq expansion form)))
           (%macroexpand-all expansion environment))
          ((atom form) form)
          ((consp (first form)) (%expand-forms form environment))
          (t (%expand-subforms form environment)))))

(defmacro %expansion-here (form &environment environment)
  "What MACROEXPAND-1 returns for a form at this place."
  `'(,@(multiple-value-list (macroexpand-1 form environment))))

(defun %expand-within (form environment)
  "MACROEXPAND-1 in an environment. Macros that people know better than what they stand for are kept."
  (cond ((and (consp form)
              (or (not (symbolp (first form)))
                  (special-operator-p (first form))
                  (member (first form)
                          '(and or prog1 lambda multiple-value-bind handler-bind))))
         (values form nil))
        ((null environment) (macroexpand-1 form))
        (t (let ((place `(%expansion-here ,form)))
             (dolist (head environment)
               (setf place (append head (list place))))
             (values-list (eval place))))))

(defun %expand-forms (forms environment)
  "Several forms."
  (mapcar (lambda (form) (%macroexpand-all form environment)) forms))

(defun %expand-subforms (form environment)
  "A call or a special form, whose parts are expanded."
  (let ((operator (first form)))
    (flet ((keep (count &optional (environment environment))
             (append (subseq form 0 count) (%expand-forms (nthcdr count form) environment))))
      (case operator
        ((quote go declare load-time-value) form)
        ((block return-from eval-when the) (keep 2))
        (setq (loop for (name value) on (rest form) by #'cddr
                    append (list name (%macroexpand-all value environment)) into pairs
                    finally (return (cons 'setq pairs))))
        (tagbody (cons 'tagbody (mapcar (lambda (part)
                                          (if (atom part) part (%macroexpand-all part environment)))
                                        (rest form))))
        (function (if (member (alexandria:ensure-car (second form)) '(lambda system::named-lambda))
                      (list 'function (%expand-lambda (second form) environment))
                      form))
        ((lambda system::named-lambda) (%expand-lambda form environment))
        ((let let*)
         (let ((bindings (%expand-bindings (second form) environment)))
           (list* operator bindings
                  (%expand-forms (cddr form)
                                 (%shadowing (mapcar #'alexandria:ensure-car bindings)
                                             environment)))))
        (multiple-value-bind
         (list* operator (second form) (%macroexpand-all (third form) environment)
                (%expand-forms (nthcdr 3 form) (%shadowing (second form) environment))))
        (handler-bind
            (list* operator
                   (loop for (type . handler) in (second form)
                         collect (cons type (%expand-forms handler environment)))
                   (%expand-forms (cddr form) environment)))
        ((flet labels)
         (let* ((inside (cons `(flet ,(loop for (name) in (second form)
                                            collect `(,name (&rest arguments) arguments)))
                              environment))
                (around (if (eq operator 'labels) inside environment)))
           (list* operator
                  (loop for (name . function) in (second form)
                        collect (cons name (%expand-function function around)))
                  (%expand-forms (cddr form) inside))))
        ((macrolet symbol-macrolet)
         (cons 'locally
               (%expand-forms (cddr form) (cons (list operator (second form)) environment))))
        (t (keep 1))))))

(defun %shadowing (names environment)
  "The environment inside of variables of these names, which are no symbol macros there."
  (let ((shadowed (remove-if-not (lambda (name) (nth-value 1 (%expand-within name environment)))
                                 names)))
    (if shadowed
        (cons `(symbol-macrolet ,(mapcar (lambda (name) (list name name)) shadowed)) environment)
        environment)))

(defun %expand-bindings (bindings environment)
  "Names, or lists of a name and a form, such as those of LET and of lambda lists."
  (mapcar (lambda (binding)
            (if (and (consp binding) (rest binding))
                (list* (first binding) (%macroexpand-all (second binding) environment)
                       (cddr binding))
                binding))
          bindings))

(defun %expand-lambda (form environment)
  "(LAMBDA lambda-list …), or one with a name before its lambda list."
  (let ((head (if (eq (first form) 'lambda) 1 2)))
    (append (subseq form 0 head) (%expand-function (nthcdr head form) environment))))

(defun %expand-function (function environment)
  "A lambda list and a body."
  (let* ((parameters (%expand-bindings (first function) environment))
         (names (mapcar (lambda (parameter)
                          (let ((name (alexandria:ensure-car parameter)))
                            (if (consp name) (second name) name)))
                        (set-difference parameters lambda-list-keywords))))
    (cons parameters (%expand-forms (rest function) (%shadowing names environment)))))

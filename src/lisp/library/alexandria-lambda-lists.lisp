;;;; ALEXANDRIA: taking lambda lists apart.

(in-package :alexandria)

(defun parse-ordinary-lambda-list (lambda-list &key (normalize t) allow-specializers
                                                 (normalize-optional normalize)
                                                 (normalize-keyword normalize)
                                                 (normalize-auxilary normalize))
  "The parts of a lambda list: the required parameters, optional ones as (name default supplied-p), the rest
  parameter, keyword parameters as ((keyword name) default supplied-p), whether other keys are
  allowed, &aux variables as (name value), and whether &key occurs.
  Examples:
  (alexandria:parse-ordinary-lambda-list '(a &optional b &key c)) => (A) ; ((B NIL NIL)) ; NIL ; (((:C C) NIL NIL)) ; NIL ; NIL ; T"
  (let ((section '&required)
        (required '()) (optional '()) (rest nil) (keys '()) (aux '())
        (has-keys nil) (allows-others nil))
    (labels ((fail (control &rest arguments)
               (apply #'simple-program-error
                      (concatenate 'string control " in the lambda list ~s.")
                      (append arguments (list lambda-list))))
             (variable (object)
               (cond ((or (not (symbolp object)) (constantp object))
                      (fail "~s is no variable" object))
                     (t (dolist (other (append required optional (list rest) keys aux))
                          (when (and other (eq object (%parameter-name other)))
                            (fail "~s occurs twice" object)))
                        object)))
             (parts (object count)
               ;; An optional or keyword parameter or an &aux variable, as a list.
               (let ((parts (ensure-list object)))
                 (if (and (proper-list-p parts) (<= 1 (length parts) count))
                     parts
                     (fail "~s is no parameter" object))))
             (supplied (parts)
               (if (third parts) (variable (third parts))))
             (enter (keyword)
               (let ((order '(&required &optional &rest &key &allow-other-keys &aux)))
                 (unless (member keyword (rest (member section order)))
                   (fail "~s is out of place" keyword))
                 (when (and (eq keyword '&allow-other-keys) (not has-keys))
                   (fail "&allow-other-keys stands without &key"))
                 (when (and (eq section '&rest) (null rest))
                   (fail "~s is no variable" keyword))
                 (setf section keyword)
                 (case keyword
                   (&key (setf has-keys t))
                   (&allow-other-keys (setf allows-others t))))))
      (dolist (object lambda-list)
        (if (member object '(&optional &rest &key &allow-other-keys &aux))
            (enter object)
            (ecase section
              (&required
               (push (if (and allow-specializers (consp object))
                         (progn (variable (first (parts object 2))) object)
                         (variable object))
                     required))
              (&optional
               (let ((parts (parts object 3)))
                 (variable (first parts))
                 (supplied parts)
                 (push (if normalize-optional
                           (list (first parts) (second parts) (third parts))
                           object)
                       optional)))
              (&rest
               (when rest (fail "~s stands after the &rest parameter" object))
               (setf rest (variable object)))
              (&key
               (let* ((parts (parts object 3))
                      (name (if (consp (first parts))
                                (first parts)
                                (list (if (symbolp (first parts))
                                          (make-keyword (first parts))
                                          (fail "~s is no parameter" object))
                                      (first parts)))))
                 (unless (and (proper-list-p name) (= (length name) 2) (symbolp (first name)))
                   (fail "~s is no parameter" object))
                 (variable (second name))
                 (supplied parts)
                 (push (if normalize-keyword
                           (list name (second parts) (third parts))
                           object)
                       keys)))
              (&allow-other-keys
               (fail "~s stands after &allow-other-keys" object))
              (&aux
               (let ((parts (parts object 2)))
                 (variable (first parts))
                 (push (if normalize-auxilary (list (first parts) (second parts)) object)
                       aux))))))
      (when (and (eq section '&rest) (null rest))
        (fail "&rest has no variable"))
      (values (reverse required) (reverse optional) rest (reverse keys)
              allows-others (reverse aux) has-keys))))

(defun %parameter-name (parameter)
  "The variable of a parameter in any form."
  (let ((name (ensure-car parameter)))
    (if (consp name) (second name) name)))

;;; Tracing: chapter 25.1 of the standard.

(in-package :common-lisp)

(defvar system::%*traced* '()
  "What is traced: lists of a name, its own function, and the function in its place.")

(defvar system::%*trace-depth* 0
  "How many traced calls are open.")

(defmacro trace (&rest names)
  "Shows each call of these functions, and what it returns, until UNTRACE. The functions that are
  traced now, if none are named. Defining a function again ends its trace.
  Examples:
  (progn (defun twice (x) (* 2 x)) (trace twice)) => (TWICE)
  (progn (defun twice (x) (* 2 x)) (untrace twice)) => T"
  (if names
      `(mapc #'%trace ',names)
      `(mapcar #'first (%still-traced))))

(defmacro untrace (&rest names)
  "Ends TRACE for these functions, or for all.
  Examples:
  (untrace) => T"
  `(progn
     (mapc #'%untrace ,(if names `',names `(mapcar #'first (%still-traced))))
     t))

(defun %still-traced ()
  "The entries of the functions that are traced: those that have not been defined again."
  (setf %*traced*
        (remove-if-not (lambda (entry)
                         (and (fboundp (first entry))
                              (eq (fdefinition (first entry)) (third entry))))
                       %*traced*)))

(defun %trace (name)
  "Puts a function that shows its calls in the place of one."
  (cond ((and (symbolp name) (or (special-operator-p name) (macro-function name)))
         (error "~S is no function; only calls of functions can be traced." name))
        ((find name (%still-traced) :key #'first :test #'equal))
        (t (let* ((function (fdefinition name))
                  (shown (lambda (&rest arguments) (%traced-call name function arguments))))
             (setf (fdefinition name) shown)
             (push (list name function shown) %*traced*)))))

(defun %untrace (name)
  "Puts a function back in its place."
  (let ((entry (find name (%still-traced) :key #'first :test #'equal)))
    (when entry
      (setf (fdefinition name) (second entry)
            %*traced* (remove entry %*traced*)))))

(defun %traced-call (name function arguments)
  "The values of a call, which is shown with them."
  (let ((depth %*trace-depth*)
        (has-returned nil))
    (format *trace-output* "~&~vT~D: ~S~%" (* 2 (1+ depth)) depth (cons name arguments))
    (unwind-protect
         (let ((values (multiple-value-list
                        (let ((%*trace-depth* (1+ depth)))
                          (apply function arguments)))))
           (setf has-returned t)
           (format *trace-output* "~&~vT~D: ~S returned~{ ~S~}~%" (* 2 (1+ depth)) depth name values)
           (values-list values))
      (unless has-returned
        (format *trace-output* "~&~vT~D: ~S was left~%" (* 2 (1+ depth)) depth name)))))

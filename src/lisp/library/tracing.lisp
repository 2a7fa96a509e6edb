;;; Tracing: chapter 25.1 of the standard.

(in-package :common-lisp)

(defvar system::%*traced* '()
  "What is traced: lists of a name, what traces it, a function that tells whether that is so still,
  one that ends it, and the function that is traced if it is one.")

(defvar system::%*tracers* '(system::%trace-function)
  "Functions that trace one kind of thing each. Called with a name, they begin to trace what it
  means, and return functions: whether that is traced still, what ends it, and what is traced if it
  is a function. They return NIL if the name has no such meaning.")

(defvar system::%*trace-depth* 0
  "How many traced calls are open.")

(defmacro trace (&rest names)
  "Shows each call of these functions, and what it returns or why it fails, until UNTRACE. Types of
  actions and motions are traced like functions, and so are variables with fluents whenever the
  fluent changes. Without names, what is traced now. Defining a function again ends its trace.
  Examples:
  (progn (defun twice (x) (* 2 x)) (trace twice)) => (TWICE)
  (progn (defun twice (x) (* 2 x)) (untrace twice)) => T"
  (if names
      `(mapc #'%trace ',names)
      `(%traced-names)))

(defmacro untrace (&rest names)
  "Ends TRACE for these names, or for all.
  Examples:
  (untrace) => T"
  `(progn
     (mapc #'%untrace ,(if names `',names `(%traced-names)))
     t))

(defun %still-traced ()
  "The entries of what is traced, without those that have ended by themselves."
  (setf %*traced* (remove-if-not (lambda (entry) (funcall (third entry))) %*traced*)))

(defun %traced-names ()
  "The names that are traced, those traced last first."
  (remove-duplicates (mapcar #'first (%still-traced)) :test #'equal :from-end t))

(defun %trace (name)
  "Traces all that a name means."
  (unless (some #'identity (mapcar (lambda (tracer) (%trace-as tracer name)) %*tracers*))
    (%refuse-to-trace name)))

(defun %trace-as (tracer name)
  "Traces a name by one of the tracers, unless that does so already; false if it has no meaning."
  (or (find-if (lambda (entry) (and (equal (first entry) name) (eq (second entry) tracer)))
               (%still-traced))
      (multiple-value-bind (is-traced end function) (funcall tracer name)
        (when end
          (push (list name tracer is-traced end function) %*traced*)))))

(defun %refuse-to-trace (name)
  "The error for a name that means nothing that can be traced."
  (if (and (symbolp name) (or (special-operator-p name) (macro-function name)))
      (error "~S is no function; only calls of functions can be traced." name)
      (fdefinition name)))

(defun %untrace (name)
  "Ends all traces of a name."
  (dolist (entry (%still-traced))
    (when (equal (first entry) name)
      (funcall (fourth entry))
      (setf %*traced* (remove entry %*traced*)))))

(defun %toggle-trace (name)
  "Traces a name, or ends that; a text that tells which."
  (let ((is-traced (member name (%traced-names) :test #'equal)))
    (if is-traced (%untrace name) (%trace name))
    (format nil "~S is ~:[now~;no longer~] traced." name is-traced)))

(defun %trace-function (name)
  "Puts a function that shows its calls in the place of one."
  (unless (or (not (fboundp name))
              (and (symbolp name) (or (special-operator-p name) (macro-function name))))
    (let* ((function (fdefinition name))
           (shown (lambda (&rest arguments)
                    (%traced-call (prin1-to-string (cons name arguments)) (prin1-to-string name)
                                  (lambda () (apply function arguments))))))
      (system:without-package-locks (setf (fdefinition name) shown))
      (values (lambda () (and (fboundp name) (eq (fdefinition name) shown)))
              (lambda ()
                (system:without-package-locks (setf (fdefinition name) function)))
              function))))

(defun %traced-call (shown name call)
  "The values of a call, which is shown with them, or with what has made it fail."
  (let ((depth %*trace-depth*)
        (has-returned nil)
        (failure nil))
    (%tell-trace depth "~A" shown)
    (unwind-protect
         (let ((values (multiple-value-list
                        (let ((%*trace-depth* (1+ depth)))
                          (handler-bind ((serious-condition (lambda (c) (setf failure c))))
                            (funcall call))))))
           (setf has-returned t)
           (%tell-trace depth "~A returned~{ ~S~}" name values)
           (values-list values))
      (cond (has-returned)
            (failure (%tell-trace depth "~A failed: ~A" name (%on-one-line (princ-to-string failure))))
            (t (%tell-trace depth "~A was left" name))))))

(defun %on-one-line (text)
  "A text in which each run of blanks and line ends is one blank."
  (let ((is-between nil))
    (with-output-to-string (line)
      (loop for c across text
            do (cond ((member c '(#\Space #\Newline)) (setf is-between t))
                     (t (when is-between (write-char #\Space line))
                        (setf is-between nil)
                        (write-char c line)))))))

(defun %tell-trace (depth control &rest arguments)
  "Shows a line of a trace, indented by its depth."
  (format *trace-output* "~&~vT~D: ~?~%" (* 2 (1+ depth)) depth control arguments))

;;;; Tests of systems: the option :IN-ORDER-TO for TEST-OP, and the forms for TEST-OP, which are the only
;;;; ones of a description that are evaluated, when somebody asks for it.

(in-package :asdf)

(defun test-system (system &key force verbose version)
  "Loads a system and runs its tests as its description says: those of the systems that it names for
  TEST-OP, and its own forms for it. An error if it says nothing of tests. What fails, the tests tell.
  Examples:
  (handler-case (asdf:test-system :cram-language) (error () 'no-tests)) => NO-TESTS"
  (declare (ignore verbose version))
  (let ((name (%system-name system)))
    (when (system:built-in-system-p name)
      (error "The system ~s is built in; its tests are not." name))
    (load-system name :force force)
    (%test-system name (or (%system-file name) (%no-system name nil))))
  t)

(defun %test-system (name file)
  "Does what the description of a system says of tests."
  (let* ((forms (%read-test-forms file))
         (options (%test-options name forms))
         (others (%tested-before options))
         (functions (%test-functions name forms options file)))
    (unless (or others functions)
      (error "~a: nothing is said of tests of the system ~s." file name))
    (loop for (operation . systems) in others
          do (dolist (other systems)
               (if (equal operation "TEST-OP")
                   (test-system other)
                   (load-system other))))
    (dolist (function functions)
      (funcall function :test-op name))))

(defun %tested-before (options)
  "What has to be done before TEST-OP: lists of the name of an operation and names of systems."
  (loop for (operation . needed) in (%test-option "IN-ORDER-TO" options)
        when (equal (%bare-name operation) "TEST-OP")
          append (loop for (other . systems) in needed
                       collect (cons (%bare-name other) (mapcar #'%marked-system systems)))))

(defun %test-functions (name forms options file)
  "Functions of an operation and a system that run the tests of a system."
  (let ((perform (%test-option "PERFORM" options)))
    (append
     (if (and perform (equal (%bare-name (first perform)) "TEST-OP"))
         (list (%test-function (member-if #'listp (rest perform)) file)))
     (loop for form in forms
           for parameters = (and (consp form)
                                 (equal (%bare-name (first form)) "DEFMETHOD")
                                 (equal (%bare-name (second form)) "PERFORM")
                                 (find-if #'listp form))
           when (and parameters (%is-method-for-tests parameters name))
             collect (%test-function (cons (mapcar #'first parameters)
                                           (rest (member parameters form)))
                                     file)))))

(defun %is-method-for-tests (parameters name)
  "Are these the parameters of a method of PERFORM that tests a system?"
  (and (= (length parameters) 2)
       (every #'consp parameters)
       (equal (%bare-name (second (first parameters))) "TEST-OP")
       (let ((specializer (second (second parameters))))
         (and (consp specializer)
              (equal (%bare-name (first specializer)) "EQL")
              (consp (second specializer))
              (equal (%marked-system (second (second specializer))) name)))))

(defun %test-function (parameters-and-body file)
  "The function with parameters and a body as they stand in a description."
  (destructuring-bind (parameters . body) (%unmarked parameters-and-body file)
    (eval `(lambda ,parameters (declare (ignorable ,@parameters)) ,@body))))

;;; Reading with names of packages

(defconstant %mark (code-char #xE000)
  "What stands for a colon while a description is read, since the packages in it may not be there yet.")

(defun %read-test-forms (file)
  "The forms of a description, with marks in place of the colons in names."
  (let ((text (alexandria:read-file-into-string file))
        (*package* (find-package :asdf-user))
        (*readtable* (copy-readtable nil))
        (*read-eval* nil))
    (set-dispatch-macro-character #\# #\. #'%read-computed)
    (loop for at from 1 below (length text)
          when (and (char= (char text at) #\:) (char/= (char text (1- at)) #\#))
            do (setf (char text at) %mark))
    (with-input-from-string (stream text)
      (loop for form = (read stream nil stream)
            until (eq form stream)
            collect form))))

(defun %bare-name (object)
  "The name of a symbol without its package, or NIL."
  (and (symbolp object)
       (let ((name (symbol-name object)))
         (subseq name (1+ (or (position %mark name :from-end t) -1))))))

(defun %marked-system (designator)
  "The name of a system that is written with marks."
  (if (stringp designator)
      (substitute #\: %mark designator)
      (string-downcase (%bare-name designator))))

(defun %test-options (name forms)
  "The options of a system."
  (loop for form in forms
        when (and (consp form)
                  (equal (%bare-name (first form)) "DEFSYSTEM")
                  (equal (%marked-system (second form)) name))
          return (cddr form)))

(defun %test-option (name options)
  "The value of an option with a name."
  (loop for (key value) on options by #'cddr
        when (equal (%bare-name key) name)
          return value))

(defun %unmarked (object file)
  "The object with the symbols, strings and characters that marks stand in."
  (typecase object
    (cons (cons (%unmarked (car object) file) (%unmarked (cdr object) file)))
    (string (substitute #\: %mark object))
    (character (if (char= object %mark) #\: object))
    (symbol (%unmarked-symbol object file))
    (t object)))

(defun %unmarked-symbol (symbol file)
  "The symbol that a name with marks means."
  (let* ((name (symbol-name symbol))
         (end (position %mark name))
         (bare (%bare-name symbol))
         (package (and end (plusp end) (subseq name 0 end))))
    (cond ((eql end 0) (intern bare :keyword))
          ((and (null end) (not (eq (symbol-package symbol) (find-package :asdf-user)))) symbol)
          ((cdr (assoc bare '(("SYMBOL-CALL" . %symbol-call) ("FIND-SYMBOL*" . %symbol-there))
                       :test #'string=)))
          ((null package)
           (multiple-value-bind (own status) (find-symbol bare :asdf)
             (if (eq status :external) own symbol)))
          ((find-package package) (%symbol-there bare package))
          (t (error "~a: there is no package ~a for ~a in the forms for TEST-OP." file package bare)))))

(defun %symbol-there (name package)
  "The symbol of a name in a package, which must have it."
  (multiple-value-bind (symbol status) (find-symbol (string name) package)
    (if status
        symbol
        (error "There is no symbol ~a in the package ~a." (string name) package))))

(defun %symbol-call (package name &rest arguments)
  "Calls the function of a name in a package."
  (apply (%symbol-there name package) arguments))

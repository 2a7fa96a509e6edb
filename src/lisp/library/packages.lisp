;;; Packages: chapter 11 of the standard. IN-PACKAGE is written in Rust.

(in-package :common-lisp)

(defmacro defpackage (name &rest options)
  "Defines a package; options are :use, :export, :nicknames, :import-from, :shadow, :shadowing-import-from, :intern and :documentation.
  Examples:
  (defpackage :example-package (:use :cl) (:export #:thing)) => #<PACKAGE \"EXAMPLE-PACKAGE\">"
  `(%define-package-checked ',name ',options))

(defun %define-package-checked (name options)
  "Carries out a DEFPACKAGE. Symbols that it imports and that there are not can be made."
  (dolist (option options)
    (if (and (consp option)
             (member (first option) '(:import-from :shadowing-import-from))
             (rest option))
        (let ((package (find-package (second option))))
          (dolist (symbol (and package (listp (cddr option)) (cddr option)))
            (let ((text (string symbol)))
              (unless (nth-value 1 (find-symbol text package))
                (cerror "Make the symbol."
                        'simple-package-error
                        :package package
                        :format-control "No symbol named ~s in the package ~a."
                        :format-arguments (list text (package-name package)))
                (intern text package)))))))
  (%define-package name options))

(defun make-package (name &key nicknames (use '()) size)
  "A new package.
  Examples:
  (package-name (make-package :made-as-example)) => \"MADE-AS-EXAMPLE\""
  (declare (ignore size))
  (flet ((taken (name report)
           (let ((package (find-package name)))
             (when package
               (cerror report
                       'simple-package-error
                       :package package
                       :format-control "A package named ~s already exists."
                       :format-arguments (list (string name)))
               package))))
    (or (taken name "Use the package that there is.")
        (%make-package name
                       :use use
                       :nicknames (remove-if (lambda (nickname)
                                               (taken nickname "Leave the nickname out."))
                                             (if (listp nicknames) nicknames (list nicknames)))))))

(defun delete-package (package)
  "Deletes a package.
  Examples:
  (progn (make-package :short-lived) (delete-package :short-lived)) => T"
  (if (or (packagep package) (find-package package))
      (%delete-package package)
      (cerror "Do nothing."
              'simple-package-error
              :package package
              :format-control "The name ~s does not designate any package."
              :format-arguments (list (string package)))))

(defmacro do-symbols ((variable &optional package result) &body body)
  "Evaluates the body for each symbol accessible in a package.
  Examples:
  (let ((n 0)) (do-symbols (s :cl) (when (eq s 'car) (incf n))) n) => 1"
  (%do-symbols variable package :inherited result body))

(defmacro do-external-symbols ((variable &optional package result) &body body)
  "Evaluates the body for each symbol that a package exports.
  Examples:
  (let ((n 0)) (do-external-symbols (s :cl) (when (eq s 'car) (incf n))) n) => 1"
  (%do-symbols variable package :external result body))

(defmacro do-all-symbols ((variable &optional result) &body body)
  "Evaluates the body for each symbol of all packages.
  Examples:
  (let ((n 0)) (do-all-symbols (s n) (when (eq s 'car) (incf n)))) => 1"
  (%do-symbols variable nil t result body))

(defun %do-symbols (variable package kind result body)
  "The form of a loop over symbols of a kind."
  `(dolist (,variable (%package-symbols ,(or package '*package*) ,kind) ,result)
     ,@body))

(defmacro with-package-iterator ((name packages &rest kinds) &body body)
  "Evaluates the body; in it `(name)` returns `T` and the next symbol, how it is accessible, and its package, or `NIL`.
  Examples:
  (with-package-iterator (next :cl :internal) (next)) => NIL"
  (unless (and kinds (subsetp kinds '(:internal :external :inherited)))
    (error 'simple-program-error
           :format-control "WITH-PACKAGE-ITERATOR takes kinds of symbols, :INTERNAL, :EXTERNAL or :INHERITED, not ~s."
           :format-arguments (list kinds)))
  (%with-iterator name `(%package-iterator ,packages ',kinds) body))

(defmacro with-hash-table-iterator ((name table) &body body)
  "Evaluates the body; in it `(name)` returns `T` and key and value of the next entry, or `NIL`.
  Examples:
  (let ((h (make-hash-table))) (setf (gethash 1 h) 'a) (with-hash-table-iterator (next h) (multiple-value-list (next)))) => (T 1 A)"
  (%with-iterator name `(%hash-iterator ,table) body))

(defun %with-iterator (name start body)
  "The form that binds the state of an iterator, and a local macro that takes its next entry."
  (let ((state (gensym "ITERATOR")))
    `(let ((,state ,start))
       (macrolet ((,name () '(%iterator-next ,state)))
         ,@body))))

(defmacro with-compilation-unit (options &body body)
  "The body: each form is compiled for itself.
  Examples:
  (with-compilation-unit () 1 2) => 2"
  (declare (ignore options))
  (%progn body))

(defun provide (module)
  "Says that a module is there.
  Examples:
  (progn (provide :my-module) (require :my-module)) => NIL"
  (pushnew (string module) *modules* :test #'string=)
  t)

(defun system:load-module (module)
  "Loads a module by its name alone, or returns NIL. A layer that knows systems puts its own function in
  place of this one."
  (declare (ignore module))
  nil)

(defun require (module &optional files)
  "Loads the files of a module, or else the system of that name, unless it is there; an error if there
  is none.
  Examples:
  (require :alexandria) => NIL"
  (unless (member (string module) *modules* :test #'string-equal)
    (unless (or files (system:load-module module))
      (error "There is no module or system ~a, and no files are given; there are the modules~{ ~a~}."
             (string module) *modules*))
    (mapc #'load (if (listp files) files (list files)))
    nil))

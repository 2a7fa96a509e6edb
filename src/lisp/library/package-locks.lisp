;;; Package locks: what is asked before a program redefines what is built in. Which names are locked
;;; is decided in Rust.

(in-package :common-lisp)

(defun %ask-about-locks (names what)
  "Signals the error for a definition of locked names, given as pairs with the symbols that a program
  may define instead. Returns true if it is to define those: they then have their names in the current
  package. False if it is to define the locked names after all."
  (let* ((locked (mapcar #'car names))
         (packages (remove-duplicates (mapcar #'symbol-package locked) :from-end t))
         (texts (mapcar #'symbol-name locked)))
    (restart-case
        (error 'system:locked-package-error
               :package (first packages)
               :name (first locked)
               :format-control
               "~{~a~^ and ~} ~:[belong~;belongs~] to ~{the locked package ~a~^ and ~}: to define ~:[them~;it~] as ~a here would change what the language and the plans mean by ~:[them~;it~]."
               :format-arguments
               (let ((is-one (null (rest locked))))
                 (list texts is-one (mapcar #'package-name packages) is-one what is-one)))
      (shadow ()
        :test (lambda (condition)
                (declare (ignore condition))
                (notany (lambda (symbol) (eq (symbol-package symbol) *package*)) locked))
        :report (lambda (stream)
                  (format stream "Shadow ~{~a~^ and ~} in ~a: define ~:[others~;another~] of that name here."
                          texts (package-name *package*) (null (rest texts))))
        (shadowing-import (mapcar #'cdr names))
        t)
      (continue ()
        :report (lambda (stream)
                  (format stream "Redefine ~{~a~^ and ~} for everything that uses ~:[them~;it~]."
                          (mapcar #'%with-package locked) (null (rest texts))))
        nil))))

(defun %with-package (symbol)
  "A symbol's name as it is written anywhere."
  (let ((package (symbol-package symbol)))
    (multiple-value-bind (found status) (find-symbol (symbol-name symbol) package)
      (declare (ignore found))
      (format nil "~a~:[::~;:~]~a" (package-name package) (eq status :external) symbol))))

(defun %tell-of-definition (name place)
  "Warns of the definition of a function that redefines one that is built in or that the same text
  has defined before."
  (destructuring-bind (before here is-built-in) (%note-definition name place)
    (when before
      (%style-warning "~a: ~s is defined for the second time; ~a has the first definition, which is lost."
                      here name before))
    (when is-built-in
      (%style-warning "~s was built in. Your definition is now what every plan calls." name))))

(defun %style-warning (control &rest arguments)
  "Signals a style warning."
  (warn 'system:simple-style-warning :format-control control :format-arguments arguments))

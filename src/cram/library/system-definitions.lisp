;;;; Files that describe systems and have to be evaluated: what they say is computed, or they define
;;;; the system by something other than a form DEFSYSTEM at top level. And what programs ask of
;;;; systems.

(in-package :asdf)

(defvar system::%*defined-systems* '()
  "The options of the systems that evaluated files have defined, by name, the last first.")

(defvar system::%*defining-file* nil
  "The file that describes systems and is being evaluated.")

;;; Classes of operations and components: files name them as what their methods are for.

(defclass operation () ())
(defclass load-op (operation) ())
(defclass compile-op (operation) ())
(defclass load-source-op (operation) ())
(defclass prepare-op (operation) ())
(defclass test-op (operation) ())
(defclass program-op (operation) ())
(defclass component () ((name :initarg :name :reader component-name)))
(defclass module (component) ())
(defclass system (module) ())
(defclass source-file (component) ())
(defclass cl-source-file (source-file) ())
(defclass static-file (source-file) ())
(defclass doc-file (static-file) ())
(defclass html-file (doc-file) ())

(defgeneric perform (operation component)
  (:documentation "Carries out an operation on a component. Methods of programs are for their own systems;
LOAD-SYSTEM does not call them.")
  (:method (operation component) (declare (ignore operation component)) nil))

(defmacro defsystem (name &body options)
  "Defines a system, in a file NAME.asd. Evaluated elsewhere, it makes a system known without files.
  Examples:
  (asdf:defsystem :defined-as-example :version \"1.2\") => \"defined-as-example\""
  `(%define-system ',name ',options))

(defun %define-system (name options)
  "Keeps the options of a system."
  (let ((name (%system-name name)))
    (setf %*defined-systems*
          (acons name options (remove name %*defined-systems* :key #'car :test #'equal)))
    name))

(defun %evaluated-options (name file)
  "The options of a system as the evaluation of a file defines them, or NIL."
  (let ((%*defined-systems* '())
        (%*defining-file* file)
        (*package* (find-package :asdf-user))
        (*features* (adjoin :asdf3.1 (adjoin :asdf3 (adjoin :asdf2 (adjoin :asdf *features*))))))
    (handler-bind ((error (lambda (problem)
                            (unless (typep problem 'file-error)
                              (error "~a cannot be evaluated: ~a" file problem)))))
      (load file))
    (cdr (assoc name %*defined-systems* :test #'string=))))

;;; What programs ask of systems

(defun asdf-version ()
  "The version of ASDF whose functions these are, as far as they go.
  Examples:
  (asdf:asdf-version) => \"3.3.0\""
  "3.3.0")

(defun version-satisfies (version wanted)
  "Is a version as new as another one, or newer?
  Examples:
  (list (asdf:version-satisfies \"3.3.0\" \"3.1\") (asdf:version-satisfies \"2\" \"3.1\")) => (T NIL)"
  (and (uiop:parse-version version) (uiop:version<= wanted version)))

(defun component-version (system)
  "The version of a system that its description tells, or NIL.
  Examples:
  (asdf:component-version :alexandria) => NIL"
  (let* ((name (find-system system))
         (file (and (not (system:built-in-system-p name)) (%system-file name))))
    (and file
         (%version (getf (%system-options name file) :version)
                   (directory-namestring file)))))

(defun system-version (system)
  "The same as COMPONENT-VERSION.
  Examples:
  (asdf:system-version :alexandria) => NIL"
  (component-version system))

(defun %version (version folder)
  "The version that an option means: a string, or where a file says it."
  (cond ((stringp version) version)
        ((and (consp version) (stringp (second version)))
         (let ((file (concatenate 'string folder (second version)))
               (at (getf (cddr version) :at 0)))
           (case (first version)
             (:read-file-form (uiop:read-file-form file :at at))
             (:read-file-line (uiop:read-file-line file :at at))
             (t nil))))
        (t nil)))

(defun %system-option (system key)
  "The value of an option in the description of a system; NIL for one that is built in."
  (let* ((name (find-system system))
         (file (and (not (system:built-in-system-p name)) (%system-file name))))
    (and file (getf (%system-options name file) key))))

(defun component-pathname (system)
  "The pathname of a system's folder; NIL if the system is built in.
  Examples:
  (asdf:component-pathname :alexandria) => NIL"
  (system-source-directory system))

(defun system-description (system)
  "What the description of a system says of it, or NIL.
  Examples:
  (asdf:system-description :alexandria) => NIL"
  (%system-option system :description))

(defun system-author (system)
  "The author of a system, or NIL.
  Examples:
  (asdf:system-author :alexandria) => NIL"
  (%system-option system :author))

(defun system-license (system)
  "The license of a system, or NIL.
  Examples:
  (asdf:system-license :alexandria) => NIL"
  (or (%system-option system :license) (%system-option system :licence)))

(defun system-depends-on (system)
  "What a system depends on, as its description writes it.
  Examples:
  (asdf:system-depends-on :alexandria) => NIL"
  (%system-option system :depends-on))

(defun component-loaded-p (system)
  "Has a system been loaded, or is it built in?
  Examples:
  (asdf:component-loaded-p :alexandria) => T"
  (let ((name (find-system system nil)))
    (and name
         (or (system:built-in-system-p name)
             (member name %*loaded-systems* :test #'string=))
         t)))

(defgeneric operate (operation system &key &allow-other-keys)
  (:documentation "Loads a system, or runs its tests if the operation is TEST-OP.
  Examples:
  (asdf:operate 'asdf:load-op :alexandria) => T")
  (:method (operation system &key &allow-other-keys)
    (if (string= operation '#:test-op)
        (test-system system)
        (load-system system))))

(defun oos (operation system &rest options)
  "The same as OPERATE.
  Examples:
  (asdf:oos 'asdf:load-op :alexandria) => T"
  (apply #'operate operation system options))

(defun compile-system (system &rest options)
  "Loads a system: what is loaded is compiled.
  Examples:
  (asdf:compile-system :alexandria) => T"
  (declare (ignore options))
  (load-system system))

(defun require-system (system &rest options)
  "Loads a system unless it is there already.
  Examples:
  (asdf:require-system :alexandria) => T"
  (declare (ignore options))
  (load-system system))

(defun load-systems (&rest systems)
  "Loads systems.
  Examples:
  (asdf:load-systems :alexandria) => T"
  (mapc #'load-system systems)
  t)

(defun initialize-source-registry (&optional parameter)
  "Nothing: folders are looked for in `asdf:*central-registry*`.
  Examples:
  (asdf:initialize-source-registry) => NIL"
  (declare (ignore parameter))
  nil)

(defun clear-system (system)
  "Forgets that a system has been loaded.
  Examples:
  (asdf:clear-system :alexandria) => NIL"
  (let ((name (%system-name system)))
    (when (member name %*loaded-systems* :test #'string=)
      (setf %*loaded-systems* (remove name %*loaded-systems* :test #'string=))
      t)))

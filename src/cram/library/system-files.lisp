;;;; Files that describe systems, NAME.asd, are read as data, of which nothing is evaluated. Where that is
;;;; not enough, system-definitions.lisp evaluates them.

(in-package :asdf)

;;; Reading

(defun %system-options (name file)
  "The options of a system, as a property list, from the file that describes it. A file that gives or
takes features is evaluated, since what it says depends on them."
  (let* ((forms (%read-description file))
         (options (loop for form in forms
                       for definition = (%definition form)
                       when (and definition
                                 (equal (ignore-errors (%system-name (first definition))) name))
                         return (rest definition))))
    (%checked-options (if (and options
                               (not (%is-computed options))
                               ;; With a package before it, it is read as a keyword.
                               (notany (lambda (name) (%contains-p forms name))
                                       '(*features* :*features*)))
                          options
                          (or (%evaluated-options name file)
                              (error "~a: there is no system ~s in it." file name)))
                      name file)))

(defun %is-computed (options)
  "Has something that loading a system depends on to be computed?"
  (and (alexandria:proper-list-p options)
       (evenp (length options))
       (some (lambda (option) (%contains-p (getf options option) :computed))
             '(:components :depends-on :defsystem-depends-on :pathname :serial :class :version))))

(defun %describes-p (file name)
  "Does a file describe a system of that name?"
  (some (lambda (form)
          (equal (ignore-errors (%system-name (first (%definition form)))) name))
        (%read-description file)))

(defun %definition (form)
  "Name and options in a form (defsystem name …), or NIL."
  (and (alexandria:proper-list-p form)
       ;; A package, as in (asdf:defsystem …), is read as a symbol of its own.
       (let ((place (position-if (lambda (part)
                                   (and (symbolp part) (string= part "DEFSYSTEM")))
                                 (subseq form 0 (min 2 (length form))))))
         (and place (nthcdr (1+ place) form)))))

(defun %read-description (file)
  "The forms of a file that describes systems. What the packages of their symbols would be is not known:
PACKAGE:NAME is read as two symbols, the second a keyword. What #. would evaluate becomes :COMPUTED, and so
does a feature that belongs to a package."
  (let ((*readtable* (copy-readtable nil))
        (*package* (find-package :asdf-user))
        (*read-eval* nil))
    (set-macro-character #\: #'%read-keyword)
    (set-dispatch-macro-character #\# #\. #'%read-computed)
    (set-dispatch-macro-character #\# #\+ #'%read-conditional)
    (set-dispatch-macro-character #\# #\- #'%read-conditional)
    (handler-case
        (with-open-file (stream file)
          (loop for form = (read stream nil stream)
                until (eq form stream)
                collect form))
      ((and error (not file-error)) (problem)
        (error "~a cannot be read: ~a" file problem)))))

(defun %read-keyword (stream character)
  "Reads what stands after one or two colons: a keyword."
  (declare (ignore character))
  (loop while (eql (peek-char nil stream nil) #\:)
        do (read-char stream))
  (let ((object (read stream t nil t)))
    (if (symbolp object) (intern (symbol-name object) :keyword) object)))

(defun %read-computed (stream character argument)
  "Passes over a form that would be evaluated."
  (declare (ignore character argument))
  (read stream t nil t)
  :computed)

(defun %read-conditional (stream character argument)
  "Reads what stands after #+ or #-: a feature expression, and the object that depends on it."
  (declare (ignore argument))
  (let ((expression (let ((*package* (find-package :keyword)))
                      (read stream t nil t))))
    (cond ((eql (peek-char nil stream nil) #\:)
           (read stream t nil t)
           :computed)
          ((eq (alexandria:featurep expression) (char= character #\+))
           (read stream t nil t))
          (t (let ((*read-suppress* t))
               (read stream t nil t))
             (values)))))

(defun %checked-options (options name file)
  "The options of a system, if they can be carried out."
  (unless (and (alexandria:proper-list-p options) (evenp (length options)))
    (error "~a: the options of the system ~s are not a list of keywords with values." file name))
  (let ((class (getf options :class)))
    (when (and (symbolp class) (string= class "PACKAGE-INFERRED-SYSTEM"))
      (error "~a: the system ~s is a package-inferred one; only those with components can be loaded."
             file name)))
  (when (%performs-p (getf options :perform))
    (warn "~a: the system ~s has :PERFORM for LOAD-OP, which is not evaluated." file name))
  options)

(defun %contains-p (tree leaf)
  "Is the leaf in the tree?"
  (if (consp tree)
      (or (%contains-p (car tree) leaf) (%contains-p (cdr tree) leaf))
      (eq tree leaf)))

(defun %performs-p (perform)
  "Would an option :PERFORM do something when the system is loaded?"
  (and (consp perform)
       (symbolp (first perform))
       (member (first perform) '("LOAD-OP" "COMPILE-OP" "LOAD-SOURCE-OP" "PREPARE-OP")
               :test #'string=)))

;;; What a system depends on

(defun %dependencies (options file)
  "The names of the systems that a system depends on."
  (loop for entry in (append (getf options :defsystem-depends-on)
                             (getf options :depends-on)
                             (remove-if-not (lambda (entry)
                                              (ignore-errors (find-system entry nil)))
                                            (getf options :weakly-depends-on)))
        for name = (%dependency entry file)
        when name collect name))

(defun %dependency (entry file)
  "The name of a system in an entry of :DEPENDS-ON; NIL if the entry does not apply."
  (cond ((or (stringp entry) (and entry (symbolp entry)))
         (%system-name entry))
        ((and (consp entry) (eq (first entry) :feature) (= (length entry) 3))
         (and (%feature-p (second entry) file)
              (%dependency (third entry) file)))
        ((and (consp entry) (member (first entry) '(:version :require)) (rest entry))
         (%dependency (second entry) file))
        (t (error "~a: ~s is no system to depend on; a name, (:version NAME …) and (:feature EXPRESSION NAME) are."
                  file entry))))

(defun %feature-p (expression file)
  "Is a feature expression true?"
  (handler-case (alexandria:featurep expression)
    (error () (error "~a: ~s is no feature expression." file expression))))

;;; Components

(defun %files-of (options file)
  "The files of a system in the order in which they are loaded."
  (%component-files (getf options :components) (getf options :serial)
                    (%folder (directory-namestring file) (getf options :pathname))
                    file))

(defun %folder (base pathname)
  "The folder of that name in another one."
  (cond ((null pathname) base)
        ((pathnamep pathname) (%folder base (namestring pathname)))
        ((not (stringp pathname)) (error "~s is no name of a folder." pathname))
        ((string= pathname "") base)
        (t (let ((folder (if (alexandria:ends-with #\/ pathname)
                             pathname
                             (concatenate 'string pathname "/"))))
             (if (alexandria:starts-with #\/ folder)
                 folder
                 (concatenate 'string base folder))))))

(defun %component-files (components serial folder file)
  "The files of components: each after those that it depends on, else in the order given."
  (unless (and (alexandria:proper-list-p components)
               (every #'%component-p components))
    (error "~a: a component is written (:file \"name\" …) or (:module \"name\" :components (…)), not ~s."
           file
           (if (alexandria:proper-list-p components)
               (find-if-not #'%component-p components)
               components)))
  (let ((files '())
        (finished '())
        (open '()))
    (labels ((visit (component)
               (let ((name (%system-name (second component))))
                 (cond ((member component finished :test #'eq))
                       ((member name open :test #'string=)
                        (error "~a: components depend on each other in a circle: ~{~a~^, which needs ~}."
                               file (append (reverse open) (list name))))
                       (t (push name open)
                          (mapc #'visit (needed component))
                          (pop open)
                          (push component finished)
                          (setf files (revappend (files-of component) files))))))
             (needed (component)
               (append (and serial (ldiff components (member component components :test #'eq)))
                       (loop for entry in (getf (cddr component) :depends-on)
                             for other = (find-component entry component)
                             when other collect other)))
             (find-component (entry component)
               (let ((wanted (%dependency entry file))
                     (names (mapcar (lambda (other) (%system-name (second other))) components)))
                 (when wanted
                   (or (find wanted components
                             :key (lambda (other) (%system-name (second other)))
                             :test #'string=)
                       (error "~a: the component ~s depends on ~s, which is not there~:[.~;~:*; did you mean ~a?~]"
                              file (second component) wanted
                              (system:closest-name wanted names))))))
             (files-of (component)
               (if (%feature-p (getf (cddr component) :if-feature '(:and)) file)
                   (%files-of-component component folder file)
                   '())))
      (mapc #'visit components))
    (reverse files)))

(defun %component-p (object)
  "Is the object a component: a kind, a name, and options?"
  (and (alexandria:proper-list-p object)
       (symbolp (first object))
       (typep (second object) '(and (or string symbol) (not null)))
       (evenp (length object))))

(defun %files-of-component (component folder file)
  "The files of one component."
  (destructuring-bind (kind name &key pathname components serial &allow-other-keys) component
    (let ((name (%system-name name)))
      (case kind
        (:module
         (%component-files components serial (%folder folder (or pathname name)) file))
        ((:static-file :doc-file :html-file :text-file :markdown-file) '())
        ((:file :cl-source-file)
         (list (or (%source-file folder (or pathname name))
                   (%no-source-file folder (or pathname name) file))))
        ((:c-source-file :c-file :cffi-grovel-file :cffi-wrapper-file :grovel-file :wrapper-file
          :object-file :so-file)
         (error "~a: the component ~s is of the kind ~s: foreign functions there are not."
                file name kind))
        ;; A kind of the file's own: source if it is there as such, else something to be read by people.
        (t (let ((source (%source-file folder (or pathname name))))
             (and source (list source))))))))

(defun %source-file (folder name)
  "The file with the source of a component, or NIL."
  (let* ((name (concatenate 'string folder name))
         (with-type (concatenate 'string name ".lisp")))
    (cond ((probe-file with-type) with-type)
          ((and (pathname-type name) (probe-file name)) name))))

(defun %no-source-file (folder name file)
  "Signals that the source of a component of a system is missing."
  (let ((with-type (concatenate 'string folder name ".lisp")))
    (error "~a: there is no file ~a~:[.~;~:*; did you mean ~a?~]"
           file with-type
           (system:closest-name (file-namestring with-type)
                                (system:file-names (directory-namestring with-type))))))

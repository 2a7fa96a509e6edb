;;;; ASDF: loading systems, the libraries of Common Lisp, from folders that the user names. What a
;;;; system consists of stands in a file NAME.asd; system-files.lisp reads it.

(in-package :asdf)

(defvar asdf:*central-registry* '()
  "Folders in which systems are looked for, with the folders inside them: names, or forms that return
names.")

(defvar system::%*loaded-systems* '()
  "The names of the systems that have been loaded, the last first.")

(defvar system::%*loading-systems* '()
  "The names of the systems that are being loaded, the innermost first.")

(defvar swank:*readtable-alist* '()
  "Pairs of the name of a package and the readtable for it, as libraries of readtables keep them for
SLIME.")

(defvar system::%*known-system-files* :unknown
  "The files that describe systems, while they are known; else :UNKNOWN.")

(defvar system::%*loaded-built-in-files* '()
  "The names of the files of built-in systems that have been loaded.")

(defvar system::%*file-local-variables* '()
  "Variables that each file of a system binds anew.")

(defun load-system (system &key force verbose version force-not)
  "Loads a system, and before it those that it depends on, unless it is there already. It is looked for
  in the folders of `asdf:*central-registry*`; `--systems FOLDER` adds one.
  Examples:
  (asdf:load-system :cram-language) => T"
  (declare (ignore verbose version force-not))
  (let ((%*known-system-files* (%system-files)))
    (%load-any-system system force))
  t)

(defun %load-any-system (system force)
  "Loads a system, built in or not."
  (cond ((%own-files-of system)
         (%load-system (%own-files-of system) force nil))
        ((system:built-in-files system)
         (%load-built-in-files system force))
        ((system:load-built-in-system system))
        ((%in-place-of (%system-name system))
         (error "The system ~a is not here: ~a." (%system-name system)
                (%in-place-of (%system-name system))))
        ((%provide-messages (%system-name system)))
        (t (%load-system (%system-name system) force nil))))

(defun %own-files-of (system)
  "The name under which the registry has a system of which only the package, or a demo, is built in; else NIL."
  (when (or (system:without-files-p system) (system:built-in-files system))
    (find-if #'%system-file
             (list (%system-name system)
                   (substitute #\- #\_ (%system-name system))
                   (substitute #\_ #\- (%system-name system))))))

(defun quicklisp-client:quickload (systems &key verbose silent prompt explain)
  "Loads a system or a list of them, as `asdf:load-system` does; nothing is downloaded. Returns a list
  of their names.
  Examples:
  (ql:quickload '(:cram-language :alexandria)) => (:CRAM-LANGUAGE :ALEXANDRIA)"
  (declare (ignore verbose silent prompt explain))
  (mapc #'load-system (alexandria:ensure-list systems)))

(defun ros-load:load-system (package &optional system)
  "The same as `asdf:load-system`: the systems of CRAM are built in, others are those of the user.
  Examples:
  (ros-load:load-system \"cram_pick_place_tutorial\") => T"
  (load-system (if (system:built-in-system-p package) package (or system package))))

(defun find-system (system &optional (errorp t))
  "The name of a system as a string, if there is such a system; else an error, or NIL.
  Examples:
  (asdf:find-system :no-such-system nil) => NIL
  (asdf:find-system :alexandria) => \"alexandria\""
  (let ((name (%system-name system)))
    (cond ((or (system:built-in-system-p name) (%system-file name)) name)
          (errorp (%no-system name nil)))))

(defun system-source-file (system)
  "The pathname of the file that describes a system; NIL if it is built in.
  Examples:
  (asdf:system-source-file :alexandria) => NIL"
  (let ((name (find-system system)))
    (unless (system:built-in-system-p name)
      (pathname (%system-file name)))))

(defun system-source-directory (system)
  "The pathname of a system's folder; NIL if the system is built in.
  Examples:
  (asdf:system-source-directory :alexandria) => NIL"
  (let ((file (system-source-file system)))
    (and file (pathname (directory-namestring file)))))

(defun system-relative-pathname (system name)
  "The pathname of a file in the folder of a system.
  Examples:
  (asdf:system-relative-pathname :alexandria \"a.txt\") => #P\"a.txt\""
  (merge-pathnames name (or (system-source-directory system) "")))

(defun registered-systems ()
  "The names of all systems that `asdf:*central-registry*` leads to.
  Examples:
  (let ((asdf:*central-registry* '())) (asdf:registered-systems)) => NIL"
  (remove-duplicates (mapcar #'pathname-name (%system-files)) :test #'string= :from-end t))

(defun already-loaded-systems ()
  "The names of the systems that have been loaded from files.
  Examples:
  (listp (asdf:already-loaded-systems)) => T"
  (copy-list %*loaded-systems*))

(defmacro net.didierverna.asdf-flv:set-file-local-variable (variable)
  "Lets each file of a system that is loaded from now on have its own binding of a variable.
  Examples:
  (net.didierverna.asdf-flv:set-file-local-variable *print-base*) => (*PRINT-BASE*)"
  `(net.didierverna.asdf-flv:set-file-local-variables ,variable))

(defmacro net.didierverna.asdf-flv:set-file-local-variables (&rest variables)
  "Lets each file of a system that is loaded from now on have its own bindings of variables.
  Examples:
  (net.didierverna.asdf-flv:set-file-local-variables *print-base* *read-base*) => (*PRINT-BASE* *READ-BASE*)"
  `(progn
     (setf %*file-local-variables* (union %*file-local-variables* ',variables))
     ',variables))

(defun system:load-module (module)
  "Loads the system with the name of a module; NIL if there is none."
  (and (find-system module nil)
       (load-system module)))

;;; Finding

(defun %system-name (designator)
  "The name of a system as a string."
  (typecase designator
    (string designator)
    (symbol (string-downcase designator))
    (t (error 'type-error :datum designator :expected-type '(or string symbol)))))

(defun %primary-name (name)
  "The part of a system's name that names its file: what stands before the first slash."
  (subseq name 0 (position #\/ name)))

(defun %registry-folders ()
  "The folders of the registry, each with a slash at its end."
  (loop for entry in asdf:*central-registry*
        for folder = (if (typep entry '(or cons (and symbol (not null)))) (eval entry) entry)
        when folder
          collect (if (alexandria:ends-with #\/ (namestring folder))
                      (namestring folder)
                      (concatenate 'string (namestring folder) "/"))))

(defun %system-files ()
  "The files that describe systems: those of a folder before those of the folders inside it."
  (if (listp %*known-system-files*)
      %*known-system-files*
      (let ((seen (make-hash-table :test 'equal)))
        (loop for folder in (%registry-folders)
              append (%system-files-in folder seen)))))

(defun %system-files-in (folder seen)
  "The files that describe systems in a folder and in those inside, as far as these have not been
  seen: links may lead in a circle."
  (let ((place (ignore-errors (namestring (truename folder)))))
    (unless (or (null place) (gethash place seen))
      (setf (gethash place seen) t)
      (let ((names (system:file-names folder)))
        (append
         (loop for name in names
               when (equal (pathname-type name) "asd")
                 collect (concatenate 'string folder name))
         (loop for name in names
               when (and (alexandria:ends-with #\/ name)
                         (not (alexandria:starts-with #\. name)))
                 append (%system-files-in (concatenate 'string folder name) seen)))))))

(defun %system-file (name)
  "The file that describes a system, or NIL."
  (let ((files (%system-files)))
    (or (find (%primary-name name) files :key #'pathname-name :test #'string=)
        ;; A file may describe further systems: library.asd that of its tests, library-test.
        (find-if (lambda (file)
                   (and (alexandria:starts-with-subseq (pathname-name file) name)
                        (%describes-p file name)))
                 (sort (copy-list files) #'> :key #'length)))))

(defun %no-system (name dependent)
  "Signals that there is no such system, which another one may depend on."
  (let* ((folders (%registry-folders))
         (names (append (registered-systems) (system:built-in-systems)))
         (primary (%primary-name name))
         ;; Built-in names are written as in ROS.
         (near (or (system:closest-name primary names)
                   (system:closest-name (substitute #\_ #\- primary) names))))
    (error "There is no system ~s~@[, on which ~a depends~]~:[.~;~:*; did you mean ~a?~] ~
            These are built in: ~{~a~^, ~}. ~
            ~:[(push \"FOLDER/\" asdf:*central-registry*) or --systems FOLDER adds a folder of others.~;~
            ~:*Others were looked for in ~{~a~^, ~} and the folders inside.~]"
           name dependent near (system:built-in-systems) folders)))

(defun %check-possible (name dependent)
  "Signals an error for systems that cannot work here, with the reason."
  (let ((reason (%impossible name)))
    (when reason
      (error "The system ~s~@[, on which ~a depends,~] ~a." name dependent reason))))

(defun %impossible (name)
  "Why a system of this name cannot work here, or NIL."
  (flet ((is (&rest names)
           (member name names :test #'string=)))
    (cond ((or (is "cffi" "osicat" "iolib" "cl+ssl" "static-vectors")
               (alexandria:starts-with-subseq "cffi-" name))
           "calls foreign functions, which there are not")
          ((is "lparallel" "chanl" "bt-semaphore" "eager-future2")
           "needs threads of the machine, which there are not; CPL:PAR and CPL:PURSUE do several things at once")
          ((is "usocket" "hunchentoot" "drakma" "dexador")
           "needs sockets, which there are not")
          ((alexandria:starts-with-subseq "sb-" name)
           "is a part of SBCL"))))

;;; Loading

(defun %load-system (name force dependent)
  "Loads a system that is not built in."
  (cond ((and (not force) (member name %*loaded-systems* :test #'string=)))
        ((member name %*loading-systems* :test #'string=)
         (error "Systems depend on each other in a circle: ~{~a~^, which needs ~}."
                (append (reverse %*loading-systems*) (list name))))
        (t
         (let ((file (%system-file name)))
           (unless file
             (%check-possible name dependent)
             (%no-system name dependent))
           (let* ((options (%system-options name file))
                  (%*loading-systems* (cons name %*loading-systems*)))
             (declare (special %*loading-systems*))
             (dolist (needed (%dependencies options file))
               (%load-needed needed name))
             (mapc #'%load-file (%files-of options file)))
           (pushnew name %*loaded-systems* :test #'string=)))))

(defun %load-needed (system dependent)
  "Loads a system on which another one depends. Of what is not here, it says so, and goes on."
  (cond ((%own-files-of system)
         (%load-system (%own-files-of system) nil dependent))
        ((system:built-in-system-p system)
         (%load-built-in-files system nil))
        ((%in-place-of system)
         (%tell-absent system dependent))
        ((%provide-messages system))
        (t
         (%check-possible system dependent)
         (%load-system system nil dependent))))

(defun %load-built-in-files (system force)
  "Loads the files of a built-in system that has some, unless they are there already."
  (dolist (file (system:built-in-files system))
    (when (or force (not (member file %*loaded-built-in-files* :test #'string=)))
      (system:load-built-in-file file)
      (pushnew file %*loaded-built-in-files* :test #'string=)))
  (when (string= (%system-name system) "closer-mop")
    (%provide-closer-common-lisp)))

(defun %provide-closer-common-lisp ()
  "Makes the packages of closer-mop that have its names and those of the language."
  (unless (find-package "CLOSER-COMMON-LISP")
    (let ((package (make-package "CLOSER-COMMON-LISP" :nicknames '("C2CL") :use '("COMMON-LISP"))))
      (do-external-symbols (symbol "CLOSER-MOP")
        (shadowing-import symbol package))
      (dolist (from '("COMMON-LISP" "CLOSER-MOP"))
        (do-external-symbols (symbol from)
          (export (list (find-symbol (symbol-name symbol) package)) package)))
      (make-package "CLOSER-COMMON-LISP-USER" :nicknames '("C2CL-USER") :use (list package)))))

(defun %load-file (file)
  "Loads a file of a system. It has its own package and readtable."
  (let ((variables %*file-local-variables*))
    (progv variables (mapcar #'symbol-value variables)
      ;; A system's files are compiled, then loaded.
      (let ((%*as-compiled* :next))
        (load file)))))

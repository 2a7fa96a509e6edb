;;; Files: chapter 20 of the standard.

(in-package :common-lisp)

(defvar *load-verbose* nil
  "Whether LOAD tells what it loads.")

(defvar *load-print* nil
  "Whether LOAD prints the values of forms.")

(defvar *compile-verbose* nil
  "Whether COMPILE-FILE tells what it does, for programs that ask; it never does.")

(defvar *compile-print* nil
  "Whether COMPILE-FILE tells what it compiles, for programs that ask; it never does.")

(defvar *compile-file-pathname* nil
  "The file that COMPILE-FILE compiles, for programs that ask; forms are compiled when they are loaded.")

(defvar *compile-file-truename* nil
  "The true name of the file that COMPILE-FILE compiles, for programs that ask.")

(defun %native (file)
  "The name by which the machine knows a file."
  (%namestring (translate-logical-pathname (merge-pathnames file))))

(defun open (file &rest options
             &key direction element-type if-exists if-does-not-exist external-format)
  "Opens a file for reading (the default), writing, or both; `with-open-file` closes it again. Its
  elements are characters, or bytes if the type is one of integers.
  Examples:
  (open \"no-such-file.txt\" :if-does-not-exist nil) => NIL"
  (declare (ignore direction if-exists if-does-not-exist external-format))
  (apply #'%open-file (%native file) (%byte-size element-type) options))

(defun %byte-size (type)
  "The number of bits of a file's elements, negative if they have a sign; NIL for characters."
  (cond ((or (null type) (eq type :default) (subtypep type 'character)) nil)
        ((subtypep type '(integer 0))
         (or (loop for bits from 1 to 1024
                   when (subtypep type `(unsigned-byte ,bits)) return bits)
             8))
        ((subtypep type 'integer)
         (or (loop for bits from 1 to 1024
                   when (subtypep type `(signed-byte ,bits)) return (- bits))
             -8))
        (t (error "~s is no type of a file's elements; these are characters or integers." type))))

(defun probe-file (file)
  "The pathname of a file if there is one, else NIL.
  Examples:
  (probe-file \"no-such-file.txt\") => NIL"
  (let ((name (%true-name (%native file))))
    (and name (%parse-pathname name))))

(defun truename (file)
  "The pathname of a file that exists: absolute, and without links.
  Examples:
  (handler-case (truename \"no such file\") (file-error () :missing)) => :MISSING"
  ;; To open a file that does not exist is an error that says so.
  (or (probe-file file)
      (progn (close (open file)) (probe-file file))))

(defun delete-file (file)
  "Deletes a file.
  Examples:
  (handler-case (delete-file \"no such file\") (file-error () :missing)) => :MISSING"
  (%delete-file (%native file)))

(defun rename-file (file new-name)
  "Renames a file; parts that the new name lacks are those of the old one. Returns the new name, and the
  true names before and after.
  Examples:
  (handler-case (rename-file \"no such file\" \"another\") (file-error () :missing)) => :MISSING"
  (let ((new (merge-pathnames new-name file))
        (old (truename file)))
    (%rename-file (%native file) (%native new))
    (values new old (truename new))))

(defun file-write-date (file)
  "The universal time at which a file was written last.
  Examples:
  (handler-case (file-write-date \"no such file\") (file-error () :missing)) => :MISSING"
  (%file-date (%native file)))

(defun file-author (file)
  "The author of a file: NIL, since files do not tell.
  Examples:
  (handler-case (file-author \"no such file\") (file-error () :missing)) => :MISSING"
  (truename file)
  nil)

(defun ensure-directories-exist (file &key verbose)
  "Makes the directories of a file that are not there; the file's pathname, and whether one was made.
  Examples:
  (ensure-directories-exist \"a.txt\") => #P\"a.txt\" ; NIL"
  (declare (ignore verbose))
  (values (pathname file)
          (%make-directories (directory-namestring (%native file)))))

(defun directory (file &key &allow-other-keys)
  "The true names of all files that a name, which may be wild, stands for, in alphabetical order.
  Examples:
  (directory \"no-such-folder/*.*\") => NIL"
  (let* ((file (merge-pathnames file))
         (folders (%folders (%checked-directory file)))
         (name (pathname-name file))
         (type (pathname-type file))
         (found '()))
    (dolist (folder folders)
      (if (or name type)
          (dolist (entry (system:file-names (if (string= folder "") "." folder)))
            (let* ((plain (string-right-trim "/" entry))
                   (parts (%parse-pathname plain)))
              (when (and (%part-match-p (pathname-name parts) name)
                         (or (%part-match-p (pathname-type parts) type)
                             (and (null type) (eq name :wild) (null (pathname-type parts)))))
                (push (probe-file (concatenate 'string folder plain)) found))))
          (push (probe-file folder) found)))
    (sort (remove-duplicates (remove nil found) :test #'equal) #'string< :key #'namestring)))

(defun %checked-directory (file)
  "The directory of a file, if it does not go up from where there is nothing above."
  (let ((directory (pathname-directory file)))
    (loop for (part next) on directory
          when (and (member part '(:absolute :wild-inferiors)) (member next '(:up :back)))
            do (error 'file-error :pathname file))
    directory))

(defun %folders (directory)
  "The names of the folders that a pathname's directory stands for, each with a slash at its end."
  (labels ((below (folder)
             (loop for entry in (system:file-names (if (string= folder "") "." folder))
                   when (alexandria:ends-with #\/ entry)
                     collect entry))
           (expand (folder parts depth)
             (destructuring-bind (&optional part &rest rest) parts
               (cond ((null parts) (list folder))
                     ((eq part :wild-inferiors)
                      (append (expand folder rest depth)
                              ;; Links might lead in a circle.
                              (when (plusp depth)
                                (loop for entry in (below folder)
                                      append (expand (concatenate 'string folder entry) parts
                                                     (1- depth))))))
                     ((or (eq part :wild) (and (stringp part) (find #\* part)))
                      (loop for entry in (below folder)
                            when (%part-match-p (string-right-trim "/" entry) part)
                              append (expand (concatenate 'string folder entry) rest depth)))
                     (t (expand (concatenate 'string folder
                                             (directory-namestring
                                              (%pathname-of-parts (list :relative part) nil nil nil)))
                                rest depth))))))
    (expand (if (eq (first directory) :absolute) "/" "") (rest directory) 32)))

(defun user-homedir-pathname (&optional host)
  "The directory of the user: that in which the program was started.
  Examples:
  (pathname-name (user-homedir-pathname)) => NIL"
  (declare (ignore host))
  (probe-file "./"))

(defun compile-file-pathname (file &key output-file)
  "The file that COMPILE-FILE would write: that which it reads, since forms are compiled when they are
  loaded.
  Examples:
  (compile-file-pathname \"a.lisp\") => #P\"a.lisp\""
  (declare (ignore output-file))
  (merge-pathnames file))

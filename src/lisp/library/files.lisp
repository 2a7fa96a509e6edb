;;; Names of files: chapter 19 of the standard. A pathname is a string; directories are separated
;;; by slashes, and a name that ends with one is that of a directory.

(in-package :common-lisp)

(defun pathname (file)
  "The name of a file.
  Examples:
  (pathname \"plans/a.lisp\") => \"plans/a.lisp\""
  (check-type file (or string symbol))
  (string file))

(defun namestring (file)
  "The name of a file as a string.
  Examples:
  (namestring \"plans/a.lisp\") => \"plans/a.lisp\""
  (pathname file))

(defun directory-namestring (file)
  "The part of a file's name that is its directory, with the slash at its end.
  Examples:
  (directory-namestring \"plans/a.lisp\") => \"plans/\""
  (let ((name (pathname file)))
    (subseq name 0 (1+ (or (position #\/ name :from-end t) -1)))))

(defun file-namestring (file)
  "A file's name without its directory.
  Examples:
  (file-namestring \"plans/a.lisp\") => \"a.lisp\""
  (let ((name (pathname file)))
    (subseq name (1+ (or (position #\/ name :from-end t) -1)))))

(defun pathname-name (file)
  "A file's name without directory and type; NIL if it has none.
  Examples:
  (pathname-name \"plans/a.lisp\") => \"a\"
  (pathname-name \"plans/\") => NIL"
  (let* ((name (file-namestring file))
         (dot (%type-dot name)))
    (if (string= name "") nil (subseq name 0 dot))))

(defun pathname-type (file)
  "What stands after the last dot of a file's name; NIL if it has none.
  Examples:
  (pathname-type \"plans/a.lisp\") => \"lisp\"
  (pathname-type \".profile\") => NIL"
  (let* ((name (file-namestring file))
         (dot (%type-dot name)))
    (and dot (subseq name (1+ dot)))))

(defun %type-dot (name)
  "Where the dot before the type of a file's name is. A name may begin with a dot."
  (let ((dot (position #\. name :from-end t)))
    (and dot (plusp dot) dot)))

(defun pathname-directory (file)
  "The directory of a file as a list.
  Examples:
  (pathname-directory \"/home/me/a.lisp\") => (:ABSOLUTE \"home\" \"me\")
  (pathname-directory \"a.lisp\") => NIL"
  (let ((directory (directory-namestring file)))
    (unless (string= directory "")
      (cons (if (char= (char directory 0) #\/) :absolute :relative)
            (remove "" (%split-at-slashes directory) :test #'string=)))))

(defun %split-at-slashes (text)
  "The parts of a text between its slashes."
  (loop for start = 0 then (1+ end)
        for end = (position #\/ text :start start)
        collect (subseq text start end)
        while end))

(defun make-pathname (&key directory name type defaults host device version)
  "The name of a file, put together from its parts. A directory is a string or a list that begins with
  :ABSOLUTE or :RELATIVE. Parts that are not given are those of the default.
  Examples:
  (make-pathname :directory '(:absolute \"home\" \"me\") :name \"a\" :type \"lisp\") => \"/home/me/a.lisp\""
  (declare (ignore host device version))
  (let* ((directory (or directory (and defaults (pathname-directory defaults))))
         (name (or name (and defaults (pathname-name defaults))))
         (type (or type (and defaults (pathname-type defaults)))))
    (concatenate 'string
                 (cond ((null directory) "")
                       ((stringp directory)
                        (if (alexandria:ends-with #\/ directory)
                            directory
                            (concatenate 'string directory "/")))
                       (t (format nil "~:[~;/~]~{~a/~}"
                                  (eq (first directory) :absolute) (rest directory))))
                 (or name "")
                 (if type "." "")
                 (or type ""))))

(defun merge-pathnames (file &optional (defaults "") version)
  "The name of a file, with the parts that it lacks from another name; a relative directory is one
  in the directory of that.
  Examples:
  (merge-pathnames \"b.lisp\" \"/home/me/a.lisp\") => \"/home/me/b.lisp\"
  (merge-pathnames \"plans/b\" \"/home/me/a.lisp\") => \"/home/me/plans/b.lisp\""
  (declare (ignore version))
  (let ((directory (directory-namestring file)))
    (concatenate 'string
                 (if (alexandria:starts-with #\/ directory)
                     directory
                     (concatenate 'string (directory-namestring defaults) directory))
                 (make-pathname :name (or (pathname-name file) (pathname-name defaults))
                                :type (or (pathname-type file) (pathname-type defaults))))))

(defun enough-namestring (file &optional (defaults ""))
  "The name of a file as seen from the directory of another.
  Examples:
  (enough-namestring \"/home/me/a.lisp\" \"/home/me/\") => \"a.lisp\""
  (let ((name (pathname file))
        (directory (directory-namestring defaults)))
    (if (alexandria:starts-with-subseq directory name)
        (subseq name (length directory))
        name)))

(defun wild-pathname-p (file &optional part)
  "Does a file's name stand for several?
  Examples:
  (wild-pathname-p \"*.lisp\") => T"
  (declare (ignore part))
  (and (find #\* (pathname file)) t))

(defun truename (file)
  "The name of a file that exists.
  Examples:
  (handler-case (truename \"no such file\") (file-error () :missing)) => :MISSING"
  ;; To open a file that does not exist is an error that says so.
  (or (probe-file file)
      (progn (close (open (pathname file))) file)))

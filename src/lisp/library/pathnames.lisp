;;; Pathnames: chapter 19 of the standard. There are no devices; only logical pathnames have hosts
;;; (logical-pathnames.lisp).

(in-package :common-lisp)

(defvar *default-pathname-defaults* (%parse-pathname "")
  "The pathname from which others take the parts that they lack.")

(defun pathname (file)
  "The pathname of a file: of its name, or of a stream that reads or writes it.
  Examples:
  (pathname \"plans/a.lisp\") => #P\"plans/a.lisp\""
  (cond ((pathnamep file) file)
        ((stringp file) (%parse-name file))
        ((typep file 'synonym-stream) (pathname (symbol-value (synonym-stream-symbol file))))
        ((and (streamp file) (%stream-file file)) (%parse-pathname (%stream-file file)))
        (t (error 'type-error :datum file :expected-type '(or string pathname file-stream)))))

(defun namestring (file)
  "The name of a file as a string.
  Examples:
  (namestring #P\"plans/a.lisp\") => \"plans/a.lisp\""
  (%namestring (pathname file)))

(defun parse-namestring (thing &optional host (defaults *default-pathname-defaults*)
                         &key (start 0) end junk-allowed)
  "The pathname of a part of a string, and the index after it; other files as by PATHNAME.
  Examples:
  (parse-namestring \"see a.lisp\" nil nil :start 4) => #P\"a.lisp\" ; 10"
  (declare (ignore junk-allowed))
  (if (stringp thing)
      (let* ((text (subseq thing start end))
             (logical (cond (host (%logical-host host))
                            ((%host-of-name text))
                            (defaults (pathname-host defaults)))))
        (values (if logical
                    (%parse-logical (%without-host text logical) logical)
                    (%parse-pathname text))
                (or end (length thing))))
      (let ((pathname (pathname thing)))
        (if (and host (not (equal (pathname-host pathname) (%logical-host host))))
            (error "The host of ~s is not ~a." pathname host))
        (values pathname start))))

(defun %parse-name (name)
  "The pathname of a name: a logical one if it begins with a logical host and a colon."
  (let ((host (%host-of-name name)))
    (if host
        (%parse-logical (%without-host name host) host)
        (%parse-pathname name))))

(defun directory-namestring (file)
  "The part of a file's name that is its directory, with the slash at its end.
  Examples:
  (directory-namestring \"plans/a.lisp\") => \"plans/\""
  (let ((name (%namestring (%pathname-of-parts (pathname-directory file) nil nil nil
                                               (pathname-host file)))))
    (%without-host name (pathname-host file))))

(defun file-namestring (file)
  "A file's name without its directory.
  Examples:
  (file-namestring \"plans/a.lisp\") => \"a.lisp\""
  (multiple-value-bind (directory name type version host) (%pathname-parts (pathname file))
    (declare (ignore directory))
    (%without-host (%namestring (%pathname-of-parts nil name type version host)) host)))

(defun host-namestring (file)
  "The name of a file's host: that of a logical pathname, else nothing.
  Examples:
  (host-namestring \"a.lisp\") => \"\""
  (or (pathname-host file) ""))

(defun pathname-host (file &key (case :local))
  "The host of a logical pathname, a string; NIL for other files.
  Examples:
  (pathname-host \"a.lisp\") => NIL"
  (%in-case (nth-value 4 (%pathname-parts (pathname file))) case))

(defun pathname-device (file &key (case :local))
  "The device of a file: NIL, since there are none; of a logical pathname, :UNSPECIFIC.
  Examples:
  (pathname-device \"a.lisp\") => NIL"
  (declare (ignore case))
  (if (typep (pathname file) 'logical-pathname) :unspecific nil))

(defun pathname-directory (file &key (case :local))
  "The directory of a file as a list.
  Examples:
  (pathname-directory \"/home/me/a.lisp\") => (:ABSOLUTE \"home\" \"me\")
  (pathname-directory \"a.lisp\") => NIL"
  (%in-case (nth-value 0 (%pathname-parts (pathname file))) case))

(defun pathname-name (file &key (case :local))
  "A file's name without directory and type; NIL if it has none.
  Examples:
  (pathname-name \"plans/a.lisp\") => \"a\"
  (pathname-name \"plans/\") => NIL"
  (%in-case (nth-value 1 (%pathname-parts (pathname file))) case))

(defun pathname-type (file &key (case :local))
  "What stands after the last dot of a file's name; NIL if it has none.
  Examples:
  (pathname-type \"plans/a.lisp\") => \"lisp\"
  (pathname-type \".profile\") => NIL"
  (%in-case (nth-value 2 (%pathname-parts (pathname file))) case))

(defun pathname-version (file)
  "The version of a file, as it was given to MAKE-PATHNAME.
  Examples:
  (pathname-version \"a.lisp\") => NIL"
  (nth-value 3 (%pathname-parts (pathname file))))

(defun %in-case (part case)
  "A part of a pathname. With :COMMON, what is all in one case here is in the other one there."
  (cond ((eq case :local) part)
        ((not (eq case :common))
         (error 'type-error :datum case :expected-type '(member :local :common)))
        ((consp part) (mapcar (lambda (one) (%in-case one case)) part))
        ((not (stringp part)) part)
        ((notany #'upper-case-p part) (string-upcase part))
        ((notany #'lower-case-p part) (string-downcase part))
        (t part)))

(defun make-pathname (&key (directory nil directory-p) (name nil name-p) (type nil type-p)
                           (version nil version-p) (defaults nil defaults-p) (host nil host-p) device
                           (case :local))
  "A pathname, put together from its parts. A directory is a list that begins with :ABSOLUTE or
  :RELATIVE, or a string: the name of one in the root. Parts that are not given are those of the default.
  Examples:
  (make-pathname :directory '(:absolute \"home\" \"me\") :name \"a\" :type \"lisp\") => #P\"/home/me/a.lisp\""
  (declare (ignore device))
  (flet ((part (given given-p default)
           (if given-p (%in-case given case) (and defaults-p (funcall default defaults)))))
    (let ((host (cond ((and host-p host) (%logical-host host))
                      (host-p nil)
                      (t (pathname-host (if defaults-p defaults *default-pathname-defaults*))))))
      (%checked-pathname (if directory-p
                             (%directory (%in-case directory case))
                             (and defaults-p (pathname-directory defaults)))
                         (part name name-p #'pathname-name)
                         (part type type-p #'pathname-type)
                         (part version version-p #'pathname-version)
                         host))))

(defun %directory (directory)
  "A directory as a list, from what MAKE-PATHNAME takes for one."
  (cond ((null directory) nil)
        ((stringp directory) (list :absolute directory))
        ((eq directory :wild) (list :absolute :wild-inferiors))
        ((consp directory) (remove "" directory :test #'equal))
        (t directory)))

(defun %checked-pathname (directory name type version host)
  "The pathname with these parts, if they can be parts of one."
  (unless (and (listp directory)
               (or (null directory) (member (first directory) '(:absolute :relative)))
               (every (lambda (part)
                        (typep part '(or string (member :up :back :wild :wild-inferiors))))
                      (rest directory)))
    (error "~s is no directory; it is a string, or a list of :ABSOLUTE or :RELATIVE and names." directory))
  (dolist (part (list name type))
    (unless (typep part '(or string (member nil :wild :unspecific)))
      (error "~s is no part of a file's name; it is a string, :WILD or NIL." part)))
  (flet ((part (part)
           (cond ((equal part "*") :wild)
                 ((and host (stringp part)) (string-upcase part))
                 (t part))))
    (%pathname-of-parts (mapcar #'part directory)
                        (part name)
                        (if (eq type :unspecific) nil (part type))
                        version
                        host)))

(defun merge-pathnames (file &optional (defaults *default-pathname-defaults*) (version :newest))
  "A pathname with the parts that it lacks from another one; a relative directory is one in the
  directory of that.
  Examples:
  (merge-pathnames \"b.lisp\" \"/home/me/a.lisp\") => #P\"/home/me/b.lisp\"
  (merge-pathnames \"plans/b\" \"/home/me/a.lisp\") => #P\"/home/me/plans/b.lisp\""
  (let* ((defaults (pathname defaults))
         (file (if (and (stringp file) (pathname-host defaults) (not (%host-of-name file)))
                   (parse-namestring file (pathname-host defaults))
                   (pathname file))))
    (%pathname-of-parts
     (let ((directory (pathname-directory file))
           (other (pathname-directory defaults)))
       (cond ((null directory) other)
             ((and other (eq (first directory) :relative))
              (%without-returns (append other (rest directory))))
             (t directory)))
     (or (pathname-name file) (pathname-name defaults))
     (or (pathname-type file) (pathname-type defaults))
     ;; A version belongs to a name, so that of another name does not count.
     (or (pathname-version file)
         (and (null (pathname-name file)) (pathname-version defaults))
         version)
     (or (pathname-host file) (pathname-host defaults)))))

(defun %without-returns (directory)
  "A directory without names that :BACK takes away again."
  (let ((kept '()))
    (dolist (part directory (reverse kept))
      (if (and (eq part :back) (typep (first kept) '(or string (eql :wild))))
          (pop kept)
          (push part kept)))))

(defun enough-namestring (file &optional (defaults *default-pathname-defaults*))
  "The name of a file as seen from the directory of another.
  Examples:
  (enough-namestring \"/home/me/a.lisp\" \"/home/me/\") => \"a.lisp\""
  (let ((name (namestring file))
        (directory (directory-namestring defaults)))
    (if (alexandria:starts-with-subseq directory name)
        (subseq name (length directory))
        name)))

(defun wild-pathname-p (file &optional part)
  "Does a file's name, or a part of it, stand for several?
  Examples:
  (wild-pathname-p \"*.lisp\") => T
  (wild-pathname-p \"*.lisp\" :type) => NIL"
  (flet ((wild-p (part)
           (typecase part
             ((member :wild :wild-inferiors) t)
             (string (find #\* part)))))
    (let ((found (ecase part
                   ((:name) (wild-p (pathname-name file)))
                   ((:type) (wild-p (pathname-type file)))
                   ((:directory) (some #'wild-p (pathname-directory file)))
                   ((:version) (wild-p (pathname-version file)))
                   ((:host :device) (pathname file) nil)
                   ((nil) (or (some #'wild-p (pathname-directory file))
                              (wild-p (pathname-name file))
                              (wild-p (pathname-type file))
                              (wild-p (pathname-version file)))))))
      (and found t))))

(defun pathname-match-p (file wildcard)
  "Does a file's name match one that stands for several?
  Examples:
  (pathname-match-p \"plans/a.lisp\" \"plans/*.lisp\") => T
  (pathname-match-p \"plans/a.lisp\" \"*.plan\") => NIL"
  (let ((file (pathname file))
        (wildcard (pathname wildcard)))
    (flet ((matches (part wanted)
             (or (null wanted) (%part-match-p part wanted))))
      (and (equal (pathname-host file) (pathname-host wildcard))
           (or (null (pathname-directory wildcard))
               (%directory-match-p (pathname-directory file) (pathname-directory wildcard)))
           (matches (pathname-name file) (pathname-name wildcard))
           (matches (pathname-type file) (pathname-type wildcard))
           t))))

(defun %part-match-p (part wanted)
  "Does a name, a type or a directory's name match another one, in which a star stands for anything?"
  (cond ((eq wanted :wild) t)
        ((and (stringp wanted) (stringp part) (find #\* wanted))
         (%star-match-p wanted part))
        (t (equal part wanted))))

(defun %star-match-p (pattern text)
  "Does a text match a pattern whose stars stand for any characters?"
  (let ((star (position #\* pattern)))
    (if (null star)
        (string= pattern text)
        (and (<= star (length text))
             (string= pattern text :end1 star :end2 star)
             (loop with rest = (subseq pattern (1+ star))
                   for start from star to (length text)
                     thereis (%star-match-p rest (subseq text start)))))))

(defun %directory-match-p (directory wanted)
  "Does a directory match another one? :WILD stands for one name, :WILD-INFERIORS for any number."
  (cond ((null wanted) (null directory))
        ((eq (first wanted) :wild-inferiors)
         (loop for rest on (append directory '(nil))
                 thereis (%directory-match-p (remove nil rest) (rest wanted))))
        (t (and directory
                (%part-match-p (first directory) (first wanted))
                (%directory-match-p (rest directory) (rest wanted))))))

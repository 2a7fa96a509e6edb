;;;; UIOP: the everyday functions of the library of utilities that comes with ASDF.

(in-package :uiop)

;;; Strings and lists

(defun strcat (&rest strings)
  "The strings, one after the other; NIL counts as empty, a character as a string.
  Examples:
  (uiop:strcat \"a\" nil #\\b \"c\") => \"abc\""
  (apply #'concatenate 'string (mapcar (lambda (part) (if part (string part) "")) strings)))

(defun emptyp (sequence)
  "Is the sequence NIL or empty?
  Examples:
  (list (uiop:emptyp \"\") (uiop:emptyp nil) (uiop:emptyp \"a\")) => (T T NIL)"
  (or (null sequence) (and (vectorp sequence) (zerop (length sequence)))))

(defun first-char (string)
  "The first character of a string that is not empty, else NIL.
  Examples:
  (uiop:first-char \"ab\") => #\\a"
  (and (stringp string) (plusp (length string)) (char string 0)))

(defun last-char (string)
  "The last character of a string that is not empty, else NIL.
  Examples:
  (uiop:last-char \"ab\") => #\\b"
  (and (stringp string) (plusp (length string)) (char string (1- (length string)))))

(defun string-prefix-p (prefix string)
  "Does the string begin with the prefix?
  Examples:
  (uiop:string-prefix-p \"ab\" \"abc\") => T"
  (let ((prefix (string prefix))
        (string (string string)))
    (and (<= (length prefix) (length string))
         (string= prefix string :end2 (length prefix)))))

(defun string-suffix-p (string suffix)
  "Does the string end with the suffix?
  Examples:
  (uiop:string-suffix-p \"abc\" \"bc\") => T"
  (let ((string (string string))
        (suffix (string suffix)))
    (and (<= (length suffix) (length string))
         (string= suffix string :start2 (- (length string) (length suffix))))))

(defun string-enclosed-p (prefix string suffix)
  "Does the string begin with the prefix and end with the suffix?
  Examples:
  (uiop:string-enclosed-p \"(\" \"(a)\" \")\") => T"
  (and (string-prefix-p prefix string) (string-suffix-p string suffix)))

(defun split-string (string &key max (separator '(#\Space #\Tab)))
  "The parts of a string between separators, a list of characters or a string of them. With a MAX, at
  most so many: the first one holds what is left.
  Examples:
  (uiop:split-string \"a b  c\") => (\"a\" \"b\" \"\" \"c\")
  (uiop:split-string \"a.b.c\" :separator \".\" :max 2) => (\"a.b\" \"c\")"
  (loop with parts = '()
        with end = (length string)
        for start = (and (or (null max) (< (1+ (length parts)) max))
                         (position-if (lambda (character) (find character separator)) string
                                      :end end :from-end t))
        do (push (subseq string (if start (1+ start) 0) end) parts)
           (unless start (return parts))
           (setf end start)))

(defun stripln (string)
  "The string without the line breaks at its end.
  Examples:
  (uiop:stripln (format nil \"a~%\")) => \"a\""
  (string-right-trim '(#\Newline #\Return) string))

(defun ensure-list (object)
  "The object if it is a list, else a list of it.
  Examples:
  (uiop:ensure-list 1) => (1)"
  (if (listp object) object (list object)))

(defun ensure-function (designator)
  "The function that a function, a name, a lambda expression or a constant stands for.
  Examples:
  (funcall (uiop:ensure-function 'car) '(1)) => 1"
  (etypecase designator
    (function designator)
    ((or boolean keyword character number) (constantly designator))
    (symbol (fdefinition designator))
    (cons (if (eq (first designator) 'lambda)
              (eval `(function ,designator))
              (lambda (&rest arguments)
                (apply (first designator) (append (rest designator) arguments)))))
    (string (eval `(function ,(read-from-string designator))))))

(defun remove-plist-key (key plist)
  "The property list without a key.
  Examples:
  (uiop:remove-plist-key :a '(:a 1 :b 2)) => (:B 2)"
  (loop for (name value) on plist by #'cddr
        unless (eq name key) append (list name value)))

(defun remove-plist-keys (keys plist)
  "The property list without some keys.
  Examples:
  (uiop:remove-plist-keys '(:a :c) '(:a 1 :b 2)) => (:B 2)"
  (loop for (name value) on plist by #'cddr
        unless (member name keys) append (list name value)))

(defmacro while-collecting ((&rest collectors) &body body)
  "The body, in which each of the names is a function that collects its argument; the values are the
  lists of what was collected.
  Examples:
  (uiop:while-collecting (a b) (a 1) (b 2) (a 3)) => (1 3) ; (2)"
  (let ((lists (mapcar (lambda (name) (gensym (symbol-name name))) collectors)))
    `(let ,(mapcar (lambda (list) `(,list '())) lists)
       (flet ,(mapcar (lambda (name list) `(,name (item) (push item ,list) item))
                      collectors lists)
         ,@body)
       (values ,@(mapcar (lambda (list) `(reverse ,list)) lists)))))

(defmacro if-let (bindings &body (then &optional else))
  "The first form with the bindings if all their values are true, else the other one.
  Examples:
  (uiop:if-let (x 1) (list x) 'none) => (1)"
  (let ((bindings (if (and (consp bindings) (symbolp (first bindings))) (list bindings) bindings)))
    `(let ,bindings
       (if (and ,@(mapcar #'first bindings)) ,then ,else))))

(defmacro nest (&rest forms)
  "Each form with the next one as its last element.
  Examples:
  (uiop:nest (let ((a 1))) (let ((b 2))) (list a b)) => (1 2)"
  (reduce (lambda (outer inner) (append outer (list inner))) forms :from-end t))

(defmacro appendf (place &rest lists)
  "Appends lists to a place.
  Examples:
  (let ((l (list 1))) (uiop:appendf l '(2)) l) => (1 2)"
  `(setf ,place (append ,place ,@lists)))

;;; Packages and features

(defun find-package* (name &optional (errorp t))
  "The package of a name; without one an error, or NIL.
  Examples:
  (uiop:find-package* :no-such-package nil) => NIL"
  (or (find-package name)
      (and errorp (error "There is no package named ~a." (string name)))))

(defun find-symbol* (name package &optional (errorp t))
  "The symbol of a name in a package, and how it is accessible; without one an error, or NIL.
  Examples:
  (uiop:find-symbol* :car :cl) => CAR ; :EXTERNAL"
  (let ((found (find-package* package errorp)))
    (if found
        (multiple-value-bind (symbol status) (find-symbol (string name) found)
          (cond (status (values symbol status))
                (errorp (error "There is no symbol ~a in the package ~a." (string name)
                               (package-name found)))
                (t (values nil nil))))
        (values nil nil))))

(defun symbol-call (package name &rest arguments)
  "Calls the function of a name in a package.
  Examples:
  (uiop:symbol-call :cl :list 1 2) => (1 2)"
  (apply (find-symbol* name package) arguments))

(defun intern* (name package)
  "The symbol of a name in a package, made if need be.
  Examples:
  (uiop:intern* :car :cl) => CAR ; :EXTERNAL"
  (intern (string name) (find-package* package)))

(defun featurep (expression &optional (*features* *features*))
  "Is the feature expression true?
  Examples:
  (list (uiop:featurep :planwright) (uiop:featurep '(:and :planwright (:not :sbcl)))) => (T T)"
  (and (alexandria:featurep expression) t))

(defun implementation-type ()
  "The name of the implementation as a keyword.
  Examples:
  (uiop:implementation-type) => :PLANWRIGHT"
  :planwright)

(defun os-unix-p ()
  "Is this Unix? Names of files are those of Unix everywhere.
  Examples:
  (uiop:os-unix-p) => T"
  t)

(defun os-windows-p ()
  "Is this Windows? Names of files are those of Unix everywhere.
  Examples:
  (uiop:os-windows-p) => NIL"
  nil)

(defun os-macosx-p ()
  "Is this macOS, as far as names of files go?
  Examples:
  (uiop:os-macosx-p) => NIL"
  nil)

;;; Versions

(defun parse-version (version &optional on-error)
  "The numbers of a version such as 1.2.3; NIL if it is none, after a call of ON-ERROR with a message.
  Examples:
  (uiop:parse-version \"1.20\") => (1 20)"
  (let ((parts (and (stringp version) (split-string version :separator "."))))
    (if (and parts
             (every (lambda (part) (and (plusp (length part)) (every #'digit-char-p part))) parts))
        (mapcar #'parse-integer parts)
        (when on-error
          (funcall on-error "~s is no version: numbers with points between them were expected."
                   version)
          nil))))

(defun version< (one other)
  "Is a version older than another one?
  Examples:
  (list (uiop:version< \"1.9\" \"1.10\") (uiop:version< \"2\" \"1.10\")) => (T NIL)"
  (loop for ones = (parse-version one) then (rest ones)
        for others = (parse-version other) then (rest others)
        while others
        do (cond ((null ones) (return t))
                 ((< (first ones) (first others)) (return t))
                 ((> (first ones) (first others)) (return nil)))))

(defun version<= (one other)
  "Is a version as old as another one, or older?
  Examples:
  (uiop:version<= \"1.2\" \"1.2\") => T"
  (not (version< other one)))

(defun version= (one other)
  "Are two versions the same?
  Examples:
  (uiop:version= \"1.2\" \"1.2\") => T"
  (equal (parse-version one) (parse-version other)))

;;; The environment

(defun getenv (name)
  "The value of an environment variable, or NIL.
  Examples:
  (uiop:getenv \"NO_SUCH_VARIABLE_HERE\") => NIL"
  (system:environment-variable name))

(defun getenvp (name)
  "The value of an environment variable, unless that is empty.
  Examples:
  (uiop:getenvp \"NO_SUCH_VARIABLE_HERE\") => NIL"
  (let ((value (getenv name)))
    (and (plusp (length value)) value)))

(defvar *command-line-arguments* '()
  "Arguments of the program that are for Lisp code: none.")

(defun command-line-arguments (&optional (arguments '()))
  "Arguments of the program that are for Lisp code: none.
  Examples:
  (uiop:command-line-arguments) => NIL"
  arguments)

(defun run-program (command &rest options)
  "Signals an error: sessions run no other programs."
  (declare (ignore options))
  (error "~s cannot be run: planwright runs no other programs." command))

(defun getcwd ()
  "The pathname of the current folder."
  (ensure-directory-pathname (truename ".")))

;;; Pathnames

(defun ensure-pathname (designator &rest options)
  "The pathname of a name.
  Examples:
  (uiop:ensure-pathname \"a.txt\") => #P\"a.txt\""
  (declare (ignore options))
  (and designator (pathname designator)))

(defun directory-pathname-p (pathname)
  "Is it the pathname of a folder, which ends in a slash?
  Examples:
  (list (uiop:directory-pathname-p \"a/\") (uiop:directory-pathname-p \"a\")) => (T NIL)"
  (and pathname
       (null (pathname-name pathname))
       (null (pathname-type pathname))
       t))

(defun file-pathname-p (pathname)
  "Is it the pathname of a file? Then it is returned.
  Examples:
  (uiop:file-pathname-p \"a/\") => NIL"
  (and pathname (pathname-name pathname) (pathname pathname)))

(defun ensure-directory-pathname (designator &optional on-error)
  "The pathname of a folder, with a slash at its end.
  Examples:
  (uiop:ensure-directory-pathname \"a/b\") => #P\"a/b/\""
  (declare (ignore on-error))
  (let ((name (namestring designator)))
    (pathname (if (or (string= name "") (string-suffix-p name "/"))
                  name
                  (strcat name "/")))))

(defun pathname-directory-pathname (pathname)
  "The folder of a file.
  Examples:
  (uiop:pathname-directory-pathname \"a/b.txt\") => #P\"a/\""
  (and pathname (pathname (directory-namestring pathname))))

(defun pathname-parent-directory-pathname (pathname)
  "The folder around that of a file.
  Examples:
  (uiop:pathname-parent-directory-pathname \"a/b/c.txt\") => #P\"a/\""
  (let ((folder (pathname-directory pathname)))
    (make-pathname :directory (butlast folder) :name nil :type nil :defaults pathname)))

(defun merge-pathnames* (specified &optional (defaults *default-pathname-defaults*))
  "The pathname that a name means in the folder of another one.
  Examples:
  (uiop:merge-pathnames* \"b.txt\" \"a/\") => #P\"a/b.txt\""
  (if specified
      (merge-pathnames specified (or defaults ""))
      (and defaults (pathname defaults))))

(defun subpathname (pathname name &key type)
  "The pathname of a name in the folder of another one; NIL without that.
  Examples:
  (uiop:subpathname \"a/b.txt\" \"c\" :type \"d\") => #P\"a/c.d\""
  (and pathname
       (merge-pathnames (if (and type (null (pathname-type name))) (strcat name "." type) name)
                        (pathname-directory-pathname pathname))))

(defun subpathname* (pathname name &key type)
  "The same as SUBPATHNAME, in the folder that the pathname names.
  Examples:
  (uiop:subpathname* \"a\" \"c.d\") => #P\"a/c.d\""
  (and pathname (subpathname (ensure-directory-pathname pathname) name :type type)))

(defun absolute-pathname-p (pathname)
  "Does the pathname begin at the root?
  Examples:
  (list (uiop:absolute-pathname-p \"/a\") (uiop:absolute-pathname-p \"a\")) => (T NIL)"
  (eq (first (pathname-directory pathname)) :absolute))

(defun relative-pathname-p (pathname)
  "Does the pathname begin in the current folder?
  Examples:
  (uiop:relative-pathname-p \"a\") => T"
  (not (absolute-pathname-p pathname)))

(defun native-namestring (pathname)
  "The name of a file as the system writes it.
  Examples:
  (uiop:native-namestring #P\"a/b.txt\") => \"a/b.txt\""
  (and pathname (namestring pathname)))

(defun unix-namestring (pathname)
  "The name of a file as Unix writes it.
  Examples:
  (uiop:unix-namestring #P\"a/b.txt\") => \"a/b.txt\""
  (and pathname (namestring pathname)))

(defun parse-native-namestring (name &rest options)
  "The pathname of a name as the system writes it.
  Examples:
  (uiop:parse-native-namestring \"a/b.txt\") => #P\"a/b.txt\""
  (declare (ignore options))
  (and name (pathname name)))

(defun parse-unix-namestring (name &key type &allow-other-keys)
  "The pathname of a name as Unix writes it; :TYPE :DIRECTORY makes it one of a folder.
  Examples:
  (uiop:parse-unix-namestring \"a\" :type :directory) => #P\"a/\""
  (cond ((null name) nil)
        ((eq type :directory) (ensure-directory-pathname name))
        ((stringp type) (pathname (strcat name "." type)))
        (t (pathname name))))

;;; Files

(defun file-exists-p (name)
  "The pathname of a file if it is there, else NIL.
  Examples:
  (uiop:file-exists-p \"no-such-file\") => NIL"
  (and name (not (directory-exists-p name)) (probe-file name)))

(defun directory-exists-p (name)
  "The pathname of a folder if it is there, else NIL.
  Examples:
  (uiop:directory-exists-p \"no-such-folder/\") => NIL"
  (and name
       (let ((folder (ensure-directory-pathname name)))
         (and (probe-file folder) folder))))

(defun probe-file* (name &key truename)
  "The pathname of a file or folder if it is there, else NIL.
  Examples:
  (uiop:probe-file* \"no-such-file\") => NIL"
  (let ((found (and name (probe-file name))))
    (and found (if truename found (pathname name)))))

(defun directory-files (folder &optional (pattern "*.*"))
  "The pathnames of the files in a folder whose names fit a pattern.
  Examples:
  (uiop:directory-files \"no-such-folder/\") => NIL"
  (remove-if #'directory-pathname-p
             (directory (merge-pathnames pattern (ensure-directory-pathname folder)))))

(defun subdirectories (folder)
  "The pathnames of the folders in a folder.
  Examples:
  (uiop:subdirectories \"no-such-folder/\") => NIL"
  (let ((base (namestring (ensure-directory-pathname folder))))
    (loop for name in (system:file-names base)
          when (string-suffix-p name "/")
            collect (pathname (strcat base name)))))

(defun delete-file-if-exists (name)
  "Deletes a file if it is there.
  Examples:
  (uiop:delete-file-if-exists \"no-such-file\") => NIL"
  (and name (probe-file name) (delete-file name)))

(defun read-file-string (file &rest options)
  "The text of a file.
  Examples:
  (handler-case (uiop:read-file-string \"no-such-file\") (file-error () 'no-file)) => NO-FILE"
  (declare (ignore options))
  (alexandria:read-file-into-string file))

(defun read-file-lines (file &rest options)
  "The lines of a file.
  Examples:
  (handler-case (uiop:read-file-lines \"no-such-file\") (file-error () 'no-file)) => NO-FILE"
  (declare (ignore options))
  (with-open-file (stream file)
    (slurp-stream-lines stream)))

(defun read-file-line (file &key (at 0) &allow-other-keys)
  "A line of a file, counted from 0.
  Examples:
  (handler-case (uiop:read-file-line \"no-such-file\") (file-error () 'no-file)) => NO-FILE"
  (nth (if (consp at) (first at) at) (read-file-lines file)))

(defun read-file-forms (file &key count &allow-other-keys)
  "The forms of a file, read in the current package.
  Examples:
  (handler-case (uiop:read-file-forms \"no-such-file\") (file-error () 'no-file)) => NO-FILE"
  (with-open-file (stream file)
    (loop for number from 0
          while (or (null count) (< number count))
          for form = (read stream nil stream)
          until (eq form stream)
          collect form)))

(defun read-file-form (file &key (at 0) &allow-other-keys)
  "A form of a file, counted from 0, or a part of one by a path of numbers.
  Examples:
  (handler-case (uiop:read-file-form \"no-such-file\") (file-error () 'no-file)) => NO-FILE"
  (reduce (lambda (form index) (nth index form))
          (ensure-list at)
          :initial-value (read-file-forms file)))

(defun safe-read-from-string (string &key (eof-error-p t) eof-value &allow-other-keys)
  "Reads a form from a string, without evaluating anything.
  Examples:
  (uiop:safe-read-from-string \"(1 2)\") => (1 2)"
  (let ((*read-eval* nil))
    (values (read-from-string string eof-error-p eof-value))))

(defun slurp-stream-string (stream &key stripped)
  "The rest of a stream as a string.
  Examples:
  (with-input-from-string (s \"ab\") (uiop:slurp-stream-string s)) => \"ab\""
  (let ((text (with-output-to-string (out)
                (loop for character = (read-char stream nil nil)
                      while character do (write-char character out)))))
    (if stripped (stripln text) text)))

(defun slurp-stream-lines (stream &key count)
  "The lines of the rest of a stream.
  Examples:
  (with-input-from-string (s (format nil \"a~%b\")) (uiop:slurp-stream-lines s)) => (\"a\" \"b\")"
  (loop for number from 0
        while (or (null count) (< number count))
        for line = (read-line stream nil nil)
        while line collect line))

(defmacro with-input-file ((stream file &rest options) &body body)
  "The body with a stream of what is in a file."
  (declare (ignore options))
  `(with-open-file (,stream ,file) ,@body))

(defmacro with-output-file ((stream file &key (if-exists :error) &allow-other-keys) &body body)
  "The body with a stream that writes a file."
  `(with-open-file (,stream ,file :direction :output :if-exists ,if-exists) ,@body))

(defmacro with-output ((stream &optional (designator stream)) &body body)
  "The body with an output stream: a stream, T, a string with a fill pointer, or NIL for a string that
  is returned.
  Examples:
  (let ((s nil)) (uiop:with-output (s) (write-string \"a\" s))) => \"a\""
  `(%call-with-output ,designator (lambda (,stream) ,@body)))

(defun %call-with-output (designator function)
  "What WITH-OUTPUT expands into."
  (etypecase designator
    (null (with-output-to-string (stream) (funcall function stream)))
    ((eql t) (funcall function *standard-output*))
    (stream (funcall function designator))
    (string (with-output-to-string (stream designator) (funcall function stream)))))

(defun println (object &optional (stream *standard-output*))
  "Writes an object as by PRINC, and a line break.
  Examples:
  (length (with-output-to-string (s) (uiop:println 1 s))) => 2"
  (princ object stream)
  (terpri stream)
  (values))

(defun format! (stream control &rest arguments)
  "FORMAT with the output shown at once.
  Examples:
  (uiop:format! nil \"~a\" 1) => \"1\""
  (prog1 (apply #'format stream control arguments)
    (finish-output)))

(defmacro define-package (name &rest options)
  "DEFPACKAGE with the options :MIX and :USE-REEXPORT, :REEXPORT and :MIX-REEXPORT.
  Examples:
  (uiop:define-package :defined-as-example (:use :cl) (:export #:thing)) => #<PACKAGE \"DEFINED-AS-EXAMPLE\">"
  (let* ((used (loop for (key . packages) in options
                     when (member key '(:mix :use-reexport :mix-reexport)) append packages))
         (reexported (loop for (key . packages) in options
                           when (member key '(:reexport :use-reexport :mix-reexport))
                             append packages)))
    `(eval-when (:compile-toplevel :load-toplevel :execute)
       (defpackage ,name
         ,@(remove-if (lambda (option)
                        (member (first option)
                                '(:mix :use-reexport :mix-reexport :reexport :recycle :unintern)))
                      options)
         ,@(and used `((:use ,@used))))
       ,@(loop for package in reexported
               collect `(do-external-symbols (symbol ',package)
                          (import (list symbol) ',name)
                          (export (list symbol) ',name)))
       (find-package ',name))))

(defmacro with-upgradability ((&rest options) &body body)
  "The body.
  Examples:
  (uiop:with-upgradability () 1) => 1"
  (declare (ignore options))
  `(progn ,@body))

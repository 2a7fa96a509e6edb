;;; Logical pathnames: section 19.3 of the standard, and translations of pathnames.

(in-package :common-lisp)

(defvar %logical-hosts '()
  "The logical hosts, each with its translations: pairs of a pattern and what it stands for.")

(defun %host-entry (host)
  "The entry of a logical host, or NIL."
  (assoc (string host) %logical-hosts :test #'string-equal))

(defun %logical-host (host)
  "The name of a logical host, as its pathnames have it; an error if there is none."
  (or (car (%host-entry host))
      (error "There is no logical host ~a." host)))

(defun %host-of-name (name)
  "The logical host with which the name of a file begins, or NIL."
  (let ((colon (position #\: name)))
    (and colon (car (%host-entry (subseq name 0 colon))))))

(defun %without-host (name host)
  "The name of a file without its host and the colon after it."
  (let ((length (length host)))
    (if (and host
             (< length (length name))
             (char= (char name length) #\:)
             (string-equal name host :end1 length))
        (subseq name (1+ length))
        name)))

(defun %parse-logical (text host)
  "The logical pathname of a name without host."
  (let* ((parts (%split #\; text))
         (directory (remove "" (butlast parts) :test #'string=))
         (file (%split #\. (car (last parts)))))
    (if (or (> (length file) 3)
            (notevery #'%logical-word-p (append directory file)))
        (error 'simple-parse-error
               :format-control "~s is no logical pathname; its parts are made of letters, digits, - and *."
               :format-arguments (list text)))
    (flet ((part (word)
             (cond ((or (null word) (string= word "")) nil)
                   ((string= word "*") :wild)
                   (t (string-upcase word)))))
      (%pathname-of-parts
       (and (rest parts)
            (cons (if (char= (char text 0) #\;) :relative :absolute)
                  (mapcar (lambda (word) (if (string= word "**") :wild-inferiors (part word)))
                          directory)))
       (part (first file))
       (part (second file))
       (let ((version (part (third file))))
         (cond ((not (stringp version)) version)
               ((every #'digit-char-p version) (parse-integer version))
               ((string= version "NEWEST") :newest)
               (t (error "~a is no version of a logical pathname; these are numbers, NEWEST and *."
                         version))))
       host))))

(defun %split (separator text)
  "The parts of a text between characters."
  (loop for start = 0 then (1+ end)
        for end = (position separator text :start start)
        collect (subseq text start end)
        while end))

(defun %logical-word-p (word)
  "May the text be a part of a logical pathname?"
  (every (lambda (c) (or (alphanumericp c) (find c "-*_"))) word))

(defun logical-pathname (file)
  "The logical pathname of a name that begins with a logical host, or of a stream.
  Examples:
  (progn (setf (logical-pathname-translations \"robot\") '((\"**;*.*\" \"/plans/**/*.*\"))) (logical-pathname \"robot:demo;a.lisp\")) => #P\"ROBOT:DEMO;A.LISP\""
  (let ((pathname (pathname file)))
    (if (typep pathname 'logical-pathname)
        pathname
        (error 'simple-type-error
               :datum file :expected-type 'logical-pathname
               :format-control "~s has no logical host; these are~:[ none~;~:*~{ ~a~}~]."
               :format-arguments (list file (mapcar #'car %logical-hosts))))))

(defun logical-pathname-translations (host)
  "The translations of a logical host: lists of a pattern and what it stands for.
  Examples:
  (progn (setf (logical-pathname-translations \"arm\") '((\"*.*\" \"/arm/*.*\"))) (length (logical-pathname-translations \"arm\"))) => 1"
  (cdr (or (%host-entry host) (%logical-host host))))

(defun (setf logical-pathname-translations) (translations host)
  "Sets the translations of a logical host, which exists from then on."
  (let ((name (string-upcase (string host)))
        (entry (%host-entry host)))
    (unless (and (string/= name "") (%logical-word-p name))
      (error "~s is no name of a logical host; it is made of letters, digits and -." host))
    (unless entry
      (setq entry (list name)
            %logical-hosts (append %logical-hosts (list entry))))
    (setf (cdr entry)
          (mapcar (lambda (translation)
                    (list (let ((from (first translation)))
                            (if (stringp from)
                                (%parse-logical (%without-host from name) name)
                                from))
                          (pathname (second translation))))
                  translations))
    translations))

(defun load-logical-pathname-translations (host)
  "Is NIL if the logical host has been defined; an error if not, since there is no place where definitions are kept.
  Examples:
  (progn (setf (logical-pathname-translations \"base\") '()) (load-logical-pathname-translations \"base\")) => NIL"
  (%logical-host host)
  nil)

(defun translate-logical-pathname (file &key &allow-other-keys)
  "The name of a file of the machine that a logical pathname stands for; other pathnames stand for themselves.
  Examples:
  (progn (setf (logical-pathname-translations \"robot\") '((\"**;*.*\" \"/plans/**/*.*\"))) (translate-logical-pathname \"robot:demo;a.lisp\")) => #P\"/plans/demo/a.lisp\""
  (let ((pathname (pathname file)))
    ;; Without directories, it is at the top of its host.
    (if (and (typep pathname 'logical-pathname) (null (pathname-directory pathname)))
        (setq pathname (make-pathname :directory '(:absolute) :defaults pathname)))
    (loop repeat 100
          while (typep pathname 'logical-pathname)
          do (let ((translation
                     (find-if (lambda (translation) (pathname-match-p pathname (first translation)))
                              (logical-pathname-translations (pathname-host pathname)))))
               (unless translation
                 (error 'simple-file-error
                        :pathname pathname
                        :format-control "There is no translation for ~s."
                        :format-arguments (list pathname)))
               (setq pathname
                     (translate-pathname pathname (first translation) (second translation))))
          finally (if (typep pathname 'logical-pathname)
                      (error "The translations of ~s do not end." file)
                      (return pathname)))))

(defun translate-pathname (source from to &key &allow-other-keys)
  "The pathname that is to one pattern what a pathname is to another: what its wild parts stand for is put into the other's.
  Examples:
  (translate-pathname \"/plans/demo/a.lisp\" \"/plans/**/*.lisp\" \"/old/**/*.bak\") => #P\"/old/demo/a.bak\""
  (let* ((source (pathname source))
         (from (pathname from))
         (to (pathname to))
         (lowers (and (typep source 'logical-pathname) (not (typep to 'logical-pathname)))))
    (unless (pathname-match-p source from)
      (error "~s does not match ~s." source from))
    (labels ((in-case (part)
               (cond ((consp part) (mapcar #'in-case part))
                     ((and lowers (stringp part)) (string-downcase part))
                     (t part)))
             (part (reader)
               (let ((given (in-case (funcall reader source)))
                     (pattern (in-case (funcall reader from)))
                     (wanted (funcall reader to)))
                 (cond ((null wanted) given)
                       ((not (%wild-part-p wanted)) wanted)
                       ((eq wanted :wild) given)
                       (t (%filled-part wanted (%matches given pattern)))))))
      (%pathname-of-parts
       (let ((directory (pathname-directory to)))
         (cond ((null directory) (in-case (pathname-directory source)))
               ((notany #'%wild-part-p directory) directory)
               (t (%filled-directory directory
                                     (%directory-matches (in-case (pathname-directory source))
                                                         (in-case (pathname-directory from)))))))
       (part #'pathname-name)
       (part #'pathname-type)
       (let ((version (pathname-version to)))
         (if (member version '(nil :wild)) (pathname-version source) version))
       (pathname-host to)))))

(defun %wild-part-p (part)
  "Does a name, a type or a directory's name stand for several?"
  (or (member part '(:wild :wild-inferiors))
      (and (stringp part) (find #\* part))))

(defun %matches (part pattern)
  "What the stars of a pattern stand for in a part, in order; the part itself if the pattern has none."
  (cond ((not (stringp part)) (list ""))
        ((not (and (stringp pattern) (find #\* pattern))) (list part))
        (t (labels ((rec (pattern part)
                      ;; A list in a list, since there may be a match without stars.
                      (let ((star (position #\* pattern)))
                        (cond ((null star) (if (string= pattern part) (list '())))
                              ((and (<= star (length part))
                                    (string= pattern part :end1 star :end2 star))
                               (loop for end from star to (length part)
                                     for found = (rec (subseq pattern (1+ star)) (subseq part end))
                                     when found
                                       return (list (cons (subseq part star end) (car found)))))))))
             (car (rec pattern part))))))

(defun %filled-part (pattern matches)
  "A part whose stars are replaced by texts, one after the other."
  (with-output-to-string (out)
    (loop for c across pattern
          do (if (char= c #\*)
                 (write-string (or (pop matches) "") out)
                 (write-char c out)))))

(defun %directory-matches (directory pattern)
  "What the wild parts of a directory stand for: for each a list of names."
  (labels ((rec (names patterns)
             (cond ((null patterns) (if (null names) (list '())))
                   ((eq (first patterns) :wild-inferiors)
                    (loop for rest on (append names '(nil))
                          for count from 0
                          for found = (rec (nthcdr count names) (rest patterns))
                          when found return (list (cons (subseq names 0 count) (car found)))))
                   ((null names) nil)
                   ((%part-match-p (first names) (first patterns))
                    (let ((found (rec (rest names) (rest patterns))))
                      (cond ((null found) nil)
                            ((%wild-part-p (first patterns))
                             (list (cons (if (eq (first patterns) :wild)
                                             (list (first names))
                                             (%matches (first names) (first patterns)))
                                         (car found))))
                            (t found)))))))
    (car (rec (rest directory) (rest pattern)))))

(defun %filled-directory (pattern matches)
  "A directory whose wild parts are replaced by lists of names."
  (mapcan (lambda (part)
            (cond ((eq part :wild-inferiors) (copy-list (pop matches)))
                  ((eq part :wild) (copy-list (pop matches)))
                  ((%wild-part-p part) (list (%filled-part part (pop matches))))
                  (t (list part))))
          pattern))

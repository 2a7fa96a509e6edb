;;;; Readtables: what characters mean to the reader (chapter 23 of the standard).

(in-package :common-lisp)

(defun get-macro-character (character &optional (readtable *readtable*))
  "The function that reads what begins with a macro character, or NIL, and whether the character may
  appear inside a symbol.
  Examples:
  (get-macro-character #\\!) => NIL ; NIL
  (let ((*readtable* (copy-readtable nil))) (set-macro-character #\\! (get-macro-character #\\')) (read-from-string \"!a\")) => 'A ; 2"
  (check-type character character)
  (multiple-value-bind (function non-terminating-p) (%macro-character character readtable)
    (let ((standard (and (null function)
                         (not (%constituent-p character readtable))
                         (%standard-reader character))))
      (values (or function standard)
              (if standard (char= character #\#) non-terminating-p)))))

(defun set-macro-character (character function &optional non-terminating-p
                                                        (readtable *readtable*))
  "Lets a function of stream and character read what begins with the character.
  Examples:
  (let ((*readtable* (copy-readtable nil))) (set-macro-character #\\! (lambda (s c) (list c (read s)))) (read-from-string \"!x\")) => (#\\! X) ; 2"
  (check-type character character)
  ;; The character's own function makes it what it is in the standard syntax.
  (if (and function
           (eq function (%standard-reader character))
           (eq (and non-terminating-p t) (char= character #\#)))
      (%reset-macro-character character readtable)
      (%set-macro-character character function non-terminating-p readtable))
  t)

(defun %standard-reader (character)
  "The function that does what the reader does itself with a character, or NIL."
  (case character
    (#\' #'%read-quoted)
    (#\" #'%read-string)
    (#\; #'%skip-line)
    (#\) #'%read-unmatched)
    ((#\( #\` #\, #\#) (%reader-after (string character)))))

(defvar system::%*readers-after* (make-hash-table :test 'equal)
  "Functions that do what the reader does itself, by the characters that they are for: a program that
compares readtables finds the same ones.")

(defun %reader-after (characters)
  "The function that does what the reader does itself with one or two characters."
  (or (gethash characters %*readers-after*)
      (setf (gethash characters %*readers-after*)
            (if (= (length characters) 1)
                (lambda (stream read-character)
                  (declare (ignore read-character))
                  (%read-after characters stream))
                (lambda (stream read-character argument)
                  (declare (ignore read-character))
                  (%read-after (format nil "#~@[~d~]~c" argument (char characters 1)) stream))))))

(defun %read-after (text stream)
  "Reads a form that begins with a text and goes on in a stream."
  (let ((input (make-concatenated-stream (make-string-input-stream text) stream))
        ;; The readtable may have the function that calls this for the text's characters.
        (%*standard-first* t))
    (read input t nil t)))

(defun %read-quoted (stream character)
  "Reads a form and quotes it."
  (declare (ignore character))
  (list 'quote (read stream t nil t)))

(defun %read-string (stream end)
  "Reads the characters of a string, which ends with the character that it began with."
  (with-output-to-string (text)
    (loop for character = (read-char stream t nil t)
          until (char= character end)
          do (write-char (if (char= character #\\) (read-char stream t nil t) character) text))))

(defun %skip-line (stream character)
  "Skips a comment."
  (declare (ignore character))
  (read-line stream nil nil t)
  (values))

(defun %read-unmatched (stream character)
  "Signals that a parenthesis closes nothing."
  (error 'system:simple-reader-error
                       :stream stream
                       :format-control "~c closes nothing."
                       :format-arguments (list character)))

(defun get-dispatch-macro-character (character sub-character &optional (readtable *readtable*))
  "The function that reads what begins with two characters, or NIL.
  Examples:
  (get-dispatch-macro-character #\\# #\\?) => NIL
  (functionp (get-dispatch-macro-character #\\# #\\')) => T"
  (check-type character character)
  (check-type sub-character character)
  (or (%dispatch-macro-character character sub-character readtable)
      (and (%standard-dispatching-p character readtable)
           (find (char-upcase sub-character) "'(\\:.*+-ABCOPRSX=#|")
           (if (char= sub-character #\|)
               #'%skip-block
               (%reader-after (format nil "#~c" (char-upcase sub-character)))))
      (progn (%check-dispatching character readtable) nil)))

(defun %skip-block (stream character argument)
  "Skips the rest of a comment that began with two characters, and comments inside it."
  (declare (ignore character argument))
  (loop with depth = 1
        for previous = #\space then (if is-pair #\space next)
        for next = (read-char stream t nil t)
        for is-pair = (or (and (char= previous #\|) (char= next #\#))
                          (and (char= previous #\#) (char= next #\|)))
        do (when is-pair
             (incf depth (if (char= next #\|) 1 -1)))
        until (zerop depth))
  (values))

(defun set-dispatch-macro-character (character sub-character function
                                     &optional (readtable *readtable*))
  "Lets a function of stream, sub-character and number read what begins with the two characters.
  Examples:
  (let ((*readtable* (copy-readtable nil))) (set-dispatch-macro-character #\\# #\\! (lambda (s c n) (list c n (read s)))) (read-from-string \"#3!x\")) => (#\\! 3 X) ; 4"
  (check-type character character)
  (check-type sub-character character)
  (when (digit-char-p sub-character)
    (error "~s stands for a number after ~s, so it cannot have a function." sub-character character))
  (%check-dispatching character readtable)
  (%set-dispatch-macro-character character sub-character function readtable)
  t)

(defun make-dispatch-macro-character (character &optional non-terminating-p (readtable *readtable*))
  "Lets what begins with a character be read by functions that SET-DISPATCH-MACRO-CHARACTER sets; # has
  those of the standard syntax, too.
  Examples:
  (let ((*readtable* (copy-readtable nil))) (make-dispatch-macro-character #\\$) (set-dispatch-macro-character #\\$ #\\n (lambda (s c n) c n (- (read s)))) (read-from-string \"$n5\")) => -5 ; 3"
  (if (char= character #\#)
      (%reset-macro-character character readtable)
      (set-macro-character character '%read-dispatched non-terminating-p readtable)))

(defun %standard-dispatching-p (character readtable)
  "Is it # with its meaning in the standard syntax?"
  (and (char= character #\#)
       (null (%macro-character character readtable))
       (not (%constituent-p character readtable))))

(defun %check-dispatching (character readtable)
  "Signals an error unless functions of a further character read what begins with a character."
  (unless (or (%standard-dispatching-p character readtable)
              (eq (%macro-character character readtable) '%read-dispatched))
    (error "~s is no dispatching macro character; MAKE-DISPATCH-MACRO-CHARACTER makes it one."
           character)))

(defun %read-dispatched (stream character)
  "Reads a number and a further character, and calls the function of both characters."
  (let* ((argument (loop with number = nil
                         for digit = (digit-char-p (peek-char nil stream t nil t))
                         while digit
                         do (setf number (+ (* 10 (or number 0)) digit))
                            (read-char stream t nil t)
                         finally (return number)))
         (sub-character (read-char stream t nil t))
         (function (%dispatch-macro-character character sub-character *readtable*)))
    (unless function
      (error 'system:simple-reader-error
                           :stream stream
                           :format-control "No function reads what begins with ~c~c."
                           :format-arguments (list character sub-character)))
    (funcall function stream sub-character argument)))

(defun set-syntax-from-char (to from &optional (to-readtable *readtable*) from-readtable)
  "Lets a character mean to the reader what another one means.
  Examples:
  (let ((*readtable* (copy-readtable nil))) (set-syntax-from-char #\\$ #\\') (read-from-string \"$a\")) => 'A ; 2
  (let ((*readtable* (copy-readtable nil))) (set-syntax-from-char #\\\" #\\a) (string= (read-from-string \"x\\\"y\") \"X\\\"Y\")) => T
  (let ((*readtable* (copy-readtable nil))) (set-syntax-from-char #\\, #\\space) (read-from-string \"(1, 2)\")) => (1 2) ; 6"
  (check-type to character)
  (check-type from character)
  (let ((from-readtable (or from-readtable (copy-readtable nil))))
    (multiple-value-bind (function non-terminating-p) (get-macro-character from from-readtable)
      (cond ((and (find to "\\|") (char= from #\;))
             (error "~s cannot mean what ~s means: it escapes other characters, or is a letter." to from))
            ((and (char= to from) (null (%macro-character from from-readtable)))
             (%reset-macro-character to to-readtable))
            ((char= from #\#)
             (make-dispatch-macro-character to t to-readtable)
             (loop for code from (char-code #\!) to (char-code #\~)
                   for sub-character = (code-char code)
                   do (let ((reader (and (not (digit-char-p sub-character))
                                         (get-dispatch-macro-character from sub-character
                                                                       from-readtable))))
                        (when reader
                          (set-dispatch-macro-character to sub-character reader to-readtable)))))
            (function
             (set-macro-character to function non-terminating-p to-readtable))
            ((member from '(#\space #\tab #\newline #\return #\page))
             (set-macro-character to '%read-nothing nil to-readtable))
            ((find from "\\|")
             (error "~s cannot mean what ~s means: no other character escapes." to from))
            (t (%set-constituent to to-readtable)))))
  t)

(defun %read-nothing (stream character)
  "What a character is read as that separates forms."
  (declare (ignore stream character))
  (values))

;;;; Streams that are objects of a program's own classes, as David Gray proposed them: a program
;;;; defines a subclass of FUNDAMENTAL-STREAM and methods of the functions here.

(in-package :gray-streams)

(defun %no-stream-method (function stream)
  "Signals that a class of streams lacks a method that it needs."
  (error "The class ~s of streams has no method of ~s."
         (class-name (class-of stream)) function))

;;; What methods may be added to

(defun stream-read-char (stream)
  "The next character of a stream, or :EOF. A class of streams that are read as text has a method.
  Examples:
  (progn (defclass abc (gray-streams:fundamental-character-input-stream) ((rest :initform (list #\\a #\\b)))) (defmethod gray-streams:stream-read-char ((s abc)) (or (pop (slot-value s 'rest)) :eof)) (read-line (make-instance 'abc))) => \"ab\" ; T"
  (%no-stream-method 'stream-read-char stream))

(defun stream-unread-char (stream character)
  "Gives back the character that was read last. A class of streams that are read as text has a method."
  (declare (ignore character))
  (%no-stream-method 'stream-unread-char stream))

(defun stream-read-char-no-hang (stream)
  "The next character, :EOF, or NIL if it would have to be waited for."
  (stream-read-char stream))

(defun stream-peek-char (stream)
  "The next character, which stays unread, or :EOF."
  (let ((character (stream-read-char stream)))
    (unless (eq character :eof)
      (stream-unread-char stream character))
    character))

(defun stream-listen (stream)
  "Is there a next character?"
  (let ((character (stream-read-char-no-hang stream)))
    (unless (member character '(nil :eof))
      (stream-unread-char stream character)
      t)))

(defun stream-read-line (stream)
  "The rest of the line as a string, and whether the stream ended before the line did."
  (let ((line (make-string-output-stream)))
    (loop
      (let ((character (stream-read-char stream)))
        (case character
          (:eof (return (values (get-output-stream-string line) t)))
          (#\newline (return (values (get-output-stream-string line) nil)))
          (t (write-char character line)))))))

(defun stream-clear-input (stream)
  "Forgets what has been typed and not read."
  (declare (ignore stream))
  nil)

(defun stream-write-char (stream character)
  "Writes a character. A class of streams to which text is written has a method.
  Examples:
  (progn (defclass shout (gray-streams:fundamental-character-output-stream) ((to :initform (make-string-output-stream)))) (defmethod gray-streams:stream-write-char ((s shout) c) (write-char (char-upcase c) (slot-value s 'to))) (let ((s (make-instance 'shout))) (format s \"~a cups\" 3) (get-output-stream-string (slot-value s 'to)))) => \"3 CUPS\""
  (declare (ignore character))
  (%no-stream-method 'stream-write-char stream))

(defun stream-write-string (stream string &optional (start 0) end)
  "Writes the characters of a string."
  (loop for index from start below (or end (length string))
        do (stream-write-char stream (char string index)))
  string)

(defun stream-line-column (stream)
  "The number of characters on the line to which is written, or NIL if that is not known."
  (declare (ignore stream))
  nil)

(defun stream-start-line-p (stream)
  "Is the stream known to be at the start of a line?"
  (eql (stream-line-column stream) 0))

(defun stream-terpri (stream)
  "Ends the line."
  (stream-write-char stream #\newline)
  nil)

(defun stream-fresh-line (stream)
  "Ends the line unless the stream is known to be at the start of one."
  (unless (stream-start-line-p stream)
    (stream-terpri stream)
    t))

(defun stream-advance-to-column (stream column)
  "Writes blanks up to a column; NIL if the present one is not known."
  (let ((present (stream-line-column stream)))
    (when present
      (loop repeat (- column present)
            do (stream-write-char stream #\space))
      t)))

(defun stream-finish-output (stream)
  "Sees to it that all that was written has arrived."
  (declare (ignore stream))
  nil)

(defun stream-force-output (stream)
  "Sends off all that was written."
  (declare (ignore stream))
  nil)

(defun stream-clear-output (stream)
  "Forgets what was written and has not been sent off."
  (declare (ignore stream))
  nil)

(defun stream-read-byte (stream)
  "The next integer of a stream, or :EOF. A class of streams of integers has a method."
  (%no-stream-method 'stream-read-byte stream))

(defun stream-write-byte (stream integer)
  "Writes an integer. A class of streams of integers has a method."
  (declare (ignore integer))
  (%no-stream-method 'stream-write-byte stream))

(defun stream-read-sequence (stream sequence start end &key &allow-other-keys)
  "Fills a part of a sequence with the next elements of a stream; the index after the last one."
  (let ((is-text (or (stringp sequence)
                     (and (typep stream 'fundamental-character-stream)
                          (not (typep stream 'fundamental-binary-stream)))))
        (end (or end (length sequence))))
    (loop for index from start below end
          for element = (if is-text (stream-read-char stream) (stream-read-byte stream))
          do (if (eq element :eof)
                 (return index)
                 (setf (elt sequence index) element))
          finally (return (max start end)))))

(defun stream-write-sequence (stream sequence start end &key &allow-other-keys)
  "Writes the elements of a part of a sequence."
  (loop for index from start below (or end (length sequence))
        for element = (elt sequence index)
        do (if (characterp element)
               (stream-write-char stream element)
               (stream-write-byte stream element)))
  sequence)

(defun stream-file-position (stream)
  "How far a stream has come, or NIL if that is not known."
  (declare (ignore stream))
  nil)

(defun (setf stream-file-position) (position stream)
  "Moves a stream to a place; NIL if that cannot be done."
  (declare (ignore position stream))
  nil)

;;; What the functions of COMMON-LISP do with such a stream

(defun %call-stream-method (name arguments stream)
  "What a function does that was called with these arguments, one of which leads to the stream."
  (typecase stream
    (object-two-way-stream (%call-with-part name arguments stream))
    (object-broadcast-stream (%call-with-parts name arguments stream))
    (t (%call-method-of-stream name arguments stream))))

(defun %input-function-p (name)
  "Does the function of this name read?"
  (member name '(read-char read-char-no-hang peek-char unread-char read-line read-byte read-sequence
                 listen clear-input read read-preserving-whitespace read-delimited-list)))

(defun %call-with-part (name arguments stream)
  "Calls a function with that part of a two-way stream which it is for."
  (case name
    ((close open-stream-p input-stream-p output-stream-p interactive-stream-p stream-external-format)
     (%ask-stream-object name stream))
    (two-way-stream-input-stream (slot-value stream 'input))
    (two-way-stream-output-stream (slot-value stream 'output))
    (t (let ((part (slot-value stream
                               (if (or (%input-function-p name) (eq name 'stream-element-type))
                                   'input
                                   'output))))
         (apply name (%arguments-for-part name arguments part))))))

(defun %call-with-parts (name arguments stream)
  "Calls a function with each part of a broadcast stream; what it returns for the last one."
  (case name
    ((close open-stream-p input-stream-p output-stream-p interactive-stream-p stream-external-format
      stream-element-type)
     (%ask-stream-object name stream))
    (broadcast-stream-streams (copy-list (slot-value stream 'outputs)))
    (t (let ((values '()))
         (dolist (part (slot-value stream 'outputs) (values-list values))
           (setf values (multiple-value-list
                         (apply name (%arguments-for-part name arguments part)))))))))

(defun %arguments-for-part (name arguments part)
  "The arguments of a function with another stream in place of theirs."
  (case name
    (write (list* (first arguments) :stream part (rest arguments)))
    ((print prin1 princ pprint print-object write-unreadable write-char write-string write-line
      write-byte write-sequence read-sequence read-delimited-list peek-char unread-char)
     (list* (first arguments) part (cddr arguments)))
    (t (cons part (rest arguments)))))

(defun %call-method-of-stream (name arguments stream)
  "What a function does that was called with these arguments, one of which is an object of a program's
own class."
  (case name
    (make-two-way-stream
     (destructuring-bind (input output) arguments
       (unless (input-stream-p input)
         (error "~s cannot be read." input))
       (unless (output-stream-p output)
         (error "~s cannot be written to." output))
       (let ((both (make-instance 'object-two-way-stream)))
         (setf (slot-value both 'input) input
               (slot-value both 'output) output)
         both)))
    (make-broadcast-stream
     (let ((all (make-instance 'object-broadcast-stream)))
       (setf (slot-value all 'outputs) arguments)
       all))
    ((print prin1 princ pprint write print-object write-unreadable format)
     (%print-to-stream-object name arguments stream))
    ((write-char write-string write-line terpri fresh-line finish-output force-output clear-output
      write-byte write-sequence)
     (%write-to-stream-object name arguments stream))
    ((close open-stream-p input-stream-p output-stream-p interactive-stream-p stream-element-type
      stream-external-format)
     (%ask-stream-object name stream))
    (file-position
     (if (rest arguments)
         (setf (stream-file-position stream) (second arguments))
         (stream-file-position stream)))
    ((read-char read-char-no-hang peek-char unread-char read-line read-byte read-sequence listen
      clear-input read read-preserving-whitespace read-delimited-list)
     (%read-from-stream-object name arguments stream))
    (t
     (error "~s does not work with the stream ~s, whose class is a program's own." name stream))))

(defun %ask-stream-object (name stream)
  "What a function tells about a stream of a program's own class."
  (ecase name
    (close (setf (slot-value stream 'is-closed) t))
    (open-stream-p (not (slot-value stream 'is-closed)))
    (input-stream-p (typep stream 'fundamental-input-stream))
    (output-stream-p (typep stream 'fundamental-output-stream))
    (interactive-stream-p nil)
    (stream-external-format :default)
    (stream-element-type
     (if (typep stream 'fundamental-character-stream)
         'character
         (%no-stream-method 'stream-element-type stream)))))

(defun %write-to-stream-object (name arguments stream)
  "Writes to a stream of a program's own class."
  (let ((object (first arguments)))
    (ecase name
      (write-char (check-type object character) (stream-write-char stream object) object)
      ((write-string write-line)
       (check-type object string)
       (destructuring-bind (&key (start 0) end) (cddr arguments)
         (stream-write-string stream object start (or end (length object))))
       (when (eq name 'write-line)
         (stream-terpri stream))
       object)
      (terpri (stream-terpri stream) nil)
      (fresh-line (stream-fresh-line stream))
      (finish-output (stream-finish-output stream) nil)
      (force-output (stream-force-output stream) nil)
      (clear-output (stream-clear-output stream) nil)
      (write-byte (check-type object integer) (stream-write-byte stream object) object)
      (write-sequence
       (check-type object sequence)
       (destructuring-bind (&key (start 0) end) (cddr arguments)
         (stream-write-sequence stream object start (or end (length object))))
       object))))

(defun %print-to-stream-object (name arguments stream)
  "Prints to a stream of a program's own class what a function would print to another one."
  (if (eq name 'write-unreadable)
      (destructuring-bind (object place with-type with-identity body) arguments
        (declare (ignore place))
        (let ((type (%unreadable object with-type nil))
              (identity (%unreadable object nil with-identity)))
          (format stream "#<~a" type)
          (when body
            (when with-type (write-char #\space stream))
            (funcall body))
          (format stream "~:[~; ~]~a>" (and with-identity (or with-type body)) identity)
          nil))
      ;; What is printed depends on the column where it begins. An unknown one is not the first.
      (let* ((column (or (stream-line-column stream) 1))
             (text (with-output-to-string (target)
                     (loop repeat column do (write-char #\space target))
                     (ecase name
                       ((print prin1 princ pprint print-object)
                        (funcall name (first arguments) target))
                       (write (apply #'write (first arguments) :stream target (rest arguments)))
                       (format (apply #'format target (rest arguments)))))))
        (stream-write-string stream text column (length text))
        (case name
          (format nil)
          (pprint (values))
          (t (first arguments))))))

(defun %unreadable (object with-type with-identity)
  "What stands between #< and > if only one of type and identity is printed."
  (let ((text (with-output-to-string (target)
                (write-unreadable object target with-type with-identity nil))))
    (string-left-trim " " (subseq text 2 (1- (length text))))))

(defun %or-end (element stream error-p value)
  "The element, unless it says that the stream has ended."
  (cond ((not (eq element :eof)) element)
        (error-p (error 'end-of-file :stream stream))
        (t value)))

(defun %read-from-stream-object (name arguments stream)
  "Reads from a stream of a program's own class."
  (ecase name
    (unread-char (stream-unread-char stream (first arguments)) nil)
    (listen (stream-listen stream))
    (clear-input (stream-clear-input stream) nil)
    (read-sequence
     (destructuring-bind (sequence place &key (start 0) end) arguments
       (declare (ignore place))
       (stream-read-sequence stream sequence start (or end (length sequence)))))
    (peek-char
     (destructuring-bind (&optional type place (error-p t) value recursive-p) arguments
       (declare (ignore place recursive-p))
       (%peek-at-stream-object type stream error-p value)))
    (read-delimited-list
     (%read-list-from-stream-object (first arguments) stream))
    ((read-char read-char-no-hang read-line read-byte read read-preserving-whitespace)
     (destructuring-bind (&optional place (error-p t) value recursive-p) arguments
       (declare (ignore place))
       (ecase name
         (read-char (%or-end (stream-read-char stream) stream error-p value))
         (read-char-no-hang (%or-end (stream-read-char-no-hang stream) stream error-p value))
         (read-byte (%or-end (stream-read-byte stream) stream error-p value))
         (read (%read-form-from-stream-object stream error-p value recursive-p nil))
         (read-preserving-whitespace
          (%read-form-from-stream-object stream error-p value t nil))
         (read-line
          (multiple-value-bind (line is-last) (stream-read-line stream)
            (if (and is-last (or (eq line :eof) (equal line "")))
                (values (%or-end :eof stream error-p value) t)
                (values line is-last)))))))))

(defun %blank-p (character)
  "Is it one of the characters that separate forms?"
  (member character '(#\space #\newline #\tab #\return #\page)))

(defun %peek-at-stream-object (type stream error-p value)
  "PEEK-CHAR of a stream of a program's own class."
  (loop
    (let ((next (stream-peek-char stream)))
      (when (or (member next '(:eof nil))
                (case type
                  ((nil) t)
                  ((t) (not (%blank-p next)))
                  (otherwise (eql type next))))
        (return (%or-end (or next :eof) stream error-p value)))
      (stream-read-char stream))))

(defun %read-list-from-stream-object (end stream)
  "READ-DELIMITED-LIST of a stream of a program's own class."
  (loop until (eql (%peek-at-stream-object t stream t nil) end)
        collect (%read-form-from-stream-object stream t nil t end)
        finally (stream-read-char stream)))

(defun %read-form-from-stream-object (stream error-p value keeps-blank end)
  "Reads a form from a stream that gives one character after the other. END ends a symbol, too."
  (let ((text (make-array 40 :element-type 'character :adjustable t :fill-pointer 0))
        (inside-p (%nesting-tracker))
        (is-inside nil))
    (loop
      (let* ((next (stream-peek-char stream))
             (is-end (eq next :eof)))
        (when (and (plusp (length text))
                   (or is-end (not is-inside))
                   (%form-may-end-p text next end)
                   (%whole-form-p text))
          (multiple-value-bind (form position) (read-from-string text nil text)
            (cond ((eq form text))
                  ((< position (length text))
                   (error "~s is followed by characters that the stream ~s cannot take back."
                          form stream))
                  (t
                   (when (and (not keeps-blank) (not is-end) (%blank-p next))
                     (stream-read-char stream))
                   (return form)))))
        (when is-end
          (return (if (every #'%blank-p text)
                      (%or-end :eof stream error-p value)
                      (if (eq (ignore-errors (read-from-string text nil text)) text)
                          (%or-end :eof stream error-p value)
                          (error 'end-of-file :stream stream)))))
        (let ((character (stream-read-char stream)))
          (vector-push-extend character text)
          (setf is-inside (funcall inside-p character)))))))

(defun %nesting-tracker ()
  "A function of the characters of a text, one after the other: is the text certain to end inside a list,
  a string, bars or a comment? So a long form is not looked at as a whole again and again."
  (let ((depth 0) (delimiter nil) (previous nil) (is-escaped nil) (has-block-comment nil))
    (lambda (character)
      (cond (is-escaped (setf is-escaped nil))
            ((eql delimiter #\newline) (when (char= character #\newline) (setf delimiter nil)))
            ((char= character #\\) (setf is-escaped t))
            (delimiter (when (char= character delimiter) (setf delimiter nil)))
            (t
             (case character
               (#\( (incf depth))
               (#\) (decf depth))
               (#\; (setf delimiter #\newline))
               (#\" (setf delimiter #\"))
               (#\|
                (setf delimiter #\|)
                ;; One may be inside another; what follows is not tracked.
                (when (eql previous #\#) (setf has-block-comment t))))))
      (setf previous character)
      (and (not has-block-comment)
           (or (plusp depth) delimiter is-escaped)))))

(defun %form-may-end-p (text next end)
  "May a form end after this text, before this character?"
  (let* ((last (char text (1- (length text))))
         (token (1+ (or (position-if (lambda (c) (or (%blank-p c) (find c "()'`,"))) text :from-end t)
                        -1)))
         (is-dispatched (and (< token (length text))
                             (char= (char text token) #\#)
                             (not (eql (position #\\ text :start token) (1+ token))))))
    (or (eq next :eof)
        (%blank-p next)
        (find last ")\"|")
        (eql next end)
        (find next ");")
        (and (find next "(\"'`,") (not is-dispatched)))))

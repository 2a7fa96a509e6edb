;;;; ALEXANDRIA: streams and files of text.

(in-package :alexandria)

(defmacro with-input-from-file ((stream file &rest options
                                 &key (direction nil direction-p) &allow-other-keys)
                                &body body)
  "Evaluates the body with a stream that reads a file; the options are those of `open`.
  Examples:
  (alexandria:with-input-from-file (s \"no-such-file.txt\" :if-does-not-exist nil) s) => NIL"
  (declare (ignore direction))
  (when direction-p
    (error "WITH-INPUT-FROM-FILE takes no :DIRECTION: it is :INPUT."))
  `(with-open-file (,stream ,file :direction :input ,@options) ,@body))

(defmacro with-output-to-file ((stream file &rest options
                                &key (direction nil direction-p) &allow-other-keys)
                               &body body)
  "Evaluates the body with a stream that writes a file; the options are those of `open`.
  Examples:
  (handler-case (alexandria:with-output-to-file (s \"no-such-folder/a.txt\") s) (file-error () 'no-folder)) => NO-FOLDER"
  (declare (ignore direction))
  (when direction-p
    (error "WITH-OUTPUT-TO-FILE takes no :DIRECTION: it is :OUTPUT."))
  `(with-open-file (,stream ,file :direction :output ,@options) ,@body))

(defun copy-stream (input output &key (element-type 'character) (buffer-size 4096)
                                   (buffer (make-string buffer-size))
                                   (start 0) end finish-output)
  "Copies the characters from `start` to `end` of a stream to another; how many were copied.
  Examples:
  (with-output-to-string (o) (with-input-from-string (i \"abc\") (alexandria:copy-stream i o :start 1))) => \"bc\""
  (unless (subtypep element-type 'character)
    (error "Streams have characters, not elements of the type ~s." element-type))
  (when (and end (< end start))
    (error "The end ~s lies before the start ~s." end start))
  (loop repeat start
        unless (read-char input nil)
          do (error "The stream has less than ~d characters." start))
  (let ((copied 0))
    (loop
      (let* ((wanted (if end
                         (min (length buffer) (- end start copied))
                         (length buffer)))
             (got (read-sequence buffer input :end wanted)))
        (write-sequence buffer output :end got)
        (incf copied got)
        (when (or (< got wanted) (zerop wanted))
          (when finish-output (finish-output output))
          (return copied))))))

(defun copy-file (from to &key (if-to-exists :supersede) (element-type 'character) finish-output)
  "Copies a text file; how many characters were copied.
  Examples:
  (handler-case (alexandria:copy-file \"no-such-file.txt\" \"copy.txt\") (file-error () 'no-file)) => NO-FILE"
  (with-input-from-file (input from)
    (with-output-to-file (output to :if-exists if-to-exists)
      (copy-stream input output :element-type element-type :finish-output finish-output))))

(defun read-stream-content-into-string (stream &key (buffer-size 4096))
  "What a stream still has, as a string.
  Examples:
  (with-input-from-string (s \"abc\") (alexandria:read-stream-content-into-string s)) => \"abc\""
  (check-type buffer-size (integer 1))
  (with-output-to-string (text)
    (copy-stream stream text :buffer-size buffer-size)))

(defun read-file-into-string (file &key (buffer-size 4096) (external-format :utf-8))
  "The text of a file.
  Examples:
  (handler-case (alexandria:read-file-into-string \"no-such-file.txt\") (file-error () 'no-file)) => NO-FILE"
  (with-input-from-file (stream file :external-format external-format)
    (read-stream-content-into-string stream :buffer-size buffer-size)))

(defun write-string-into-file (string file &key (if-exists :error) (if-does-not-exist :create)
                                             (external-format :utf-8))
  "Writes a text into a file; the text.
  Examples:
  (handler-case (alexandria:write-string-into-file \"a\" \"no-such-folder/a.txt\") (file-error () 'no-folder)) => NO-FOLDER"
  (with-output-to-file (stream file :if-exists if-exists
                                    :if-does-not-exist if-does-not-exist
                                    :external-format external-format)
    (write-sequence string stream)))

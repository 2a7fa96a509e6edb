;;;; ALEXANDRIA: streams and files.

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

(defun copy-stream (input output &key (element-type (stream-element-type input))
                                   (buffer-size 4096)
                                   (buffer (make-array buffer-size :element-type element-type))
                                   (start 0) end finish-output)
  "Copies the elements from `start` to `end` of a stream to another; how many were copied.
  Examples:
  (with-output-to-string (o) (with-input-from-string (i \"abc\") (alexandria:copy-stream i o :start 1))) => \"bc\""
  (when (and end (< end start))
    (error "The end ~s lies before the start ~s." end start))
  (loop repeat start
        unless (if (subtypep element-type 'character) (read-char input nil) (read-byte input nil))
          do (error "The stream has less than ~d elements." start))
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

(defun copy-file (from to &key (if-to-exists :supersede) (element-type '(unsigned-byte 8))
                             finish-output)
  "Copies a file; how many elements were copied.
  Examples:
  (handler-case (alexandria:copy-file \"no-such-file.txt\" \"copy.txt\") (file-error () 'no-file)) => NO-FILE"
  (with-input-from-file (input from :element-type element-type)
    (with-output-to-file (output to :if-exists if-to-exists :element-type element-type)
      (copy-stream input output :element-type element-type :finish-output finish-output))))

(defun read-stream-content-into-byte-vector (stream &key length (initial-size 4096))
  "What a stream of bytes still has, as a vector; if there is a limit, no more than that.
  Examples:
  (handler-case (alexandria:read-stream-content-into-byte-vector (make-string-input-stream \"a\")) (stream-error () 'characters)) => CHARACTERS"
  (check-type length (or null (integer 0)))
  (check-type initial-size (integer 1))
  (coerce (loop repeat (or length most-positive-fixnum)
                for byte = (read-byte stream nil)
                while byte collect byte)
          '(vector (unsigned-byte 8))))

(defun read-file-into-byte-vector (file)
  "The bytes of a file.
  Examples:
  (handler-case (alexandria:read-file-into-byte-vector \"no-such-file.txt\") (file-error () 'no-file)) => NO-FILE"
  (with-input-from-file (stream file :element-type '(unsigned-byte 8))
    (read-stream-content-into-byte-vector stream)))

(defun write-byte-vector-into-file (bytes file &key (if-exists :error) if-does-not-exist)
  "Writes bytes into a file; the bytes.
  Examples:
  (handler-case (alexandria:write-byte-vector-into-file #(1) \"no-such-folder/a\") (file-error () 'no-folder)) => NO-FOLDER"
  (check-type bytes vector)
  (with-output-to-file (stream file :if-exists if-exists
                                    :if-does-not-exist (or if-does-not-exist :create)
                                    :element-type '(unsigned-byte 8))
    (write-sequence bytes stream)))

(defun read-stream-content-into-string (stream &key (buffer-size 4096))
  "What a stream still has, as a string.
  Examples:
  (with-input-from-string (s \"abc\") (alexandria:read-stream-content-into-string s)) => \"abc\""
  (check-type buffer-size (integer 1))
  (with-output-to-string (text)
    (loop
      (multiple-value-bind (line is-last) (read-line stream nil nil)
        (when line
          (write-string line text))
        (when is-last
          (return))
        (write-char #\newline text)))))

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

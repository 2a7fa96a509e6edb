;;; The pretty printer: sections 22.2 and 22.4 of the standard.

(in-package :common-lisp)

(defmacro pprint-logical-block ((stream list &key (prefix "" prefix-p) (per-line-prefix "" per-line-p)
                                                  (suffix ""))
                                &body body)
  "Evaluates the body, which prints the list's elements, as a block of lines that breaks as a whole. An object that is no list is printed as it is.
  Examples:
  (with-output-to-string (s) (pprint-logical-block (s '(1 2) :prefix \"<\" :suffix \">\") (prin1 (pprint-pop) s))) => \"<1>\"
  (substitute #\\| #\\Newline (with-output-to-string (s) (let ((*print-right-margin* 9)) (pprint-logical-block (s nil :per-line-prefix \"; \") (dolist (word '(take the cup)) (princ word s) (write-char #\\Space s) (pprint-newline :fill s)))))) => \"; TAKE|; THE|; CUP \""
  (if (and prefix-p per-line-p)
      (error 'simple-program-error :format-control "A logical block has a prefix or a prefix per line, not both."))
  (let ((variable (case stream ((nil) '*standard-output*) ((t) '*terminal-io*) (t stream)))
        (rest (gensym "REST"))
        (count (gensym "COUNT"))
        (name (gensym "BLOCK")))
    `(%print-block ,variable ,list ,(if per-line-p per-line-prefix prefix) ,per-line-p ,suffix
                   #'(lambda (,variable ,rest)
                       (let ((,count 0))
                         (declare (ignorable ,count))
                         (block ,name
                           (macrolet ((pprint-pop ()
                                        '(if (%block-goes-on-p ,rest ,count ,variable)
                                             (progn (setq ,count (1+ ,count)) (pop ,rest))
                                             (return-from ,name nil)))
                                      (pprint-exit-if-list-exhausted ()
                                        '(if (null ,rest) (return-from ,name nil))))
                             (let () ,@body))))))))

(defmacro pprint-pop ()
  "The next element of the list that a logical block prints. Where the list is dotted, or longer than *PRINT-LENGTH*, the rest is written in short and the block ends.
  Examples:
  (with-output-to-string (s) (let ((*print-length* 1)) (pprint-logical-block (s '(a b)) (loop (prin1 (pprint-pop) s) (write-char #\\Space s))))) => \"A ...\""
  '(error "PPRINT-POP belongs inside PPRINT-LOGICAL-BLOCK."))

(defmacro pprint-exit-if-list-exhausted ()
  "Ends the logical block if its list has no more elements.
  Examples:
  (with-output-to-string (s) (pprint-logical-block (s '(a b)) (loop (pprint-exit-if-list-exhausted) (prin1 (pprint-pop) s)))) => \"AB\""
  '(error "PPRINT-EXIT-IF-LIST-EXHAUSTED belongs inside PPRINT-LOGICAL-BLOCK."))

(defun %print-block (designator object prefix per-line suffix function)
  "Calls the function with a stream and the list, between prefix and suffix."
  (check-type prefix string)
  (check-type suffix string)
  (let ((stream (%output-stream designator)))
    (cond ((not (listp object))
           (write object :stream stream))
          ((and *print-level* (not *print-readably*) (>= %print-depth *print-level*))
           (write-char #\# stream))
          ((and (eq %print-labels t) (%circular-list-p object))
           (%write-as-standard stream object))
          (t
           (let ((%print-depth (1+ %print-depth))
                 (%print-labels (or %print-labels (and *print-circle* (%labels object)))))
             (cond ((%write-label object stream))
                   ((or (not *print-pretty*) (%pretty-stream-p stream))
                    (%print-block-to stream object prefix per-line suffix function))
                   (t
                    (let ((pretty (%make-pretty-stream stream)))
                      (%print-block-to pretty object prefix per-line suffix function)
                      (%lay-out pretty stream)))))))
    nil))

(defun %print-block-to (stream object prefix per-line suffix function)
  "The block itself, on a stream that takes it."
  (%start-block stream prefix per-line suffix)
  (funcall function stream object)
  (%end-block stream suffix))

(defun %circular-list-p (list)
  "Has the list no end?"
  (handler-case (null (list-length list))
    (type-error () nil)))

(defun %block-goes-on-p (rest count stream)
  "Is there a next element for PPRINT-POP? If not, what stands in its place is written."
  (cond ((not (listp rest))
         (write-string ". " stream)
         (write rest :stream stream)
         nil)
        ((and *print-length* (not *print-readably*) (>= count *print-length*))
         (write-string "..." stream)
         nil)
        ((and (plusp count) (%labelled-p rest))
         (write-string ". " stream)
         (write rest :stream stream)
         nil)
        (t t)))

(defun pprint-newline (kind &optional stream)
  "A place where the pretty printer may break the line: :LINEAR breaks if the block does not fit on a line, :FILL if what follows does not, :MISER like :LINEAR near the right margin, :MANDATORY always.
  Examples:
  (substitute #\\| #\\Newline (with-output-to-string (s) (pprint-logical-block (s nil) (princ 1 s) (pprint-newline :mandatory s) (princ 2 s)))) => \"1|2\""
  (check-type kind (member :linear :fill :miser :mandatory))
  (if *print-pretty* (%newline kind stream)))

(defun pprint-indent (relative-to columns &optional stream)
  "Indents the next lines of the logical block, relative to where it starts (:BLOCK) or to the current column (:CURRENT).
  Examples:
  (substitute #\\| #\\Newline (with-output-to-string (s) (pprint-logical-block (s nil) (princ 1 s) (pprint-indent :block 2 s) (pprint-newline :mandatory s) (princ 2 s)))) => \"1|  2\""
  (check-type relative-to (member :block :current))
  (check-type columns real)
  (if *print-pretty* (%indent (eq relative-to :current) (round columns) stream)))

(defun pprint-tab (kind column step &optional stream)
  "Writes blanks up to a column, or beyond it to the next multiple of the step; columns count from the line's start (:LINE) or the section's (:SECTION), or from where it stands (:LINE-RELATIVE, :SECTION-RELATIVE).
  Examples:
  (with-output-to-string (s) (pprint-logical-block (s nil) (princ 1 s) (pprint-tab :line 4 1 s) (princ 2 s))) => \"1   2\""
  (check-type kind (member :line :section :line-relative :section-relative))
  (check-type column (integer 0))
  (check-type step (integer 0))
  (if *print-pretty*
      (%tab (member kind '(:section :section-relative))
            (member kind '(:line-relative :section-relative))
            (min column 10000) (min step 10000) stream)))

(defun %print-elements (stream list parentheses separate)
  "Prints the list's elements, with what a function writes between them."
  (pprint-logical-block (stream list :prefix (if parentheses "(" "") :suffix (if parentheses ")" ""))
    (pprint-exit-if-list-exhausted)
    (loop
      (write (pprint-pop) :stream stream)
      (pprint-exit-if-list-exhausted)
      (funcall separate stream))))

(defun pprint-fill (stream list &optional (colon t) at)
  "Prints the list's elements, as many on a line as fit.
  Examples:
  (substitute #\\| #\\Newline (with-output-to-string (s) (let ((*print-right-margin* 8)) (pprint-fill s '(1 2 3 4 5))))) => \"(1 2 3| 4 5)\""
  (declare (ignore at))
  (%print-elements stream list colon
                   (lambda (stream) (write-char #\Space stream) (pprint-newline :fill stream))))

(defun pprint-linear (stream list &optional (colon t) at)
  "Prints the list's elements on one line, or each on a line of its own.
  Examples:
  (substitute #\\| #\\Newline (with-output-to-string (s) (let ((*print-right-margin* 5)) (pprint-linear s '(1 2 3))))) => \"(1| 2| 3)\""
  (declare (ignore at))
  (%print-elements stream list colon
                   (lambda (stream) (write-char #\Space stream) (pprint-newline :linear stream))))

(defun pprint-tabular (stream list &optional (colon t) at (tabsize 16))
  "Prints the list's elements as a table with columns of a width.
  Examples:
  (substitute #\\| #\\Newline (with-output-to-string (s) (let ((*print-right-margin* 9)) (pprint-tabular s '(1 2 3 4) t nil 4)))) => \"(1   2| 3   4)\""
  (declare (ignore at))
  (%print-elements stream list colon
                   (lambda (stream)
                     (write-char #\Space stream)
                     (pprint-tab :section-relative 0 (or tabsize 16) stream)
                     (pprint-newline :fill stream))))

(defun copy-pprint-dispatch (&optional (table *print-pprint-dispatch*))
  "A copy of a dispatch table of the pretty printer; of the standard one if the table is NIL.
  Examples:
  (hash-table-count (copy-pprint-dispatch nil)) => 0"
  (let ((copy (make-hash-table :test 'equal)))
    (if table
        (maphash (lambda (type entry) (setf (gethash type copy) entry)) table))
    copy))

(defun set-pprint-dispatch (type function &optional (priority 0) (table *print-pprint-dispatch*))
  "Lets the pretty printer print values of a type by a function of stream and value; where several types fit, the one of the highest priority. Without a function, the type's entry is removed.
  Examples:
  (let ((*print-pprint-dispatch* (copy-pprint-dispatch nil))) (set-pprint-dispatch '(cons (eql at)) (lambda (s list) (format s \"~{~a~^@~}\" (cdr list)))) (prin1-to-string '(x (at cup table)))) => \"(X CUP@TABLE)\""
  (check-type priority real)
  (check-type function (or symbol function))
  (check-type table hash-table)
  (if function
      (setf (gethash type table) (cons function priority))
      (remhash type table))
  nil)

(defun %tell-type (value type stream)
  "Writes something if the value is of the type: how the printer asks for types that only a call can tell."
  (if (typep value type) (write-char #\t stream)))

(defun %pprint-function (object table)
  "The function that a dispatch table has for the object, or NIL."
  (let ((best nil))
    (maphash (lambda (type entry)
               (if (and (or (null best) (> (cdr entry) (cdr best)))
                        (typep object type))
                   (setq best entry)))
             table)
    (car best)))

(defun pprint-dispatch (object &optional (table *print-pprint-dispatch*))
  "The function of stream and object by which the pretty printer prints the object, and whether the table has one of its own for it.
  Examples:
  (nth-value 1 (pprint-dispatch 5)) => NIL"
  (let ((function (and table (%pprint-function object table))))
    (if function
        (values function t)
        (values #'%write-as-standard
                (and (consp object) (symbolp (car object)) (fboundp (car object)) t)))))

(defun %write-dispatched (writer object pprint-dispatch arguments)
  "WRITE or WRITE-TO-STRING with another dispatch table."
  (let ((*print-pprint-dispatch* (or pprint-dispatch (copy-pprint-dispatch nil)))
        (arguments (copy-list arguments)))
    (loop while (remf arguments :pprint-dispatch))
    (apply writer object arguments)))

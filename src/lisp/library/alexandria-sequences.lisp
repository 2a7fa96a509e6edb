;;;; ALEXANDRIA: sequences.

(in-package :alexandria)

;;; Length

(defun emptyp (sequence)
  "Has the sequence no elements?
  Examples:
  (alexandria:emptyp \"\") => T"
  (if (listp sequence) (null sequence) (zerop (length sequence))))

(defun length= (sequence &rest more)
  "Are all lengths (or given numbers) the same?
  Examples:
  (alexandria:length= '(a b) 2) => T"
  (flet ((size (object)
           (if (integerp object) object (length object))))
    (apply #'= (size sequence) (mapcar #'size more))))

(defun sequence-of-length-p (sequence length)
  "Has the sequence that many elements? A list is not followed further than needed.
  Examples:
  (alexandria:sequence-of-length-p '(a b) 2) => T"
  (if (listp sequence)
      (if (zerop length)
          (null sequence)
          (let ((last (nthcdr (1- length) sequence)))
            (and last (endp (rest last)))))
      (= (length sequence) length)))

;;; Elements

(defun %check-elements (sequence)
  "Signals an error if an object is no sequence, or an empty one."
  (%check-sequence sequence)
  (when (emptyp sequence)
    (error 'simple-type-error
           :datum sequence :expected-type '(and proper-sequence (not (satisfies emptyp)))
           :format-control "The sequence is empty, so it has no such element.")))

(defun %check-sequence (object)
  "Signals an error if an object is no sequence, such as a list that does not end with NIL."
  (unless (typep object 'proper-sequence)
    (error 'type-error :datum object :expected-type 'proper-sequence)))

(defun first-elt (sequence)
  "The first element. It is a place.
  Examples:
  (alexandria:first-elt \"abc\") => #\\a"
  (%check-elements sequence)
  (elt sequence 0))

(defun (setf first-elt) (object sequence)
  "Replaces the first element."
  (%check-elements sequence)
  (setf (elt sequence 0) object))

(defun last-elt (sequence)
  "The last element. It is a place.
  Examples:
  (alexandria:last-elt '(1 2 3)) => 3"
  (%check-elements sequence)
  (elt sequence (1- (length sequence))))

(defun (setf last-elt) (object sequence)
  "Replaces the last element."
  (%check-elements sequence)
  (setf (elt sequence (1- (length sequence))) object))

(defun random-elt (sequence &key (start 0) end)
  "A random element.
  Examples:
  (alexandria:random-elt '(a)) => A"
  (%check-elements sequence)
  (let ((end (or end (length sequence))))
    (unless (< -1 start end (1+ (length sequence)))
      (error "There are no elements from ~s to ~s in ~s." start end sequence))
    (elt sequence (+ start (random (- end start))))))

(defun extremum (sequence predicate &key key (start 0) end)
  "The element that would be first after sorting.
  Examples:
  (alexandria:extremum '(3 1 2) #'<) => 1"
  (let ((key (or key #'identity))
        (part (subseq sequence start end)))
    (unless (emptyp part)
      (reduce (lambda (best element)
                (if (funcall predicate (funcall key element) (funcall key best))
                    element
                    best))
              part))))

;;; Beginnings and ends

(defun starts-with (object sequence &key (test #'eql) (key #'identity))
  "Is the object the first element?
  Examples:
  (alexandria:starts-with 1 '(1 2)) => T"
  (and (typep sequence 'sequence)
       (not (emptyp sequence))
       (funcall test (funcall (or key #'identity) (first-elt sequence)) object)))

(defun ends-with (object sequence &key (test #'eql) (key #'identity))
  "Is the object the last element?
  Examples:
  (alexandria:ends-with 2 '(1 2)) => T"
  (when (consp sequence)
    (%check-sequence sequence))
  (and (typep sequence 'sequence)
       (not (emptyp sequence))
       (funcall test (funcall (or key #'identity) (last-elt sequence)) object)))

(defun starts-with-subseq (prefix sequence &rest options &key return-suffix &allow-other-keys)
  "Does a sequence start with another? The second value is the rest, if it is asked for. Other options
  are those of `mismatch`.
  Examples:
  (alexandria:starts-with-subseq \"he\" \"hello\") => T ; NIL
  (alexandria:starts-with-subseq \"he\" \"hello\" :return-suffix t) => T ; \"llo\""
  (let* ((options (remove-from-plist options :return-suffix))
         (start (getf options :start1 0))
         (end (or (getf options :end1) (length prefix)))
         (place (apply #'mismatch prefix sequence options))
         (matches (or (null place) (= place end))))
    (values matches
            (and matches
                 return-suffix
                 (subseq sequence (+ (getf options :start2 0) (- end start)))))))

(defun ends-with-subseq (suffix sequence &key (test #'eql))
  "Does a sequence end with another?
  Examples:
  (alexandria:ends-with-subseq \"lo\" \"hello\") => T"
  (let ((start (mismatch suffix sequence :from-end t :test test)))
    (or (null start) (zerop start))))

(defun alexandria-2:subseq* (sequence start &optional end)
  "Like `subseq`; an end beyond the sequence means its end.
  Examples:
  (alexandria-2:subseq* \"abc\" 1 9) => \"bc\""
  (let ((length (length sequence)))
    (if (>= start length)
        (subseq sequence 0 0)
        (subseq sequence start (and end (min end length))))))

;;; Other orders

(defun rotate (sequence &optional (n 1))
  "Moves the last `n` elements to the front; if `n` is negative, the first ones to the end. The sequence
  may be changed.
  Examples:
  (alexandria:rotate (list 1 2 3)) => (3 1 2)
  (alexandria:rotate (list 1 2 3) -1) => (2 3 1)"
  (%check-sequence sequence)
  (let ((length (length sequence)))
    (if (zerop length)
        sequence
        (let ((cut (mod (- n) length)))
          (replace sequence
                   (concatenate 'vector (subseq sequence cut) (subseq sequence 0 cut)))))))

(defun shuffle (sequence &key (start 0) end)
  "Puts the elements of a sequence in random order.
  Examples:
  (length (alexandria:shuffle (list 1 2 3))) => 3"
  (%check-sequence sequence)
  (let ((elements (coerce (subseq sequence start end) 'simple-vector)))
    (loop for last from (1- (length elements)) above 0
          do (rotatef (svref elements last)
                      (svref elements (random (1+ last)))))
    (replace sequence elements :start1 start)))

(defun copy-sequence (type sequence)
  "A copy of a sequence as a sequence of a type.
  Examples:
  (alexandria:copy-sequence 'vector '(1 2)) => #(1 2)"
  (let ((copy (coerce sequence type)))
    (if (eq copy sequence) (copy-seq sequence) copy)))

(define-modify-macro removef (item &rest options) %remove-item
  "Removes an item from the sequence in a place.
  Examples:
  (let ((l (list 1 2))) (alexandria:removef l 1) l) => (2)")

(defun %remove-item (sequence item &rest options)
  "REMOVE with the sequence as the first argument."
  (apply #'remove item sequence options))

(define-modify-macro deletef (item &rest options) %delete-item
  "Deletes an item from the sequence in a place.
  Examples:
  (let ((l (list 1 2))) (alexandria:deletef l 1) l) => (2)")

(defun %delete-item (sequence item &rest options)
  "DELETE with the sequence as the first argument."
  (apply #'delete item sequence options))

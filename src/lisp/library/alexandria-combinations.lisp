;;;; ALEXANDRIA: combinations and permutations of the elements of a sequence.

(in-package :alexandria)

(defun %caller (function like copy)
  "A function that passes a list of elements on, as a sequence like another one. Unless they are to be
copied, all calls get the same sequence with other elements."
  (let ((function (ensure-function function))
        (buffer nil))
    (lambda (elements)
      (funcall function
               (cond ((or copy (null buffer))
                      (setf buffer (%sequence-like like elements)))
                     (t (replace buffer elements)))))))

(defun %sequence-like (like elements)
  "The elements as a list, a string or a vector, as the other sequence is."
  (etypecase like
    (list (copy-list elements))
    (string (coerce elements 'string))
    (vector (make-array (length elements)
                        :element-type (array-element-type like)
                        :initial-contents elements))))

(defun map-combinations (function sequence &key (start 0) end length (copy t))
  "Calls a function with each choice of `length` elements (all), in the order of the sequence.
  Examples:
  (let (r) (alexandria:map-combinations (lambda (c) (push c r)) '(1 2 3) :length 2) (reverse r)) => ((1 2) (1 3) (2 3))"
  (let* ((elements (coerce (subseq sequence start end) 'list))
         (call (%caller function sequence copy)))
    (labels ((choose (rest count chosen)
               (cond ((zerop count)
                      (funcall call (reverse chosen)))
                     (t (loop for (element . more) on rest
                              do (choose more (1- count) (cons element chosen)))))))
      (let ((length (or length (length elements))))
        (when (<= length (length elements))
          (choose elements length '()))))
    sequence))

(defun map-permutations (function sequence &key (start 0) end length (copy t))
  "Calls a function with each order of each choice of `length` elements (all).
  Examples:
  (let (r) (alexandria:map-permutations (lambda (p) (push p r)) '(1 2)) (reverse r)) => ((1 2) (2 1))"
  (let* ((elements (coerce (subseq sequence start end) 'list))
         (call (%caller function sequence copy)))
    (labels ((choose (rest count chosen)
               (if (zerop count)
                   (funcall call (reverse chosen))
                   (loop for (element . more) on rest
                         for before = '() then (append before (list previous))
                         for previous = element
                         do (choose (append before more)
                                    (1- count)
                                    (cons element chosen))))))
      (let ((length (or length (length elements))))
        (when (<= length (length elements))
          (choose elements length '()))))
    sequence))

(defun map-derangements (function sequence &key (start 0) end (copy t))
  "Calls a function with each order of the sequence in which no element from `start` to `end` is in its
  place.
  Examples:
  (let (r) (alexandria:map-derangements (lambda (p) (push p r)) '(1 2 3)) (reverse r)) => ((2 3 1) (3 1 2))"
  (let* ((all (coerce sequence 'vector))
         (end (or end (length all)))
         (call (%caller function sequence copy))
         (order (copy-seq all))
         (taken (make-array (length all) :initial-element nil)))
    (labels ((fill-place (place)
               (if (= place end)
                   (funcall call (coerce order 'list))
                   (loop for other from start below end
                         unless (or (= other place) (aref taken other))
                           do (setf (aref taken other) t
                                    (aref order place) (aref all other))
                              (fill-place (1+ place))
                              (setf (aref taken other) nil)))))
      (fill-place start))
    sequence))

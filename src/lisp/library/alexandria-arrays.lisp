;;;; ALEXANDRIA: arrays.

(in-package :alexandria)

(defun copy-array (array &key (element-type (array-element-type array))
                           (fill-pointer (and (array-has-fill-pointer-p array)
                                              (fill-pointer array)))
                           (adjustable (adjustable-array-p array)))
  "A copy of an array, with its fill pointer.
  Examples:
  (alexandria:copy-array #(1 2)) => #(1 2)"
  (let ((copy (make-array (array-dimensions array)
                          :element-type element-type
                          :fill-pointer fill-pointer
                          :adjustable adjustable)))
    (dotimes (i (array-total-size copy) copy)
      (setf (row-major-aref copy i) (row-major-aref array i)))))

(defun alexandria-2:dim-in-bounds-p (dimensions &rest subscripts)
  "Are the subscripts within an array of these dimensions?
  Examples:
  (alexandria-2:dim-in-bounds-p '(2 3) 1 2) => T"
  (and (length= dimensions subscripts)
       (every (lambda (dimension subscript)
                (and (integerp subscript) (< -1 subscript dimension)))
              dimensions subscripts)))

(defun alexandria-2:row-major-index (dimensions &rest subscripts)
  "The row-major index of an element in an array of these dimensions.
  Examples:
  (alexandria-2:row-major-index '(2 3) 1 2) => 5"
  (unless (apply #'alexandria-2:dim-in-bounds-p dimensions subscripts)
    (error "~s are no subscripts of an array with the dimensions ~s." subscripts dimensions))
  (reduce #'+ (mapcar (lambda (subscript more) (reduce #'* more :initial-value subscript))
                      subscripts
                      (maplist #'rest dimensions))))

(defun alexandria-2:rmajor-to-indices (dimensions index)
  "The subscripts of the element at a row-major index, as a list.
  Examples:
  (alexandria-2:rmajor-to-indices '(2 3) 5) => (1 2)"
  (unless (and (integerp index) (< -1 index (reduce #'* dimensions)))
    (error "~s is no row-major index of an array with the dimensions ~s." index dimensions))
  (let ((subscripts '()))
    (dolist (dimension (reverse dimensions) subscripts)
      (multiple-value-bind (more subscript) (floor index dimension)
        (push subscript subscripts)
        (setf index more)))))

;;; Classes: instances, accessors, generic functions with inherited and around methods.

(defclass shape ()
  ((name :initarg :name :accessor shape-name)
   (uses :initform 0 :accessor shape-uses)))

(defclass rectangle (shape)
  ((width :initarg :width :accessor width)
   (height :initarg :height :accessor height)))

(defclass square (rectangle) ())

(defclass circle (shape)
  ((radius :initarg :radius :accessor radius)))

(defgeneric area (shape))
(defgeneric use (shape amount))

(defmethod area ((shape rectangle))
  (* (width shape) (height shape)))

(defmethod area ((shape circle))
  (* 3 (radius shape) (radius shape)))

(defmethod use ((shape shape) amount)
  (setf (shape-uses shape) (+ (shape-uses shape) amount)))

(defmethod use ((shape square) amount)
  (when (> amount 0)
    (call-next-method)))

(defun run ()
  (let ((shapes (list (make-instance 'rectangle :name 'r :width 2 :height 3)
                      (make-instance 'square :name 's :width 4 :height 4)
                      (make-instance 'circle :name 'c :radius 5)))
        (sum 0))
    (dotimes (i 100000)
      (dolist (shape shapes)
        (setq sum (+ sum (area shape)))
        (use shape 1)))
    (dotimes (i 10000)
      (setq sum (+ sum (area (make-instance 'square :name i :width i :height 1)))))
    (list sum (mapcar #'shape-uses shapes))))

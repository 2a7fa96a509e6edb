;;; The triangular peg solitaire with fifteen holes: vectors that are read and changed.

(defvar *board* (make-array 16 :initial-element 1))
(defvar *moves* (make-array 14 :initial-element 0))
(defvar *from*
  (coerce '(1 2 4 3 5 6 1 3 6 2 5 4 11 12 13 7 8 4 4 7 11 8 12 13 6 10 15 9 14 13 13 14 15 9 10 6 6)
          'simple-vector))
(defvar *over*
  (coerce '(2 4 7 5 8 9 3 6 10 5 9 8 12 13 14 8 9 5 2 4 7 5 8 9 3 6 10 5 9 8 12 13 14 8 9 5 5)
          'simple-vector))
(defvar *to*
  (coerce '(4 7 11 8 12 13 6 10 15 9 14 13 13 14 15 9 10 6 1 2 4 3 5 6 1 3 6 2 5 4 11 12 13 7 8 4 4)
          'simple-vector))
(defvar *solutions* 0)
(defvar *tried* 0)

(defun jump (move depth)
  "Tries a move and all that may follow; true once enough has been tried."
  (cond ((= depth 13)
         (setq *solutions* (1+ *solutions*))
         nil)
        ((and (= 1 (svref *board* (svref *from* move)))
              (= 1 (svref *board* (svref *over* move)))
              (= 0 (svref *board* (svref *to* move))))
         (setf (svref *board* (svref *from* move)) 0)
         (setf (svref *board* (svref *over* move)) 0)
         (setf (svref *board* (svref *to* move)) 1)
         (setf (svref *moves* depth) move)
         (setq *tried* (1+ *tried*))
         (do ((next 0 (1+ next)) (d (1+ depth)))
             ((or (= next 36) (> *tried* 30000)) nil)
           (jump next d))
         (setf (svref *board* (svref *from* move)) 1)
         (setf (svref *board* (svref *over* move)) 1)
         (setf (svref *board* (svref *to* move)) 0)
         nil)))

(defun run ()
  (fill *board* 1)
  (setf (svref *board* 5) 0)
  (setq *solutions* 0)
  (setq *tried* 0)
  (jump 22 1)
  (list *solutions* *tried*))

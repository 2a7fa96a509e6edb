;;; All ways to place eight queens on a board, on lists.

(defun safe-p (column rows)
  (do ((rest rows (cdr rest)) (distance 1 (+ distance 1)))
      ((null rest) t)
    (let ((other (car rest)))
      (when (or (= other column)
                (= other (+ column distance))
                (= other (- column distance)))
        (return nil)))))

(defun placements (size left rows)
  (if (= left 0)
      1
      (let ((count 0))
        (dotimes (column size count)
          (when (safe-p column rows)
            (incf count (placements size (- left 1) (cons column rows))))))))

(defun run ()
  (let ((result 0))
    (dotimes (i 40 result)
      (setq result (placements 8 8 '())))))

;;; Lists that are changed in place: cut, joined and refilled.

(defun fresh-rows (rows length)
  (let ((all '()))
    (dotimes (i rows all)
      (push (make-list length) all))))

(defun stamp (row mark)
  (do ((rest row (cdr rest)))
      ((null rest) row)
    (rplaca rest mark)))

(defun cut-in-half (row)
  "Cuts the row after half its length; returns the second part."
  (let ((tail (nthcdr (1- (floor (length row) 2)) row)))
    (prog1 (cdr tail)
      (rplacd tail nil))))

(defun exchange-tails (rows mark)
  (do ((rest rows (cdr rest)))
      ((null (cdr rest)) rows)
    (let ((one (cut-in-half (car rest)))
          (other (cut-in-half (cadr rest))))
      (stamp one mark)
      (rplaca rest (nconc (car rest) other))
      (rplaca (cdr rest) (nconc (cadr rest) one)))))

(defun refill (rows length)
  (do ((rest rows (cdr rest)))
      ((null rest) rows)
    (let ((missing (- length (length (car rest)))))
      (when (> missing 0)
        (rplaca rest (nconc (car rest) (make-list missing)))))))

(defun marks (rows)
  (let ((count 0))
    (dolist (row rows count)
      (dolist (mark row)
        (when mark (incf count mark))))))

(defun run ()
  (let ((rows (fresh-rows 10 11)))
    (dotimes (i 40000 (marks rows))
      (exchange-tails rows i)
      (refill rows 11)
      (setq rows (nreverse rows)))))

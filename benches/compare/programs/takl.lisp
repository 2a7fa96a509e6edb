;;; Takeuchi's function on lists, whose lengths stand for numbers.

(defun count-down (n)
  (if (= n 0) '() (cons n (count-down (- n 1)))))

(defun shorter-p (x y)
  (and (not (null y))
       (or (null x) (shorter-p (cdr x) (cdr y)))))

(defun takl (x y z)
  (if (shorter-p y x)
      (takl (takl (cdr x) y z)
            (takl (cdr y) z x)
            (takl (cdr z) x y))
      z))

(defun run ()
  (let ((x (count-down 18)) (y (count-down 12)) (z (count-down 6)) (result nil))
    (dotimes (i 6 (length result))
      (setq result (takl x y z)))))

;;; Takeuchi's function: calls with three small integers.

(defun tak (x y z)
  (if (< y x)
      (tak (tak (1- x) y z)
           (tak (1- y) z x)
           (tak (1- z) x y))
      z))

(defun run ()
  (let ((result nil))
    (dotimes (i 80 result)
      (setq result (tak 18 12 6)))))

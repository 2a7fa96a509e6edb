;;; Takeuchi's function, each call of which throws its value to a catch.

(defun ctak (x y z)
  (catch 'value (ctak-inside x y z)))

(defun ctak-inside (x y z)
  (if (< y x)
      (ctak-inside (catch 'value (ctak-inside (1- x) y z))
                   (catch 'value (ctak-inside (1- y) z x))
                   (catch 'value (ctak-inside (1- z) x y)))
      (throw 'value z)))

(defun run ()
  (let ((result nil))
    (dotimes (i 20 result)
      (setq result (ctak 18 12 6)))))

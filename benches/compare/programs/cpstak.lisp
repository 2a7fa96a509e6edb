;;; Takeuchi's function in continuation-passing style: closures that are made and called.

(defun cpstak (x y z k)
  (if (< y x)
      (cpstak (1- x) y z
              (lambda (a)
                (cpstak (1- y) z x
                        (lambda (b)
                          (cpstak (1- z) x y
                                  (lambda (c) (cpstak a b c k)))))))
      (funcall k z)))

(defun run ()
  (let ((result nil))
    (dotimes (i 1000 result)
      (setq result (cpstak 12 8 4 #'identity)))))

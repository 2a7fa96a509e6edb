;;; Fibonacci numbers by double recursion.

(defun fib (n)
  (if (< n 2)
      n
      (+ (fib (- n 1)) (fib (- n 2)))))

(defun run () (fib 31))

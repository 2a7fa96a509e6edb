;;; The sieve of Eratosthenes: a loop over a vector.

(defun primes-below (limit)
  (let ((composite (make-array limit :initial-element nil)) (count 0))
    (do ((n 2 (1+ n)))
        ((>= n limit) count)
      (unless (aref composite n)
        (setq count (1+ count))
        (do ((multiple (+ n n) (+ multiple n)))
            ((>= multiple limit))
          (setf (aref composite multiple) t))))))

(defun run ()
  (let ((result 0))
    (dotimes (i 10 result)
      (setq result (primes-below 100000)))))

;;;; ALEXANDRIA: numbers.

(in-package :alexandria)

(defun clamp (number min max)
  "The number, or the bound that it is beyond.
  Examples:
  (alexandria:clamp 11 0 10) => 10"
  (cond ((< number min) min)
        ((> number max) max)
        (t number)))

(defun lerp (way from to)
  "The number at a part of the way between two others.
  Examples:
  (alexandria:lerp 1/2 0 10) => 5"
  (+ (* (- 1 way) from) (* way to)))

(defun iota (n &key (start 0) (step 1))
  "A list of `n` numbers from `start` (0) in steps (1).
  Examples:
  (alexandria:iota 3) => (0 1 2)
  (alexandria:iota 3 :start 1 :step 2) => (1 3 5)
  (alexandria:iota 2 :start 0.0 :step #C(0 2)) => (#C(0.0 0.0) #C(0.0 2.0))"
  ;; All numbers have one type, even if only the step is a float.
  (let ((number (- (+ start step) step)))
    (map-into (make-list n)
              (lambda () (prog1 number (incf number step))))))

(defun map-iota (function n &key (start 0) (step 1))
  "Calls a function with each of the numbers of `iota`; their count.
  Examples:
  (let ((sum 0)) (alexandria:map-iota (lambda (i) (incf sum i)) 4) sum) => 6"
  (loop repeat n
        for number = (- (+ start step) step) then (+ number step)
        do (funcall function number))
  n)

;;; Statistics

(defun mean (sample)
  "The mean of a sequence of numbers.
  Examples:
  (alexandria:mean '(1 2 3)) => 2"
  (/ (reduce #'+ sample) (length sample)))

(defun median (sample)
  "The number in the middle of a sequence of numbers, or the mean of the two there.
  Examples:
  (alexandria:median '(3 1 2)) => 2
  (alexandria:median '(1 2)) => 3/2"
  (let* ((sorted (sort (copy-sequence 'vector sample) #'<))
         (length (length sorted))
         (middle (floor length 2)))
    (if (oddp length)
        (aref sorted middle)
        (/ (+ (aref sorted (1- middle)) (aref sorted middle)) 2))))

(defun variance (sample &key (biased t))
  "The variance of a sequence of numbers, or the unbiased estimate of it.
  Examples:
  (alexandria:variance '(1 2 3)) => 2/3
  (alexandria:variance '(1 2 3) :biased nil) => 1"
  (let ((mean (mean sample)))
    (/ (reduce #'+ sample :key (lambda (number) (expt (- number mean) 2)))
       (- (length sample) (if biased 0 1)))))

(defun standard-deviation (sample &key (biased t))
  "The square root of the variance.
  Examples:
  (alexandria:standard-deviation '(1 1)) => 0.0"
  (sqrt (variance sample :biased biased)))

(defun gaussian-random (&optional min max)
  "Two independent random numbers of the standard normal distribution, of those between `min` and `max`
  if these are given.
  Examples:
  (< -1 (alexandria:gaussian-random -1 1) 1) => T"
  (when (and min max (not (< min max)))
    (error "No number lies between ~s and ~s." min max))
  (labels ((pair ()
             ;; Marsaglia's polar method.
             (let* ((x (- (random 2d0) 1d0))
                    (y (- (random 2d0) 1d0))
                    (s (+ (* x x) (* y y))))
               (if (< 0d0 s 1d0)
                   (let ((scale (sqrt (/ (* -2d0 (log s)) s))))
                     (values (* x scale) (* y scale)))
                   (pair))))
           (one-within ()
             (let ((number (pair)))
               (if (and (or (null min) (< min number)) (or (null max) (< number max)))
                   number
                   (one-within)))))
    (if (or min max)
        (values (one-within) (one-within))
        (pair))))

;;; Counting

(defun %product (from to)
  "The product of all integers of an interval. Halves have numbers of about the same length."
  (cond ((> from to) 1)
        ((< (- to from) 8)
         (let ((product from))
           (loop for number from (1+ from) to to
                 do (setf product (* product number)))
           product))
        (t (let ((middle (floor (+ from to) 2)))
             (* (%product from middle) (%product (1+ middle) to))))))

(defun factorial (n)
  "The product of the integers from 1 to `n`.
  Examples:
  (alexandria:factorial 5) => 120"
  (check-type n (integer 0))
  (%product 1 n))

(defun count-permutations (n &optional (k n))
  "How many orders of `k` out of `n` things there are.
  Examples:
  (alexandria:count-permutations 5 2) => 20"
  (check-type n (integer 0))
  (check-type k (integer 0))
  (if (> k n) 0 (%product (1+ (- n k)) n)))

(defun binomial-coefficient (n k)
  "How many choices of `k` out of `n` things there are.
  Examples:
  (alexandria:binomial-coefficient 5 2) => 10"
  (check-type n (integer 0))
  (check-type k (integer 0))
  (if (> k n)
      0
      (let ((k (min k (- n k))))
        (/ (count-permutations n k) (factorial k)))))

(defun subfactorial (n)
  "How many orders of `n` things there are in which none is in its place.
  Examples:
  (alexandria:subfactorial 4) => 9"
  (check-type n (integer 0))
  (loop with count = 1
        for i from 1 to n
        do (setf count (+ (* i count) (if (evenp i) 1 -1)))
        finally (return count)))

;;; Places

(define-modify-macro maxf (&rest numbers) max
  "Sets a place to the largest of it and numbers.
  Examples:
  (let ((n 1)) (alexandria:maxf n 3 2) n) => 3")

(define-modify-macro minf (&rest numbers) min
  "Sets a place to the smallest of it and numbers.
  Examples:
  (let ((n 5)) (alexandria:minf n 3 4) n) => 3")

;;; What is said in the plan language itself. Evaluated when an image is made.

(define-policy timeout-policy (seconds)
  "Met when so many simulated seconds have passed."
  (:check (sleep* seconds) t))

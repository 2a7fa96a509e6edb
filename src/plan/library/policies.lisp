;;; Policies that come with the language.

(in-package :cram-language-implementation)

(define-policy timeout-policy (seconds)
  "Met when so many simulated seconds have passed."
  (:check (sleep* seconds) t))

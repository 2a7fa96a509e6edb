(in-package :pp-tut)

(defun mistaken (x)
  (no-such-function x))

(defun mistaken-too ()
  (list no-such-variable))

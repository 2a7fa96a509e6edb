;; A file for the test of Emacs.
(in-package :pp-tut)

(defun add (left right)
  (+ left right))

(defun double-add (left right)
  "Twice the sum."
  (* 2 (add left right)))

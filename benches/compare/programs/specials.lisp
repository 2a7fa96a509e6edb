;;; Special variables: bound, read and assigned across calls.

(defvar *depth* 0)
(defvar *deepest* 0)
(defvar *calls* 0)

(defun visit (n)
  (let ((*depth* (+ *depth* 1)))
    (setq *calls* (+ *calls* 1))
    (when (> *depth* *deepest*)
      (setq *deepest* *depth*))
    (when (> n 0)
      (visit (- n 1))
      (visit (- n 2)))
    *depth*))

(defun run ()
  (setq *deepest* 0)
  (setq *calls* 0)
  (list (visit 28) *deepest* *calls*))

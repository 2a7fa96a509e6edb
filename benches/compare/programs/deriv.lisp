;;; Symbolic derivatives: lists that are made by mapping.

(defun deriv (e)
  (cond ((atom e) (if (eq e 'x) 1 0))
        ((or (eq (car e) '+) (eq (car e) '-))
         (cons (car e) (mapcar #'deriv (cdr e))))
        ((eq (car e) '*)
         (list '* e (cons '+ (mapcar #'relative-deriv (cdr e)))))
        ((eq (car e) '/)
         (list '-
               (list '/ (deriv (cadr e)) (caddr e))
               (list '/ (cadr e) (list '* (caddr e) (caddr e) (deriv (caddr e))))))
        (t (error "no rule for ~S" e))))

(defun relative-deriv (e)
  (list '/ (deriv e) e))

(defun run ()
  (let ((result nil))
    (dotimes (i 60000 result)
      (setq result (deriv '(+ (* 3 x x) (* a x x) (* b x) 5))))))

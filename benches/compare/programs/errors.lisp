;;; Errors that are signalled and handled.

(defun try-often (count)
  (let ((tries 0))
    (tagbody
     again
       (handler-case (progn (incf tries) (error "again"))
         (error () (when (< tries count) (go again)))))
    tries))

(defun run () (try-often 100000))

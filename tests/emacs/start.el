;;; Starts planwright by `slime', with the configuration of docs/emacs.md.
;;;
;;; PLANWRIGHT, the program, comes from the environment.

(let ((folder (car (file-expand-wildcards "/usr/share/emacs/site-lisp/elpa-src/slime-*"))))
  (dolist (part '("" "contrib"))
    (add-to-list 'load-path (expand-file-name part folder))))
(require 'slime)
(slime-setup '(slime-fancy))
(setq slime-lisp-implementations
      `((planwright (,(getenv "PLANWRIGHT") "swank" "--stdio-init")
                    :init (lambda (file _)
                            (format "(swank:start-server %S :slime-version %S)\n"
                                    file slime-version)))))

(defvar pw-questions nil)
(defun y-or-n-p (prompt &rest _) (push prompt pw-questions) t)
(defun yes-or-no-p (prompt &rest _) (push prompt pw-questions) t)

(defun pw-wait (what predicate)
  (let ((end (+ (float-time) 60)) result)
    (while (and (not (setq result (funcall predicate))) (< (float-time) end))
      (accept-process-output nil 0.02))
    (unless result (message "FAIL %s" what) (kill-emacs 1))
    (message "ok   %s" what)))

(defun pw-repl ()
  (with-current-buffer (slime-output-buffer)
    (buffer-substring-no-properties 1 (point-max))))

(slime)
(pw-wait "M-x slime connects" (lambda () (ignore-errors (slime-output-buffer))))
(pw-wait "the prompt" (lambda () (string-match-p "CL-USER> \\'" (pw-repl))))
(switch-to-buffer (slime-output-buffer))
(goto-char (point-max))
(insert "(+ 1 2)")
(slime-repl-return)
(pw-wait "an evaluation" (lambda () (string-match-p "\n3\nCL-USER> \\'" (pw-repl))))
(pw-wait "no question was asked" (lambda () (null pw-questions)))
(let ((process (slime-inferior-process)))
  (slime-quit-lisp-internal (slime-connection) (lambda (&rest _)) nil)
  (pw-wait "the program ends with the connection" (lambda () (not (process-live-p process)))))
(kill-emacs 0)

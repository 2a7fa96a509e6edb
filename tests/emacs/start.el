;;; Starts planwright by `slime', with the configuration of docs/emacs.md.
;;;
;;; PLANWRIGHT, the program, comes from the environment.

(load (expand-file-name "driver.el" (file-name-directory load-file-name)))
(setq slime-lisp-implementations
      `((planwright (,(getenv "PLANWRIGHT") "swank" "--stdio-init")
                    :init (lambda (file _)
                            (format "(swank:start-server %S :slime-version %S)\n"
                                    file slime-version)))))

(slime)
(pw-wait-for-prompt)
(pw-check "M-x slime connects" t)
(pw-eval "(+ 1 2)" "3\nCL-USER> ")
(pw-check "no question was asked" (null pw-questions) pw-questions)
(let ((process (slime-inferior-process)))
  (slime-quit-lisp-internal (slime-connection) (lambda (&rest _)) nil)
  (pw-wait "the end of the program" (lambda () (not (process-live-p process))))
  (message "ok   the program ends with the connection"))
(kill-emacs 0)

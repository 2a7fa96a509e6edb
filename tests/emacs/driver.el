;;; Functions that use SLIME in a batch Emacs as a person would.

(load (expand-file-name "setup.el" (file-name-directory load-file-name)))

(defvar pw-questions nil "Questions that Emacs has asked; there should be none.")
(defun y-or-n-p (prompt &rest _) (push prompt pw-questions) t)
(defun yes-or-no-p (prompt &rest _) (push prompt pw-questions) t)

(defun pw-wait (what predicate &optional seconds)
  "Wait until PREDICATE holds; fail if it takes longer than SECONDS."
  (let ((end (+ (float-time) (or seconds 60))) result)
    (while (and (not (setq result (funcall predicate))) (< (float-time) end))
      (accept-process-output nil 0.02))
    (or result (pw-fail what "it did not happen in time"))))

(defun pw-fail (what why)
  (message "FAIL %s: %s" what why)
  (when (ignore-errors (slime-output-buffer))
    (message "---- the prompt's buffer:\n%s" (pw-repl)))
  (dolist (buffer (sldb-buffers))
    (message "---- a debugger:\n%s" (with-current-buffer buffer (buffer-string))))
  (kill-emacs 1))

(defun pw-check (what is-so &optional why)
  (if is-so (message "ok   %s" what) (pw-fail what (format "%s" why))))

(defun pw-repl ()
  (with-current-buffer (slime-output-buffer)
    (buffer-substring-no-properties 1 (point-max))))

(defun pw-type (text)
  "Type TEXT at the prompt, and RET."
  (switch-to-buffer (slime-output-buffer))
  (goto-char (point-max))
  (insert text)
  (slime-repl-return))

(defun pw-idle ()
  (not (slime-rex-continuations)))

(defun pw-eval (text expected)
  "Type TEXT; what appears up to the next prompt has to be EXPECTED."
  (let ((start (with-current-buffer (slime-output-buffer) (point-max))))
    (pw-type text)
    (pw-wait text #'pw-idle)
    (let* ((shown (with-current-buffer (slime-output-buffer)
                    (buffer-substring-no-properties start (point-max))))
           (shown (substring shown (length text)))
           (wanted (concat "\n" expected)))
      (pw-check text (string-prefix-p wanted shown) (format "%S instead of %S" shown wanted)))))

(defun pw-key (buffer keys)
  "Press KEYS in BUFFER."
  (switch-to-buffer buffer)
  (let ((last-command-event ?x))
    (call-interactively (key-binding (kbd keys)))))

(defun pw-debugger (what)
  (pw-wait what (lambda () (let ((buffer (car (sldb-buffers))))
                             (and buffer
                                  (with-current-buffer buffer sldb-level)
                                  buffer)))))

(defun pw-sldb-text ()
  (with-current-buffer (car (sldb-buffers))
    (buffer-substring-no-properties 1 (point-max))))

(defun pw-notes ()
  "Line, column and text of the notes in the current buffer."
  (let (found)
    (dolist (overlay (overlays-in (point-min) (point-max)))
      (when (overlay-get overlay 'slime-note)
        (save-excursion
          (goto-char (overlay-start overlay))
          (push (list (line-number-at-pos) (current-column)
                      (plist-get (overlay-get overlay 'slime-note) :message))
                found))))
    (sort found (lambda (a b) (< (car a) (car b))))))

(defun pw-connect ()
  "Connect to the server on PORT."
  (slime-connect "127.0.0.1" (string-to-number (getenv "PORT")))
  (pw-wait-for-prompt))

(defun pw-wait-for-prompt ()
  (pw-wait "connecting" (lambda () (ignore-errors (slime-output-buffer))))
  (pw-wait "the prompt" (lambda () (and (pw-idle) (string-match-p "CL-USER> \\'" (pw-repl))))))

;; In batch mode nothing keeps what the echo area would show.
(defvar pw-said nil "What was shown last in the echo area.")
(advice-add 'message :before
            (lambda (format &rest arguments)
              (when format (setq pw-said (apply #'format format arguments)))))

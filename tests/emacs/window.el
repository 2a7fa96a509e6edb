;;; SLIME in a window, connected to the server on PORT.

(let ((folder (car (file-expand-wildcards "/usr/share/emacs/site-lisp/elpa-src/slime-*"))))
  (dolist (part '("" "contrib"))
    (add-to-list 'load-path (expand-file-name part folder))))
(require 'slime)
(slime-setup '(slime-fancy))
(slime-connect "127.0.0.1" (string-to-number (getenv "PORT")))

;;; SLIME as Debian packages it, with all that it offers.

(let ((folder (car (file-expand-wildcards "/usr/share/emacs/site-lisp/elpa-src/slime-*"))))
  (dolist (part '("" "contrib"))
    (add-to-list 'load-path (expand-file-name part folder))))
(require 'slime)
(slime-setup '(slime-fancy))

;;; SLIME in a window, connected to the server on PORT.

(load (expand-file-name "setup.el" (file-name-directory load-file-name)))
(slime-connect "127.0.0.1" (string-to-number (getenv "PORT")))

;;; Types the inputs of a notebook at the prompt, one after another, and writes what Emacs shows for
;;; each as the output of its cell.
;;;
;;; PORT, NOTEBOOK and EXECUTED (the names of files) come from the environment.  What the debugger
;;; shows belongs to the output; it is left by q.

(load (expand-file-name "driver.el" (file-name-directory load-file-name)))
(require 'json)

(defconst pw-longest 300 "How many seconds an input may take.")

(defun pw-inputs (file)
  "The texts of the cells with code of a notebook."
  (let* ((json-array-type 'list)
         (cells (alist-get 'cells (json-read-file file)))
         (code (seq-filter (lambda (cell) (equal (alist-get 'cell_type cell) "code")) cells)))
    (mapcar (lambda (cell) (apply #'concat (alist-get 'source cell))) code)))

(defun pw-stop ()
  "Whether an evaluation has stopped."
  (let ((buffer (car (sldb-buffers))))
    (and buffer (with-current-buffer buffer sldb-level))))

(defun pw-report ()
  "What the debugger says about the condition, as the prompt of a terminal says it."
  (let* ((text (pw-sldb-text))
         (text (substring text 0 (string-match "\n *\\[Condition of type " text))))
    (concat (replace-regexp-in-string "^at " "; at " text) "\n")))

(defun pw-shown (text)
  "Type TEXT; what is shown for it, up to the next prompt."
  (let ((start (with-current-buffer (slime-output-buffer) (point-max)))
        (report ""))
    (pw-type text)
    (pw-wait text (lambda () (or (pw-stop) (pw-idle))) pw-longest)
    (when (pw-stop)
      (setq report (pw-report))
      (pw-key (car (sldb-buffers)) "q")
      (pw-wait "q" (lambda () (and (null (sldb-buffers)) (pw-idle)))))
    (with-current-buffer (slime-output-buffer)
      (let* ((shown (buffer-substring-no-properties
                     (+ start (length text) 1)
                     (marker-position slime-repl-prompt-start-mark)))
             (abort (string-match "^; Evaluation aborted on " shown)))
        (if abort
            (concat (substring shown 0 abort) report (substring shown abort))
          shown)))))

(defun pw-cell (text)
  "A cell with its output."
  `((cell_type . "code")
    (source . ,text)
    (outputs . [((output_type . "stream") (name . "stdout") (text . ,(pw-shown text)))])))

(pw-connect)
(let ((cells (mapcar #'pw-cell (pw-inputs (getenv "NOTEBOOK")))))
  (with-temp-file (getenv "EXECUTED")
    (insert (json-encode `((cells . ,(vconcat cells))))))
  (message "typed %d inputs" (length cells)))
(pw-check "no question was asked" (null pw-questions) pw-questions)
(kill-emacs 0)

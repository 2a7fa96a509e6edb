;;; Drives SLIME in a batch Emacs as a person would, against a planwright server.
;;;
;;; PORT, FOLDER (with pp-tut.lisp and mistakes.lisp) come from the environment.  Every check
;;; compares the text of a buffer; the first that differs ends Emacs with status 1.

(load (expand-file-name "driver.el" (file-name-directory load-file-name)))

;;; Connecting

(pw-connect)
(pw-check "no question was asked" (null pw-questions) pw-questions)

;;; The prompt

(pw-eval "(+ 1 2)" "3\nCL-USER> ")
(pw-eval "(values 1 \"two\")" "1\n\"two\"\nCL-USER> ")
(pw-eval "(values)" "; No value\nCL-USER> ")
(pw-eval "(format t \"äöü→ π 𝒳~%\")" "äöü→ π 𝒳\nNIL\nCL-USER> ")
(pw-eval "(in-package :pp-tut)" "#<PACKAGE \"CRAM-PICK-PLACE-TUTORIAL\">\nPP-TUT> ")
(pw-eval "(defun add (left right) \"Adds.\" (+ left right))" "ADD\nPP-TUT> ")
(pw-eval "(add 1\n 2)" "3\nPP-TUT> ")
(pw-eval "*" "3\nPP-TUT> ")

;; History
(with-current-buffer (slime-output-buffer)
  (goto-char (point-max))
  (slime-repl-previous-input)
  (pw-check "M-p brings back the last input"
            (equal (slime-repl-current-input) "*") (slime-repl-current-input))
  (slime-repl-delete-current-input))

;;; Help while typing

(pw-check "the arguments of a call"
          (equal (slime-eval '(swank:operator-arglist "add" "PP-TUT")) "(add left right)"))
(with-current-buffer (slime-output-buffer)
  (goto-char (point-max))
  (insert "(add 1 ")
  (let ((told (slime-eval (list (quote swank:autodoc) (list (quote quote) (slime-parse-form-upto-point 10))))))
    (pw-check "the current argument is marked"
              (equal (car told) "(add left ===> right <===)") told))
  (slime-repl-delete-current-input)
  (goto-char (point-max))
  (insert "(park-ar")
  (slime-complete-symbol*)
  (pw-check "completion" (string-match-p "(park-arm" (slime-repl-current-input))
            (slime-repl-current-input))
  (slime-repl-delete-current-input)
  (goto-char (point-max))
  (insert "(multiple-value-b")
  (slime-fuzzy-complete-symbol)
  (pw-check "fuzzy completion"
            (string-match-p "(multiple-value-bind" (slime-repl-current-input))
            (slime-repl-current-input))
  (slime-fuzzy-done)
  (slime-repl-delete-current-input))
(with-current-buffer (slime-output-buffer)
  (goto-char (point-max))
  (insert "(perform (an action (type going) (")
  (let ((told (slime-eval (list 'swank:autodoc (list 'quote (slime-parse-form-upto-point 10))))))
    (pw-check "the keys of an action"
              (equal (car told) "(an action (type going) (target …))") told))
  (slime-repl-delete-current-input))
(slime-describe-symbol "add")
(pw-wait "C-c C-d d" (lambda ()
                       (let ((buffer (get-buffer (slime-buffer-name :description))))
                         (and buffer (string-match-p
                                      "(add left right)"
                                      (with-current-buffer buffer (buffer-string)))))))
(pw-check "C-c C-d d" t)

;;; A file

(find-file (expand-file-name "pp-tut.lisp" (getenv "FOLDER")))
(pw-check "the mode of the file" (bound-and-true-p slime-mode))
(slime-compile-and-load-file)
(pw-wait "C-c C-k" #'pw-idle)
(pw-check "C-c C-k finds no mistake" (null (pw-notes)) (pw-notes))
(pw-eval "(double-add 3 4)" "14\nPP-TUT> ")
(switch-to-buffer "pp-tut.lisp")
(goto-char (point-min))
(search-forward "(+ left right)")
(replace-match "(+ left right 1)")
(slime-compile-defun)
(pw-wait "C-c C-c" #'pw-idle)
(pw-eval "(double-add 3 4)" "16\nPP-TUT> ")
(switch-to-buffer "pp-tut.lisp")
(goto-char (point-min))
(search-forward "(defun double-add")
(end-of-defun)
(insert "\n(list (double-add 1 1) :there)")
(slime-eval-last-expression)
(pw-wait "C-x C-e" #'pw-idle)
(pw-check "C-x C-e" (equal pw-said "=> (6 :THERE)") pw-said)

;; M-.
(goto-char (point-min))
(slime-edit-definition "double-add")
(pw-check "M-. finds the definition" (looking-at "(defun double-add")
          (buffer-substring (point) (min (point-max) (+ (point) 40))))
(slime-edit-definition "park-arms")
(pw-check "M-. shows what is built in" t)

;; Cross references
(pw-eval "(defvar *sum* 0)" "*SUM*\nPP-TUT> ")
(pw-eval "(defun count-up () (setf *sum* (add *sum* 1)))" "COUNT-UP\nPP-TUT> ")
(defun pw-users (kind name)
  (mapcar #'car (slime-eval (list 'swank:xref (list 'quote kind) name) "PP-TUT")))
(pw-check "who calls a function"
          (equal (pw-users :calls "add") '("COUNT-UP" "DOUBLE-ADD")) (pw-users :calls "add"))
(pw-check "whom a function calls" (equal (pw-users :callees "double-add") '("ADD")))
(pw-check "who reads and who sets a variable"
          (and (equal (pw-users :references "*sum*") '("COUNT-UP"))
               (equal (pw-users :sets "*sum*") '("COUNT-UP"))
               (null (pw-users :binds "*sum*"))))
(pw-check "who expands a macro"
          (member "(DEF-ACTION GOING)" (pw-users :macroexpands "cpl:with-failure-handling"))
          (pw-users :macroexpands "cpl:with-failure-handling"))
(switch-to-buffer "pp-tut.lisp")
(slime-who-calls "add")
(pw-wait "C-c C-w c" (lambda () (with-current-buffer (slime-buffer-name :xref)
                                  (string-match-p "DOUBLE-ADD" (buffer-string)))))
(with-current-buffer (slime-buffer-name :xref)
  (goto-char (point-min))
  (search-forward "DOUBLE-ADD")
  (slime-pop-to-location (slime-xref-location-at-point)))
(pw-check "C-c C-w c shows the call" (looking-at-p "(add left right)")
          (buffer-substring (point) (line-end-position)))

;; Traces. Emacs offers the name at the cursor, which RET takes.
(advice-add 'slime-read-from-minibuffer :override (lambda (_prompt offered &rest _) offered))
(goto-char (point-min))
(search-forward "(defun add")
(pw-key "pp-tut.lisp" "C-c C-t")
(pw-check "C-c C-t traces" (equal pw-said "ADD is now traced.") pw-said)
(pw-eval "(double-add 3 4)" "  0: (ADD 3 4)\n  0: ADD returned 8\n16\nPP-TUT> ")
(pw-key "pp-tut.lisp" "C-c C-t")
(pw-check "C-c C-t again ends that"
          (equal pw-said "ADD is no longer traced.") pw-said)
(pw-eval "(double-add 3 4)" "16\nPP-TUT> ")

;; Mistakes
(find-file (expand-file-name "mistakes.lisp" (getenv "FOLDER")))
(slime-compile-and-load-file)
(pw-wait "C-c C-k" #'pw-idle)
(pw-check "the notes stand at their places"
          (equal (mapcar (lambda (note) (list (nth 0 note) (nth 1 note))) (pw-notes))
                 '((4 3) (7 8)))
          (pw-notes))

;; Macros
(with-temp-buffer
  (lisp-mode)
  (insert "(when a b c)")
  (goto-char (point-min))
  (pw-check "macroexpansion"
            (equal (slime-eval '(swank:swank-macroexpand-1 "(when a b c)"))
                   "(if a\n    (progn b c))"))
  (slime-macroexpand-all)
  (pw-wait "C-c M-m" (lambda () (get-buffer (slime-buffer-name :macroexpansion))))
  (pw-check "C-c M-m expands all"
            (with-current-buffer (slime-buffer-name :macroexpansion)
              (string-match-p "(if a\n    (progn b c))" (buffer-string)))))

;;; The debugger

(pw-type "(defun fails (number) (let ((twice (* 2 number))) (list twice (error \"It is ~a.\" twice))))")
(pw-wait "a function" #'pw-idle)
(pw-type "(restart-case (fails 21) (use-forty-two () :report \"Use 42.\" 42))")
(pw-debugger "the debugger")
(let ((text (pw-sldb-text)))
  (pw-check "the condition is shown" (string-match-p "^It is 42\\.$" text) text)
  (pw-check "its class is shown" (string-match-p "\\[Condition of type SIMPLE-ERROR\\]" text) text)
  (pw-check "restarts are shown" (string-match-p "0: \\[USE-FORTY-TWO\\] Use 42\\." text) text)
  (pw-check "frames are shown" (string-match-p "(FAILS 21)" text) text))
(with-current-buffer (car (sldb-buffers))
  (let ((frame (with-temp-buffer (insert (pw-sldb-text))
                                 (goto-char (point-min))
                                 (re-search-forward "^ *\\([0-9]+\\): (FAILS 21)")
                                 (string-to-number (match-string 1)))))
    (let ((locals (car (slime-eval `(swank:frame-locals-and-catch-tags ,frame)))))
      (pw-check "variables of a frame"
                (equal (mapcar (lambda (l) (list (plist-get l :name) (plist-get l :value))) locals)
                       '(("NUMBER" "21") ("TWICE" "42")))
                locals))
    (pw-check "evaluation in a frame"
              (equal (slime-eval `(swank:eval-string-in-frame "(+ number twice)" ,frame "PP-TUT"))
                     "=> 63"))))
(pw-key (car (sldb-buffers)) "0")
(pw-wait "a restart" (lambda () (and (null (sldb-buffers)) (pw-idle))))
(pw-check "the restart's value is shown" (string-match-p "\n42\nPP-TUT> \\'" (pw-repl)) (pw-repl))

(pw-type "(fails 1)")
(pw-debugger "the debugger again")
(pw-key (car (sldb-buffers)) "q")
(pw-wait "q" (lambda () (and (null (sldb-buffers)) (pw-idle))))
(pw-check "q leaves" (string-match-p "; Evaluation aborted on #<SIMPLE-ERROR .*>\\.\nPP-TUT> \\'" (pw-repl))
          (pw-repl))

;; A second level, and back
(pw-type "(fails 1)")
(pw-debugger "level 1")
(pw-type "(car 5)")
(pw-wait "level 2" (lambda () (and (sldb-buffers)
                                   (with-current-buffer (car (sldb-buffers)) (eql sldb-level 2)))))
(pw-key (car (sldb-buffers)) "a")
(pw-wait "level 1 again" (lambda () (and (sldb-buffers)
                                         (with-current-buffer (car (sldb-buffers))
                                           (eql sldb-level 1)))))
(pw-key (car (sldb-buffers)) "q")
(pw-wait "the top" (lambda () (and (null (sldb-buffers)) (pw-idle))))
(pw-check "levels are left one by one" t)

;; A frame that is called again, in a new definition
(pw-type "(list :got (fails 1))")
(pw-debugger "a failure")
(pw-type "(defun fails (number) (list :mended number))")
(pw-wait "a definition there" (lambda () (string-match-p "mended number))\nFAILS\n" (pw-repl))))
(with-current-buffer (car (sldb-buffers))
  (goto-char (point-min))
  (re-search-forward "^ *[0-9]+: (FAILS 1)"))
(pw-key (car (sldb-buffers)) "r")
(pw-wait "r" (lambda () (and (null (sldb-buffers)) (pw-idle))))
(pw-check "r restarts a frame" (string-match-p "(:GOT (:MENDED 1))\n.*PP-TUT> \\'" (pw-repl)) (pw-repl))

;; Interrupts
(pw-type "(loop)")
(accept-process-output nil 0.3)
(let ((begin (float-time)))
  (slime-interrupt)
  (pw-debugger "an interrupt")
  (pw-check "C-c C-c stops at once" (< (- (float-time) begin) 0.5) (- (float-time) begin)))
(pw-check "it can be continued"
          (string-match-p "0: \\[CONTINUE\\]" (pw-sldb-text)) (pw-sldb-text))
(pw-key (car (sldb-buffers)) "q")
(pw-wait "q" (lambda () (and (null (sldb-buffers)) (pw-idle))))

;;; A value that a restart needs

(pw-type "(list unbound-here)")
(pw-debugger "an unbound variable")
(let ((number (with-temp-buffer (insert (pw-sldb-text))
                                (goto-char (point-min))
                                (re-search-forward "^ *\\([0-9]+\\): \\[USE-VALUE\\]")
                                (match-string 1))))
  (pw-key (car (sldb-buffers)) number)
  (pw-wait "a question" (lambda () (with-current-buffer (slime-output-buffer)
                                     slime-repl-read-mode)))
  (switch-to-buffer (slime-output-buffer))
  (goto-char (point-max))
  (insert "(+ 40 2)")
  (slime-repl-return)
  (pw-wait "the value" (lambda () (and (null (sldb-buffers)) (pw-idle))))
  (pw-check "the value was used" (string-match-p "(42)\nPP-TUT> \\'" (pw-repl)) (pw-repl)))

;;; A program that reads

(pw-type "(list (read-line) (read))")
(dolist (line '("first" "(1 2)"))
  (pw-wait "a question of a program" (lambda () (with-current-buffer (slime-output-buffer)
                                                  slime-repl-read-mode)))
  (switch-to-buffer (slime-output-buffer))
  (goto-char (point-max))
  (insert line)
  (slime-repl-return)
  (accept-process-output nil 0.2))
(pw-wait "what was read" #'pw-idle)
(pw-check "a program reads" (string-match-p "(\"first\" (1 2))\nPP-TUT> \\'" (pw-repl)) (pw-repl))

;;; Values that are pointed at, and the inspector

(pw-type "(list :a (list 1 2))")
(pw-wait "a list" #'pw-idle)
(slime-inspect "(list :a (list 1 2))")
(pw-wait "the inspector" (lambda () (get-buffer (slime-buffer-name :inspector))))
(with-current-buffer (slime-buffer-name :inspector)
  (pw-check "parts are shown" (string-match-p "^1: (1 2)$" (buffer-string)) (buffer-string))
  (goto-char (point-min))
  (search-forward "(1 2)\n")
  (search-backward "(1 2)")
  (slime-inspector-operate-on-point))
(pw-wait "a part" (lambda () (with-current-buffer (slime-buffer-name :inspector)
                               (string-match-p "^0: 1$" (buffer-string)))))
(pw-key (slime-buffer-name :inspector) "q")
(pw-check "the inspector" t)

;;; The robot

(pw-eval "(init-projection)" "")
(pw-type "(let ((?there (make-pose \"map\" '((-1.447 -0.15 0) (0 0 -0.7071 0.7071)))))
(with-simulated-robot (perform (an action (type going) (target (a location (pose ?there)))))))")
(pw-wait "a plan" (lambda () (or (sldb-buffers) (pw-idle))))
(pw-check "a plan" (and (null (sldb-buffers)) (string-match-p "PP-TUT> \\'" (pw-repl))) (pw-repl))
(pw-type "(with-simulated-robot (perform (an action (type detecting) (object (an object (type cup))))))")
(pw-debugger "a failure of the robot")
(pw-key (car (sldb-buffers)) "q")
(pw-wait "q" (lambda () (and (null (sldb-buffers)) (pw-idle))))

(pw-check "no question was asked" (null pw-questions) pw-questions)
(message "%s" "PASSED")
(kill-emacs 0)

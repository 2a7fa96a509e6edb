;;; Places: chapter 5.1 of the standard. SETF, INCF, PUSH and POP are written in Rust, since
;;; programs use them so often.

(in-package :common-lisp)

(defun %bindings (variables values)
  "The bindings of LET* that give variables values."
  (mapcar #'list variables values))

(defmacro pushnew (item place &rest keys &environment environment)
  "Like PUSH, unless the item is there; the keywords are those of ADJOIN.
  Examples:
  (let ((l '(2))) (pushnew 2 l) l) => (2)"
  (let ((new (gensym "ITEM"))
        (options (mapcar (lambda (key) (if (keywordp key) key (gensym "OPTION"))) keys)))
    (multiple-value-bind (temporaries values stores setter getter)
        (get-setf-expansion place environment)
      `(let* ((,new ,item)
              ,@(%bindings temporaries values)
              ,@(remove-if #'keywordp (%bindings options keys) :key #'first)
              (,(car stores) (adjoin ,new ,getter ,@options)))
         ,setter))))

(defmacro remf (place indicator &environment environment)
  "Removes a property from the property list in a place.
  Examples:
  (let ((l (list :a 1))) (remf l :a) l) => NIL"
  (multiple-value-bind (temporaries values stores setter getter)
      (get-setf-expansion place environment)
    (let ((key (gensym "KEY"))
          (found (gensym "FOUND")))
      `(let* (,@(%bindings temporaries values)
              (,key ,indicator))
         (multiple-value-bind (,(car stores) ,found) (remove-property ,getter ,key)
           ,setter
           ,found)))))

(defmacro rotatef (&rest places &environment environment)
  "Rotates the values of places to the left.
  Examples:
  (let ((a 1) (b 2)) (rotatef a b) (list a b)) => (2 1)"
  (%shift places nil t environment))

(defmacro shiftf (&rest places-and-value &environment environment)
  "Shifts the values of places to the left; the first value.
  Examples:
  (let ((a 1) (b 2)) (list (shiftf a b 3) a b)) => (1 2 3)"
  (%shift (butlast places-and-value) (car (last places-and-value)) nil environment))

(defun %shift (places incoming is-rotation environment)
  "The form of ROTATEF and SHIFTF: each place gets the value of the next one, the last the
  incoming value, or the first one's."
  (let ((bindings '()) (olds '()) (stores '()) (setters '()))
    (dolist (place places)
      (multiple-value-bind (temporaries values variables setter getter)
          (get-setf-expansion place environment)
        (let ((old (gensym "OLD")))
          (setq bindings (append bindings (%bindings temporaries values) `((,old ,getter))))
          (push old olds)
          (push variables stores)
          (push setter setters))))
    (let ((olds (reverse olds))
          (stores (reverse stores)))
      ;; A place of several values has several store variables.
      (if (every (lambda (variables) (= (length variables) 1)) stores)
          `(let* (,@bindings
                  ,@(%bindings (mapcar #'car stores)
                               (append (cdr olds) (list (if is-rotation (car olds) incoming)))))
             ,@(reverse setters)
             ,(if is-rotation nil (car olds)))
          (%shift-values places incoming is-rotation environment)))))

(defun %shift-values (places incoming is-rotation environment)
  "The form of ROTATEF and SHIFTF if some of the places have several values: lists of values are shifted."
  (let ((bindings '()) (olds '()) (setters '()))
    (dolist (place places)
      (multiple-value-bind (temporaries values variables setter getter)
          (get-setf-expansion place environment)
        (let ((old (gensym "OLD")))
          (setq bindings (append bindings
                                 (%bindings temporaries values)
                                 `((,old (multiple-value-list ,getter)))))
          (push old olds)
          (push (list variables setter) setters))))
    (setq olds (reverse olds))
    (let ((last (gensym "LAST")))
      `(let* (,@bindings
              (,last ,(if is-rotation (car olds) `(multiple-value-list ,incoming))))
         ,@(mapcar (lambda (setter list)
                     `(multiple-value-bind ,(first setter) (values-list ,list) ,(second setter)))
                   (reverse setters)
                   (append (cdr olds) (list last)))
         ,(if is-rotation nil `(values-list ,(car olds)))))))

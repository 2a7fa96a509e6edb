;;;; ALEXANDRIA: hash tables.

(in-package :alexandria)

(defmacro ensure-gethash (key table &optional default)
  "The value of a key; a key that is missing gets the default.
  Examples:
  (alexandria:ensure-gethash 'a (make-hash-table) 1) => 1 ; NIL"
  (once-only (key table)
    (with-gensyms (value found)
      `(multiple-value-bind (,value ,found) (gethash ,key ,table)
         (if ,found
             (values ,value t)
             (values (setf (gethash ,key ,table) ,default) nil))))))

(defun maphash-keys (function table)
  "Calls a function with each key of a table.
  Examples:
  (alexandria:maphash-keys #'print (make-hash-table)) => NIL"
  (maphash (lambda (key value)
             (declare (ignore value))
             (funcall function key))
           table))

(defun maphash-values (function table)
  "Calls a function with each value of a table.
  Examples:
  (alexandria:maphash-values #'print (make-hash-table)) => NIL"
  (maphash (lambda (key value)
             (declare (ignore key))
             (funcall function value))
           table))

(defun hash-table-keys (table)
  "The keys of a table.
  Examples:
  (alexandria:hash-table-keys (make-hash-table)) => NIL"
  (loop for key being the hash-keys of table
        collect key))

(defun hash-table-values (table)
  "The values of a table.
  Examples:
  (alexandria:hash-table-values (make-hash-table)) => NIL"
  (loop for value being the hash-values of table
        collect value))

(defun hash-table-alist (table)
  "The entries of a table as an association list.
  Examples:
  (alexandria:hash-table-alist (make-hash-table)) => NIL"
  (loop for key being the hash-keys of table using (hash-value value)
        collect (cons key value)))

(defun hash-table-plist (table)
  "The entries of a table as property list.
  Examples:
  (alexandria:hash-table-plist (make-hash-table)) => NIL"
  (alist-plist (hash-table-alist table)))

(defun alist-hash-table (alist &rest options)
  "A hash table of the entries of an association list; the options are those of `make-hash-table`.
  Examples:
  (gethash 'a (alexandria:alist-hash-table '((a . 1)))) => 1 ; T"
  (let ((table (apply #'make-hash-table options)))
    (dolist (entry alist table)
      (when entry
        (ensure-gethash (car entry) table (cdr entry))))))

(defun plist-hash-table (plist &rest options)
  "A hash table of the entries of a property list; the options are those of `make-hash-table`.
  Examples:
  (gethash 'a (alexandria:plist-hash-table '(a 1))) => 1 ; T"
  (apply #'alist-hash-table (plist-alist plist) options))

(defun copy-hash-table (table &key (key #'identity) (test (hash-table-test table))
                                (size (hash-table-size table))
                                (rehash-size (hash-table-rehash-size table))
                                (rehash-threshold (hash-table-rehash-threshold table)))
  "A copy of a hash table, whose values are what the key function returns for the values.
  Examples:
  (hash-table-count (alexandria:copy-hash-table (make-hash-table))) => 0"
  (let ((copy (make-hash-table :test test :size size :rehash-size rehash-size
                               :rehash-threshold rehash-threshold))
        (function (or key #'identity)))
    (maphash (lambda (key value)
               (setf (gethash key copy) (funcall function value)))
             table)
    copy))

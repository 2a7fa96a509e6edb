;;;; Trees of pairs.

(in-package :common-lisp)

(defun %replace-parts (tree find-entry in-place)
  "A tree in which parts are replaced: each one for which there is an entry, by the cdr of
the entry. The pairs are copied unless they are to be changed in place."
  (labels ((replaced (part)
             (let ((entry (funcall find-entry part)))
               (cond (entry (cdr entry))
                     ((atom part) part)
                     (t (let ((pair (if in-place part (cons nil nil))))
                          (setf (car pair) (replaced (car part))
                                (cdr pair) (replaced (cdr part)))
                          pair))))))
    (replaced tree)))

(defun %entry-if (predicate key new)
  "A function that finds an entry of `new` for parts that satisfy a predicate."
  (let ((key (or key #'identity))
        (entry (cons nil new)))
    (lambda (part)
      (and (funcall predicate (funcall key part)) entry))))

(defun %equal-to (item test test-not)
  "A predicate: does an object match the item?"
  (if test-not
      (lambda (object) (not (funcall test-not item object)))
      (let ((test (or test #'eql)))
        (lambda (object) (funcall test item object)))))

(defun subst (new old tree &key key test test-not)
  "A tree with every part that matches `old` replaced by `new`.
  Examples:
  (subst 'x 'b '(a b (b c))) => (A X (X C))"
  (subst-if new (%equal-to old test test-not) tree :key key))

(defun nsubst (new old tree &key key test test-not)
  "Like `subst`, but changes the tree.
  Examples:
  (nsubst 'x 'b (list 'a 'b)) => (A X)"
  (nsubst-if new (%equal-to old test test-not) tree :key key))

(defun subst-if (new predicate tree &key key)
  "A tree with every part that satisfies a predicate replaced.
  Examples:
  (subst-if 0 #'numberp '(a 1 (b 2))) => (A 0 (B 0))"
  (%replace-parts tree (%entry-if predicate key new) nil))

(defun subst-if-not (new predicate tree &key key)
  "A tree with every part that does not satisfy a predicate replaced.
  Examples:
  (subst-if-not 0 #'listp '(a (b))) => (0 (0))"
  (subst-if new (complement predicate) tree :key key))

(defun nsubst-if (new predicate tree &key key)
  "Like `subst-if`, but changes the tree.
  Examples:
  (nsubst-if 0 #'numberp (list 'a 1)) => (A 0)"
  (%replace-parts tree (%entry-if predicate key new) t))

(defun nsubst-if-not (new predicate tree &key key)
  "Like `subst-if-not`, but changes the tree.
  Examples:
  (nsubst-if-not 0 #'listp (list 'a)) => (0)"
  (nsubst-if new (complement predicate) tree :key key))

(defun %entry-finder (alist key test test-not)
  "A function that finds the entry of an association list whose car a part matches."
  (let ((key (or key #'identity)))
    (lambda (part)
      (let ((object (funcall key part)))
        (assoc-if (%equal-to object test test-not) alist)))))

(defun sublis (alist tree &key key test test-not)
  "A tree with every part that is a key of an association list replaced by its datum.
  Examples:
  (sublis '((a . 1) (b . 2)) '(a (b c))) => (1 (2 C))"
  (%replace-parts tree (%entry-finder alist key test test-not) nil))

(defun nsublis (alist tree &key key test test-not)
  "Like `sublis`, but changes the tree.
  Examples:
  (nsublis '((a . 1)) (list 'a 'b)) => (1 B)"
  (%replace-parts tree (%entry-finder alist key test test-not) t))

(defun tree-equal (tree-1 tree-2 &key test test-not)
  "Have two trees the same shape and matching leaves?
  Examples:
  (tree-equal '(1 (2 3)) '(1 (2 3))) => T"
  (labels ((same (part-1 part-2)
             (if (and (consp part-1) (consp part-2))
                 (and (same (car part-1) (car part-2))
                      (same (cdr part-1) (cdr part-2)))
                 (and (atom part-1)
                      (atom part-2)
                      (funcall (%equal-to part-1 test test-not) part-2)))))
    (and (same tree-1 tree-2) t)))

//! The macros of the language that have no file of their own, and the manual's entries for the
//! special operators.

use super::{compiled_macros, control_macros, define_macros, destructure, quasiquote, setf};
use crate::builtin::{Expander, Operator};

const fn special(
    name: &'static str,
    lambda_list: &'static str,
    doc: &'static str,
    examples: &'static [&'static str],
) -> Operator {
    Operator {
        name,
        lambda_list,
        doc,
        examples,
        expand: None,
    }
}

const fn macro_(
    name: &'static str,
    lambda_list: &'static str,
    doc: &'static str,
    examples: &'static [&'static str],
    expand: Expander,
) -> Operator {
    Operator {
        name,
        lambda_list,
        doc,
        examples,
        expand: Some(expand),
    }
}

/// Special operators of package `COMMON-LISP`.
pub(crate) static SPECIAL_FORMS: &[Operator] = &[
    special(
        "QUOTE",
        "object",
        "The object itself, unevaluated.",
        &["(quote (a b)) => (A B)"],
    ),
    special(
        "FUNCTION",
        "name",
        "The function of that name, or a lambda expression.",
        &["(funcall (function car) '(1 2)) => 1"],
    ),
    special(
        "PROGN",
        "&body forms",
        "Evaluates the forms in order; the values are those of the last.",
        &["(progn 1 2) => 2"],
    ),
    special(
        "LOCALLY",
        "&body body",
        "Like PROGN, with declarations.",
        &["(locally 1 2) => 2"],
    ),
    special(
        "IF",
        "test then &optional else",
        "Evaluates one of two forms.",
        &["(if (> 2 1) :yes :no) => :YES"],
    ),
    special(
        "LET",
        "bindings &body body",
        "Binds variables in parallel.",
        &["(let ((a 1) (b 2)) (+ a b)) => 3"],
    ),
    special(
        "LET*",
        "bindings &body body",
        "Binds variables one after the other.",
        &["(let* ((a 1) (b (+ a 1))) b) => 2"],
    ),
    special(
        "SETQ",
        "&rest variables-and-values",
        "Assigns variables.",
        &["(let ((a 1)) (setq a 2) a) => 2"],
    ),
    special(
        "BLOCK",
        "name &body body",
        "A body that RETURN-FROM can leave.",
        &["(block b (return-from b 1) 2) => 1"],
    ),
    special(
        "RETURN-FROM",
        "name &optional value",
        "Leaves the block of that name with the values.",
        &["(block b (return-from b 1)) => 1"],
    ),
    special(
        "TAGBODY",
        "&rest tags-and-statements",
        "Statements among which GO can jump; NIL.",
        &["(let ((i 0)) (tagbody again (incf i) (when (< i 3) (go again))) i) => 3"],
    ),
    special(
        "GO",
        "tag",
        "Jumps to a tag.",
        &["(block b (tagbody (go end) (return-from b 1) end) 2) => 2"],
    ),
    special(
        "CATCH",
        "tag &body body",
        "A body that THROW to the tag can leave.",
        &["(catch 'x (throw 'x 1) 2) => 1"],
    ),
    special(
        "THROW",
        "tag form",
        "Leaves the innermost CATCH of the tag with the values of the form.",
        &["(catch 'x (throw 'x 1)) => 1"],
    ),
    special(
        "UNWIND-PROTECT",
        "form &rest cleanup",
        "Evaluates the cleanup forms however the form is left.",
        &["(let ((x 1)) (block b (unwind-protect (return-from b) (setq x 2))) x) => 2"],
    ),
    special(
        "MULTIPLE-VALUE-CALL",
        "function &rest forms",
        "Calls a function with all values of all forms.",
        &["(multiple-value-call #'list (values 1 2) 3) => (1 2 3)"],
    ),
    special(
        "MULTIPLE-VALUE-PROG1",
        "form &rest forms",
        "All values of the first form, after the others are evaluated.",
        &["(multiple-value-prog1 (values 1 2) 3) => 1 ; 2"],
    ),
    special(
        "FLET",
        "functions &body body",
        "Local functions.",
        &["(flet ((twice (x) (* 2 x))) (twice 4)) => 8"],
    ),
    special(
        "LABELS",
        "functions &body body",
        "Local functions that may call each other and themselves.",
        &["(labels ((f (n) (if (= n 0) 1 (* n (f (1- n)))))) (f 5)) => 120"],
    ),
    special(
        "MACROLET",
        "macros &body body",
        "Local macros.",
        &["(macrolet ((twice (x) `(* 2 ,x))) (twice 4)) => 8"],
    ),
    special(
        "SYMBOL-MACROLET",
        "symbols-and-expansions &body body",
        "Symbols that stand for forms.",
        &["(let ((l (list 1 2))) (symbol-macrolet ((x (car l))) (setf x 5)) l) => (5 2)"],
    ),
    special(
        "PROGV",
        "symbols values &body body",
        "Binds special variables whose names are computed.",
        &["(progv '(*demo*) '(1) (symbol-value '*demo*)) => 1"],
    ),
    special(
        "THE",
        "type form",
        "The form; the type is a note for people.",
        &["(the fixnum 1) => 1"],
    ),
    special(
        "EVAL-WHEN",
        "situations &body body",
        "The body, if :EXECUTE or :LOAD-TOPLEVEL is among the situations.",
        &["(eval-when (:execute) 1) => 1"],
    ),
    special(
        "LOAD-TIME-VALUE",
        "form &optional read-only",
        "The value of the form, computed once.",
        &["(load-time-value (+ 1 2)) => 3"],
    ),
    special(
        "DECLARE",
        "&rest specifiers",
        "Declarations at the start of a body; SPECIAL has an effect.",
        &["(let ((x 1)) (declare (ignorable x)) 2) => 2"],
    ),
];

/// Special operators of package `SYSTEM`.
pub(crate) static SYSTEM_FORMS: &[Operator] = &[
    special(
        "NAMED-LAMBDA",
        "name lambda-list &body body",
        "A function with a name, whose body stands in a block of that name.",
        &["(funcall (system:named-lambda f (x) (return-from f x)) 1) => 1"],
    ),
    special(
        "WITHOUT-PACKAGE-LOCKS",
        "&body forms",
        "Evaluates the forms, which may redefine what is built in.",
        &["(system:without-package-locks 1) => 1"],
    ),
];

/// Macros of package `SYSTEM`.
pub(crate) static SYSTEM_OPERATORS: &[Operator] = &[
    macro_(
        "QUASIQUOTE",
        "template",
        "A template: what the reader makes of a backquote.",
        &["`(1 ,(+ 1 1) ,@(list 3 4)) => (1 2 3 4)"],
        quasiquote::expand_quasiquote,
    ),
    macro_(
        "WITH-RESTARTS",
        "list &body body",
        "Establishes a list of restart objects.",
        &["(system:with-restarts nil 1) => 1"],
        compiled_macros::with_restarts,
    ),
];

/// Macros of package `COMMON-LISP`.
pub static OPERATORS: &[Operator] = &[
    macro_(
        "LAMBDA",
        "lambda-list &body body",
        "An anonymous function.",
        &["((lambda (x) (* x x)) 3) => 9"],
        compiled_macros::lambda,
    ),
    macro_(
        "OR",
        "&rest forms",
        "The first value that is not NIL.",
        &["(or nil 2 3) => 2"],
        compiled_macros::or,
    ),
    macro_(
        "AND",
        "&rest forms",
        "NIL as soon as a form gives NIL, else the values of the last.",
        &["(and 1 2) => 2"],
        compiled_macros::and,
    ),
    macro_(
        "PROG1",
        "form &rest forms",
        "The value of the first form, after the others are evaluated.",
        &["(prog1 1 2) => 1"],
        compiled_macros::prog1,
    ),
    macro_(
        "MULTIPLE-VALUE-BIND",
        "(&rest variables) form &body body",
        "Binds variables to the values of a form.",
        &["(multiple-value-bind (q r) (floor 7 2) (list q r)) => (3 1)"],
        compiled_macros::multiple_value_bind,
    ),
    macro_(
        "HANDLER-BIND",
        "(&rest bindings) &body body",
        "Handlers that run where a condition is signalled, before anything is unwound.",
        &["(handler-bind ((warning #'muffle-warning)) (warn \"x\") 1) => 1"],
        compiled_macros::handler_bind,
    ),
    macro_(
        "COND",
        "&rest clauses",
        "The body of the first clause whose test is true.",
        &["(cond ((= 1 2) :a) (t :b)) => :B"],
        control_macros::cond,
    ),
    macro_(
        "CASE",
        "key &rest clauses",
        "The clause that names the key.",
        &["(case 2 (1 :one) ((2 3) :few) (t :many)) => :FEW"],
        control_macros::case,
    ),
    macro_(
        "ECASE",
        "key &rest clauses",
        "Like CASE; an error if no clause names the key.",
        &["(ecase 1 (1 :one)) => :ONE"],
        control_macros::ecase,
    ),
    macro_(
        "TYPECASE",
        "key &rest clauses",
        "The clause whose type the key has.",
        &["(typecase 1 (string :s) (integer :i)) => :I"],
        control_macros::typecase,
    ),
    macro_(
        "ETYPECASE",
        "key &rest clauses",
        "Like TYPECASE; an error if the key has none of the types.",
        &["(etypecase \"x\" (string :s)) => :S"],
        control_macros::etypecase,
    ),
    macro_(
        "DO",
        "bindings end-clause &body body",
        "Loops with variables that step in parallel.",
        &["(do ((i 0 (1+ i)) (s 0 (+ s i))) ((= i 4) s)) => 6"],
        control_macros::do_,
    ),
    macro_(
        "DO*",
        "bindings end-clause &body body",
        "Loops with variables that step one after the other.",
        &["(do* ((i 0 (1+ i)) (j i i)) ((= i 3) j)) => 3"],
        control_macros::do_star,
    ),
    macro_(
        "DOLIST",
        "(variable list &optional result) &body body",
        "Runs the body for each element of a list.",
        &["(let ((s 0)) (dolist (x '(1 2 3) s) (incf s x))) => 6"],
        control_macros::dolist,
    ),
    macro_(
        "DOTIMES",
        "(variable count &optional result) &body body",
        "Runs the body with the variable at 0, 1, … below count.",
        &["(let ((s 0)) (dotimes (i 4 s) (incf s i))) => 6"],
        control_macros::dotimes,
    ),
    macro_(
        "PSETQ",
        "&rest variables-and-values",
        "Assigns variables in parallel.",
        &["(let ((a 1) (b 2)) (psetq a b b a) (list a b)) => (2 1)"],
        setf::expand_psetf,
    ),
    macro_(
        "MULTIPLE-VALUE-LIST",
        "form",
        "A list of all values of a form.",
        &["(multiple-value-list (floor 7 2)) => (3 1)"],
        control_macros::multiple_value_list,
    ),
    macro_(
        "DESTRUCTURING-BIND",
        "lambda-list form &body body",
        "Binds variables to the parts of a list.",
        &[
            "(destructuring-bind (a (b &optional c) &key d) '(1 (2) :d 4) (list a b c d)) => (1 2 NIL 4)",
        ],
        destructure::expand_destructuring_bind,
    ),
    macro_(
        "SETF",
        "&rest places-and-values",
        "Sets places: variables, parts of lists, slots, …",
        &["(let ((l (list 1 2))) (setf (car l) 9) l) => (9 2)"],
        setf::expand_setf,
    ),
    macro_(
        "PSETF",
        "&rest places-and-values",
        "Sets places in parallel; NIL.",
        &["(let ((a 1) (b 2)) (psetf a b b a) (list a b)) => (2 1)"],
        setf::expand_psetf,
    ),
    macro_(
        "INCF",
        "place &optional delta",
        "Adds to a place.",
        &["(let ((x 1)) (incf x 2) x) => 3"],
        setf::expand_incf,
    ),
    macro_(
        "DECF",
        "place &optional delta",
        "Subtracts from a place.",
        &["(let ((x 1)) (decf x) x) => 0"],
        setf::expand_decf,
    ),
    macro_(
        "PUSH",
        "item place",
        "Puts an item in front of the list in a place.",
        &["(let ((l '(2))) (push 1 l) l) => (1 2)"],
        setf::expand_push,
    ),
    macro_(
        "POP",
        "place",
        "Takes the first item off the list in a place.",
        &["(let ((l '(1 2))) (list (pop l) l)) => (1 (2))"],
        setf::expand_pop,
    ),
    macro_(
        "DEFUN",
        "name lambda-list &body body",
        "Defines a function; its name.",
        &["(progn (defun twice (x) (* 2 x)) (twice 4)) => 8"],
        define_macros::defun,
    ),
    macro_(
        "DEFMACRO",
        "name lambda-list &body body",
        "Defines a macro; its name.",
        &[
            "(progn (defmacro my-unless (c &body b) `(if ,c nil (progn ,@b))) (my-unless nil 1)) => 1",
        ],
        define_macros::defmacro,
    ),
    macro_(
        "IN-PACKAGE",
        "name",
        "Makes a package the current one.",
        &["(in-package :cl-user) => #<PACKAGE \"COMMON-LISP-USER\">"],
        define_macros::in_package,
    ),
    macro_(
        "DEFPARAMETER",
        "name value &optional documentation",
        "Defines a special variable and assigns it.",
        &["(progn (defparameter *depth* 3) *depth*) => 3"],
        define_macros::defparameter,
    ),
    macro_(
        "DEFVAR",
        "name &optional value documentation",
        "Defines a special variable; keeps its value if it has one.",
        &["(progn (defvar *width* 3) (defvar *width* 4) *width*) => 3"],
        define_macros::defvar,
    ),
    macro_(
        "DEFINE-SETF-EXPANDER",
        "access-function lambda-list &body body",
        "Defines the setf expansion of a form.",
        &[
            "(define-setf-expander my-place (x) (values nil nil (list 'v) (list 'progn 'v) x)) => MY-PLACE",
        ],
        define_macros::define_setf_expander,
    ),
];

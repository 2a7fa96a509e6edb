//! Copies of sessions, in which the worlds of a sweep run.

use session::dialogue::{Evaluate, Event, Outcome};
use session::{LogLevel, Session, SessionOptions};

/// Everything that a program can define and change.
const FILE: &str = r##"
(defpackage :shop (:use :cpl) (:export #:open-shop))
(in-package :shop)
(defvar *list* (list 1 2 3))
(defvar *alias* *list*)
(defvar *circle* (let ((c (list 1 2))) (setf (cdr (last c)) c) c))
(defvar *text* (make-array 2 :element-type 'character :fill-pointer 2 :adjustable t
                             :initial-contents "ab"))
(defvar *vector* (make-array '(2 2) :initial-element 0))
(defvar *bits* (make-array 3 :element-type 'bit))
(defvar *by-text* (make-hash-table :test 'equal))
(setf (gethash "a" *by-text*) *list*)
(setf (gethash (list 1 "b") *by-text*) 2)
(defvar *by-object* (make-hash-table :test 'cl:eq))
(setf (gethash *list* *by-object*) :list)
(setf (gethash *by-object* *by-object*) :itself)
(defvar *state* (make-random-state))
(defvar *written* (make-string-output-stream))
(write-string "before" *written*)
(defvar *read* (make-string-input-stream "1 2 3 4 5 6 7 8 9"))
(defvar *passing* (gensym "P"))
(defvar *numbers* (list (expt 10 30) 1/3 #c(1 2) 1.5d0))
(defstruct point (x 0) (y 0))
(defstruct (place (:include point)) name)
(defvar *place* (make-place :x 1 :name "shop"))
(defclass thing () ((part :initform (list 1) :accessor part)
                    (count :allocation :class :initform 0 :accessor made)))
(defclass better-thing (thing) ())
(defvar *thing* (make-instance 'better-thing))
(setf (part *thing*) *thing*)
(defgeneric area (shape) (:method ((shape (cl:eql 'dot))) 0))
(defmethod area ((shape point)) (* (point-x shape) (point-y shape)))
(defmethod area :around ((shape place)) (1+ (call-next-method)))
(defmethod print-object ((thing thing) stream) (format stream "#<~a>" (made thing)))
(define-condition closed (error) ((why :initarg :why :reader why))
  (:report (lambda (c s) (format s "closed: ~a" (why c)))))
(let ((n 0)) (defun next () (incf n)) (defun last-number () n))
(labels ((even (n) (if (= n 0) t (odd (- n 1)))) (odd (n) (if (= n 0) nil (even (- n 1)))))
  (defvar *even* #'even))
(defvar *composed* (complement (constantly nil)))
(defun literal () '(1 2 (3) "four"))
(defun greeting (name &key (mark "!"))
  "Says hello."
  (labels ((say (x) (list "hello" x name mark))) #'say))
(defun (setf head) (value) (setf (first *list*) value))
(defmacro twice (form) `(progn ,form ,form))
(define-symbol-macro first-of-list (first *list*))
(deftype small () '(integer 0 9))
(defsetf cell (i) (value) `(setf (aref *vector* ,i 0) ,value))
(defun cell (i) (aref *vector* i 0))
(setf (get 'shop 'owner) (list "Ada"))
(defvar *object* (desig:an object (type bottle)))
(defvar *other* (desig:an object (type bottle) (name b1)))
(desig:equate *object* *other*)
(defvar *pose* (cl-transforms-stamped:make-pose-stamped
                 "map" 0 (cl-transforms:make-3d-vector 1 2 3) (cl-transforms:make-identity-rotation)))
(defvar *fluent* (make-fluent :name 'level :value (list 1)))
(prolog:def-fact-group shop () (prolog:<- (sells bread)))
(prolog:def-fact-group counting ()
  (prolog:<- (counted 0))
  (prolog:<- (counted ?n) (counted ?m) (lisp-fun 1+ ?m ?n)))
(defvar *proofs* (prolog:prolog '(counted ?n)))
(defvar *bread* (prolog:prolog '(or (and (sells ?x) (member ?y (1 2)) (lisp-fun list ?x ?y ?z))
                                    (== ?x *proofs*))))
(set-macro-character #\! (lambda (stream char) (declare (ignore char)) (list 'not (read stream t nil t))))
(push :shop *features*)
(defvar *shown* (princ-to-string #'next))
"##;

/// Changes all of that, and tells what it finds.
const CHANGE: &str = r##"
(in-package :shop)
(nconc (literal) (list 5))
(setf (char (fourth (literal)) 0) #\F)
(literal)
(list (greeting "Ada") (nth-value 2 (function-lambda-expression (greeting "Ada")))
      (funcall (greeting "Ada") 1) (with-output-to-string (s) (describe 'greeting s)))
(progn (setf (first (funcall (greeting "Ada") 1)) "bye") (funcall (greeting "Ada" :mark "?") 2))
(handler-case (funcall (greeting "Ada")) (error (e) (princ-to-string e)))
(list (push 0 *list*) (setf (second *alias*) :changed) *list* *alias* (eq (cdr *list*) *alias*))
(progn (setf (car *circle*) :round) (list (third *circle*) (eq (cddr *circle*) *circle*)))
(progn (vector-push-extend #\c *text*) *text*)
(progn (incf (cell 1)) *vector*)
(progn (setf (aref *bits* 1) 1) *bits*)
(list (eq (gethash "a" *by-text*) *alias*) (incf (gethash '(1 "b") *by-text*)))
(progn (setf (gethash "c" *by-text*) 3) (remhash "a" *by-text*)
       (let (keys) (maphash (lambda (k v) (push (cons k v) keys)) *by-text*) keys))
(list (gethash *alias* *by-object*) (gethash *by-object* *by-object*))
(list (random 1000 *state*) (random 1000) (random 1.0d0))
(list (progn (write-string "!" *written*) (get-output-stream-string *written*)) (read *read*))
(list (symbol-name *passing*) (gensym) (setf (symbol-value *passing*) 3) (gentemp))
*numbers*
(list (incf (place-x *place*)) (point-p *place*) (place-name *place*) (area *place*)
      (copy-structure *place*))
(list (incf (made *thing*)) *thing* (eq (part *thing*) *thing*) (typep *thing* 'thing))
(defclass thing () ((part :accessor part) (colour :initform :red :accessor colour)))
(list (colour *thing*) (eq (part *thing*) *thing*))
(defmethod area ((shape point)) 100)
(defmethod area ((shape thing)) 200)
(list (area *place*) (area *thing*) (area 'dot))
(handler-case (error 'closed :why "night") (closed (c) (princ-to-string c)))
(list (next) (next) (last-number) (funcall *even* 10) (funcall *composed*))
(defun next () :redefined)
(defmacro twice (form) `(list ,form ,form))
(list (next) (twice 1) (progn (setf first-of-list 7) *list*) (setf (head) 8) *list*)
(list (typep 5 'small) (progn (deftype small () '(integer 0 3)) (typep 5 'small)))
(list (push "Bob" (get 'shop 'owner)) (symbol-plist 'shop))
(desig:equate *other* (desig:an object (type cup)))
(list (desig:current-desig *object*) (desig:desig-equal *object* *other*))
*pose*
(progn (setf (value *fluent*) (cons 2 (value *fluent*))) (value *fluent*))
(list (cut:lazy-elt *proofs* 2) (cut:lazy-elt *bread* 1) (cut:force-ll *bread*))
(prolog:def-fact-group shop () (prolog:<- (sells milk)))
(cut:force-ll (prolog:prolog '(sells ?what)))
'!a
(set-macro-character #\! (lambda (stream char) (declare (ignore stream char)) :bang))
'!
(progn (push :changed *features*) (list (subseq *features* 0 2) #+shop 1 #+changed 2))
(list *shown* (princ-to-string #'next) (princ-to-string (lambda ()) ) (princ-to-string *even*))
(defpackage :shop (:use :cpl) (:export #:close-shop))
(defpackage :market (:use :shop))
(list (find-symbol "CLOSE-SHOP" :market) (package-name :market) (intern "NEW" :keyword))
(export (intern "MORE" :shop) :shop)
(rename-package :market :bazaar)
(apropos-list "shop")
(cpl:top-level (cpl:par (cpl:sleep 1) (cpl:sleep 2)))
(cram-language:top-level (setf *list* (list :in-a-task)))
(list *list* (cram-language:make-fluent))
(pp-tut:spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)))
(planwright:rewind)
(setf *print-base* 2 *read-base* 8 *package* (find-package :cl-user))
10
"##;

fn session() -> Session {
    let options = SessionOptions {
        log_level: LogLevel::None,
        ..SessionOptions::default()
    };
    Session::new(&options).expect("a session starts")
}

fn loaded(text: &str) -> Session {
    let mut session = session();
    let shown = shown(&mut session, text);
    assert!(!shown.contains("! "), "{shown}");
    session
}

/// All that an input shows, with what is evaluated after errors.
fn shown(session: &mut Session, text: &str) -> String {
    let mut shown = String::new();
    let outcome = session.evaluate("test", text, &mut |event| match event {
        Event::Output(text) => shown.push_str(&text),
        Event::Values(values) => shown.push_str(&format!("=> {}\n", values.join(" "))),
        Event::Aborted(abort) => shown.push_str(&format!("! {}\n", abort.report)),
        _ => {}
    });
    assert_ne!(outcome, Outcome::Stopped);
    shown
}

/// As [`shown`], line by line, so that an error ends only its line.
fn shown_by_lines(session: &mut Session, text: &str) -> Vec<String> {
    let mut pending = String::new();
    let mut all = Vec::new();
    for line in text.lines() {
        pending.push_str(line);
        pending.push('\n');
        let is_whole = pending.matches('(').count() == pending.matches(')').count();
        if is_whole {
            all.push(format!("{pending}{}", shown(session, &pending)));
            pending.clear();
        }
    }
    all
}

#[test]
fn copies_go_on_as_the_session_would_whatever_other_copies_do() {
    let loaded_once = loaded(FILE);
    let mut copies: Vec<Session> = (0..3)
        .map(|_| loaded_once.copied().expect("there can be a copy"))
        .collect();
    let mut fresh = loaded(FILE);
    let expected = shown_by_lines(&mut fresh, CHANGE);
    let failed: Vec<&String> = expected
        .iter()
        .filter(|line| line.contains("\n! "))
        .collect();
    assert!(failed.is_empty(), "{failed:#?}");
    for copy in &mut copies {
        assert_eq!(shown_by_lines(copy, CHANGE), expected);
    }
    let mut late = loaded_once.copied().expect("there can be a copy");
    drop(copies);
    assert_eq!(shown_by_lines(&mut late, CHANGE), expected);
    assert_eq!(late.world_hash(), fresh.world_hash());
    // The session itself has not noticed anything, and a copy of a copy is one of the session.
    let mut again = loaded_once
        .copied()
        .and_then(|copy| copy.copied())
        .expect("there can be a copy");
    drop(loaded_once);
    assert_eq!(shown_by_lines(&mut again, CHANGE), expected);
}

#[test]
fn a_world_of_a_sweep_is_the_same_in_a_copy() {
    let text = "(in-package :pp-tut)
        (defsweep picking (:worlds 3)
          (vary (bottle (object bottle :on table-area-main)))
          (with-injected-failures (perception-miss :probability 0.5))
          (run (with-simulated-robot
                 (perform (an action (type searching) (object (an object (type bottle)))
                                     (location (a location (on table-area-main))))))))";
    let loaded_once = loaded(text);
    for world in [1, 0, 1] {
        let run = |mut session: Session| {
            session.run_sweep_world("picking", 5, world, &[], 1_000_000, None)
        };
        let record = run(loaded_once.copied().expect("there can be a copy"));
        assert_eq!(record, run(loaded(text)));
        assert!(record.steps > 0, "{record:?}");
    }
}

#[test]
fn what_cannot_be_copied_is_told() {
    for (text, cause) in [
        (
            "(defvar *f* (open \"/dev/null\" :direction :output :if-exists :append))",
            "a file that is being written",
        ),
        (
            "(defvar *net* (cpl:fl+ (cpl:make-fluent :value 1) 2))",
            "a network of fluents",
        ),
        (
            "(defclass thing () ()) (defgeneric f (x)) (defmethod f ((x thing)) 1)
             (defvar *method* (find-method #'f nil (list (find-class 'thing))))",
            "a method that is a value",
        ),
        (
            "(defvar *f* #'identity)
             (dotimes (i 10000) (let ((f *f*)) (setf *f* (lambda (x) (funcall f x)))))",
            "functions that hold functions that hold functions",
        ),
    ] {
        let session = loaded(text);
        assert_eq!(session.copied().err(), Some(cause), "{text}");
    }
}

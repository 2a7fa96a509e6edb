//! A lesson as a web page gives it: blocks with prompts, each on one line, comments and output among
//! the code. Each block is pasted as it stands.

use super::talk::Talk;
use crate::prompt::pasted::Inputs;

/// A block, what its last value or line begins with, and how many lines are left out as output.
const LESSON: [(&str, &str, usize); 14] = [
    // A greeting, two commands on one line.
    ("CL-USER> (print \"Good morning\")", "\"Good morning\"", 0),
    (
        "CL-USER> (list :a) CL-USER> (in-package :pp-tut)",
        "#<PACKAGE",
        0,
    ),
    // Values behind the form, and the message of an error.
    (
        "PP-TUT> (let ((x 3) (y 4)) (print x) (* x y)) 3 12 PP-TUT> (list 12) The variable X is unbound.",
        "(12)",
        2,
    ),
    (
        "PP-TUT> (last '(5 6)) (6) PP-TUT> (butlast '(5 6)) (5)",
        "(5)",
        2,
    ),
    // A comment between two forms, in two parts.
    (
        "PP-TUT> (defparameter *spot* (make-pose \"map\" '((0.4 0.2 0) (0 0 0 1)))) ;; The robot's base goes there, ;; in the frame of the map. (with-simulated-robot (let ((?spot *spot*)) (perform (an action (type going) (target (a location (pose ?spot)))))))",
        "",
        0,
    ),
    // Comments in a form that runs several things at once.
    (
        "PP-TUT> (with-simulated-robot (cpl:par ;; Up with the torso, to 0.2 meters (perform (a motion (type moving-torso) (joint-angle 0.2))) ;; Out of sight (park-arms)) :done)",
        ":DONE",
        0,
    ),
    // Definitions without a prompt, with comments that are sentences and have apostrophes.
    (
        "(defun squares (numbers) ;; It's a list again. ;; Each number's square: (mapcar (lambda (n) (* n n)) ;; of all, 'tis said (remove nil numbers)))",
        "SQUARES",
        0,
    ),
    ("PP-TUT> (squares '(1 nil 3)) (1 9)", "(1 9)", 1),
    // A handler with comments at each step.
    (
        "(defun careful (object) (let ((tries 0)) (handler-case (progn ;; Try it (incf tries) (car object)) (type-error () ;; If that fails, count: ;; it's no list. (list :failed tries)))))",
        "CAREFUL",
        0,
    ),
    ("PP-TUT> (careful 5)", "(:FAILED 1)", 0),
    // Lines of a log behind a form, and a block that is nothing else.
    (
        "PP-TUT> (with-simulated-robot (park-arm :left)) [(ARMS PARK) INFO] 1550504321.279: Moving [(ARMS PARK) WARN] 1550504321.9: #<POSE \"map\" #<3D-VECTOR (1.0d0 2.0d0)>> is far.",
        "",
        1,
    ),
    (
        "PP-TUT> [(LOOK) WARN] 1292688669.674: Could not find #<A OBJECT (TYPE CUP)>. ; Evaluation aborted on #<X {1013AC5B93}>.",
        "",
        1,
    ),
    // Several definitions on one line.
    (
        "(defparameter *height* 0.15 \"in meters\") (defparameter *way* `(0.0 0.0 ,*height*)) (list *way*)",
        "((0.0 0.0 0.15))",
        0,
    ),
    (
        "PP-TUT> (init-projection) PP-TUT> (visualize-coordinates *spot* 1.0)",
        "",
        0,
    ),
];

#[test]
fn a_lesson_is_pasted_block_by_block_as_it_stands() {
    let mut talk = Talk::new();
    for (block, value, left_out) in LESSON {
        let found = Inputs::of(block);
        assert!(found.are_whole(), "{block}");
        assert_eq!(found.left_out.len(), left_out, "{block}\n{found:?}");
        assert!(found.unfinished.is_empty(), "{block}");
        let mut shown = String::new();
        for input in &found.inputs {
            shown = talk.say(input);
            let stops = shown.contains("[ABORT]");
            assert!(!stops, "{block}\n{shown}");
        }
        let last = shown.lines().last().unwrap_or_default();
        assert!(last.starts_with(value), "{block}\n{shown}");
    }
}

#[test]
fn a_lesson_in_one_piece_is_the_same_lesson() {
    let prompted: Vec<&str> = LESSON
        .iter()
        .map(|(block, _, _)| *block)
        .filter(|block| block.contains("> "))
        .collect();
    let all = prompted.join("\n");
    let each: usize = prompted
        .iter()
        .map(|block| Inputs::of(block).inputs.len())
        .sum();
    assert_eq!(Inputs::of(&all).inputs.len(), each);
}

//! The turtle: a world beside the robot's, in simulated time.

use super::{said, said_and_printed};
use session::{Session, SessionOptions};

#[test]
fn the_turtle_moves_while_time_passes_and_only_then() {
    let mut session = Session::new(&SessionOptions::default()).expect("a session starts");
    said(
        &mut session,
        "(in-package :roslisp)
         (defvar *poses* 0)
         (defun drive (speed turning)
           (publish (advertise \"/turtle1/cmd_vel\" \"geometry_msgs/Twist\")
                    (make-message \"geometry_msgs/Twist\" (:x :linear) speed (:z :angular) turning)))
         (defun place () (mapcar (lambda (x) (/ (round (* x 100)) 100.0)) (turtlesim:turtle-pose)))",
    );
    for (form, shown) in [
        ("(progn (drive 1 0) (place))", "(5.54 5.54 0.0)"),
        // A velocity holds for a second.
        ("(progn (wait-duration 0.5) (place))", "(6.04 5.54 0.0)"),
        ("(progn (wait-duration 5) (place))", "(6.54 5.54 0.0)"),
        // While a plan waits for a fluent that only the turtle can change, time passes.
        (
            "(let ((pose (cpl:make-fluent)))
               (subscribe \"turtle1/pose\" \"turtlesim/Pose\" (lambda (m) (setf (cpl:value pose) m)))
               (drive 1 0)
               (cpl:top-level
                 (cpl:wait-for (cpl:fl-funcall (lambda (m) (with-fields (x) m (> x 7))) pose)))
               (place))",
            "(7.0 5.54 0.0)",
        ),
        // It stands still by then, and nobody else will change the fluent.
        (
            "(progn
               (wait-duration 2)
               (handler-case (cpl:top-level (cpl:wait-for (cpl:make-fluent)))
                 (error () :deadlock)))",
            ":DEADLOCK",
        ),
    ] {
        assert_eq!(said(&mut session, form), shown, "{form}");
    }
    let wall = said_and_printed(
        &mut session,
        "(progn (drive 9 0) (wait-duration 2) (place))",
    );
    assert!(wall.contains("Oh no! I hit the wall!"), "{wall}");
    assert!(wall.ends_with("(11.09 5.54 0.0)"), "{wall}");
    // An error in a callback is told, and the turtle goes on.
    let told = said_and_printed(
        &mut session,
        "(progn (subscribe \"turtle1/pose\" \"\" (lambda (m) (with-fields (x) m (when (> 9 x) (error \"Too far.\")))))
                (drive -9 0) (wait-duration 1) (place))",
    );
    assert!(
        told.contains("A callback of the topic turtle1/pose has failed: Too far."),
        "{told}"
    );
    let wrong = said(&mut session, "(drive :fast 0)");
    assert!(wrong.contains("a number is wanted"), "{wrong}");
}

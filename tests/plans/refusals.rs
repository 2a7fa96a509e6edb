//! Goals that are none: refused with a reason, or taken with a warning; never bent silently.

use super::cook::Cook;

fn go(pose: &str) -> String {
    format!(
        "(let ((?p (make-pose {pose}))) (perform (an action (type going) (target (a location (pose ?p))))))"
    )
}

#[test]
fn the_robot_does_not_leave_the_map() {
    let mut cook = Cook::new();
    cook.done("(with-simulated-robot (park-arms))");
    for place in ["100 0 0", "1e9 0 0", "0 -3.1 0", "-5 0 0", "0 4.2 0"] {
        let report = cook.fails(
            "NAVIGATION-POSE-UNREACHABLE",
            &go(&format!("\"map\" '(({place}) (0 0 0 1))")),
        );
        assert!(
            report.contains("beyond the map, which covers x -4.95 to 2.95, y -3.03 to 4.15"),
            "{report}"
        );
        let free = cook.done(&format!("(base-pose-free-p '(({place}) (0 0 0 1)))"));
        assert_eq!(free, "NIL\n");
    }
    let stands = cook.done("(get-robot-transformation)");
    assert!(stands.contains("((0.00000 0.00000 0.00000)"), "{stands}");
}

#[test]
fn an_unknown_frame_of_a_goal_is_an_error_that_suggests_one() {
    let mut cook = Cook::new();
    let report = cook.fails("SIMPLE-ERROR", &go("\"mapp\" '((0.3 0 0) (0 0 0 1))"));
    assert_eq!(report, "There is no frame \"mapp\"; did you mean \"map\"?");
    let spawn = "(spawn-object (make-pose \"fridge_aera\" '((0 0 1) (0 0 0 1))))";
    let report = cook.fails("SIMPLE-ERROR", spawn);
    assert_eq!(
        report,
        "There is no frame \"fridge_aera\"; did you mean \"fridge_area\"?"
    );
}

#[test]
fn what_a_drive_ignores_of_its_goal_is_logged() {
    let mut cook = Cook::new();
    let ignored = |cook: &mut Cook, pose: &str| {
        let said = cook.done(&format!("(with-simulated-robot {})", go(pose)));
        said.lines()
            .find(|l| l.contains("PICK-AND-PLACE GO) WARN"))
            .map(str::to_owned)
    };
    assert_eq!(
        ignored(&mut cook, "\"map\" '((0.1 0 0.005) (0 0 0 1))"),
        None
    );
    let high = ignored(&mut cook, "\"map\" '((0.1 0 0.5) (0 0 0 1))").unwrap();
    assert!(
        high.ends_with("Of the goal is ignored its height z 0.5 m."),
        "{high}"
    );
    let tilted = ignored(&mut cook, "\"map\" '((0.1 0 0) (0.1 0 0 0.995))").unwrap();
    assert!(tilted.ends_with("its tilt."), "{tilted}");
    let frame = ignored(&mut cook, "\"base_footprint\" '((0.2 0 0) (0 0 0 1))").unwrap();
    assert!(frame.contains("\"base_footprint\""), "{frame}");
}

#[test]
fn a_quaternion_that_is_no_rotation_is_refused_wherever_it_is_used() {
    let mut cook = Cook::new();
    let zero = "\"map\" '((0.3 0 0.8) (0 0 0 0))";
    let look = format!(
        "(let ((?p (make-pose {zero}))) (perform (an action (type looking) (target (a location (pose ?p))))))"
    );
    for text in [
        go(zero),
        look,
        "(spawn-object '((0.5 0 0.8) (0 0 0 0)))".to_owned(),
        "(btr-utils:move-robot '((0.5 0 0) (0 0 0 0)))".to_owned(),
    ] {
        let report = cook.fails("SIMPLE-ERROR", &text);
        assert!(
            report.contains("(0 0 0 0), which is no rotation"),
            "{text}: {report}"
        );
    }
    assert_eq!(cook.done("(btr-utils:object-exists 'bottle-1)"), "NIL\n");
}

#[test]
fn nothing_is_put_beyond_the_world() {
    let mut cook = Cook::new();
    for place in ["1e9 0 1", "0 -30 1", "0 0 1e6", "5 5 -30"] {
        let report = cook.fails(
            "SIMPLE-ERROR",
            &format!("(spawn-object '(({place}) (0 0 0 1)))"),
        );
        assert!(
            report.contains("the world ends 10 m from the map"),
            "{report}"
        );
    }
    let report = cook.fails(
        "SIMPLE-ERROR",
        "(btr-utils:move-robot '((1e9 0 0) (0 0 0 1)))",
    );
    assert!(report.starts_with("the robot cannot be at"), "{report}");
    assert_eq!(cook.done("(btr-utils:object-exists 'bottle-1)"), "NIL\n");
}

#[test]
fn an_object_does_not_change_its_type_but_its_colour_and_mass() {
    let mut cook = Cook::new();
    cook.done("(spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)))");
    let report = cook.fails(
        "SIMPLE-ERROR",
        "(spawn-object '((-1.2 -0.9 0.82) (0 0 0 1)) :cup 'bottle-1)",
    );
    assert_eq!(
        report,
        "BOTTLE-1 is a bottle, and does not become a cup: remove it first, or choose another name."
    );
    assert!((cook.pose("BOTTLE-1").translation.x + 1.6).abs() < 0.01);
    cook.done(
        "(btr-utils:spawn-object 'bottle-1 :bottle :pose '((-1.2 -0.9 0.82) (0 0 0 1))
                                 :color '(0 0 1) :mass 1.5)",
    );
    let world = cook.session.simulation().world();
    let bottle = world.object("BOTTLE-1").unwrap();
    assert_eq!(bottle.color(), [0.0, 0.0, 1.0, 1.0]);
    assert_eq!(bottle.mass(), 1.5);
    let weight = world.support_force("BOTTLE-1").unwrap();
    assert!((weight - 1.5 * 9.81).abs() < 0.3, "{weight} N");
}

#[test]
fn a_target_to_which_no_way_leads_is_given_up_earlier_than_one_that_is_no_good() {
    let mut cook = Cook::new();
    cook.done(
        "(in-package :fd-plans)
         (defparameter *class* 'object-undeliverable)
         (defparameter *tried* '())
         (system:without-package-locks
           (defun deliver-to (object place stand action most-stands)
             (declare (ignore object stand action most-stands))
             (push (cl-tf:x (cl-tf:origin (desig:reference place))) *tried*)
             (cpl:fail *class* :description \"as the test wants it\")))",
    );
    let deliver = |class: &str| {
        format!(
            "(let* ((?poses (loop for i below 20
                      collect (cl-tf:make-pose-stamped \"map\" 0.0
                                (cl-tf:make-3d-vector (/ i 10) 0 0)
                                (cl-tf:make-identity-rotation))))
                    (?target (a location (poses ?poses))))
               (setf *class* '{class} *tried* '())
               (handler-case (deliver-to-one-of ?target (an object (type bottle)) nil nil)
                 (delivering-failed () (princ (length (remove-duplicates *tried*))))))"
        )
    };
    let count = |said: String| said.lines().last().unwrap_or_default().to_owned();
    assert!(count(cook.done(&deliver("object-undeliverable"))).starts_with("13"));
    assert!(count(cook.done(&deliver("no-way-to-target"))).starts_with("3"));
    assert!(count(cook.done(&deliver("no-stand-for-target"))).starts_with("4"));
}

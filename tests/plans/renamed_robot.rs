//! Robots whose links and joints are called differently from the built-in one's.

use descriptions::{PR2_DESCRIPTION, PR2_URDF};
use session::dialogue::{Evaluate, Event, Outcome};
use session::{Session, SessionOptions};

fn renamed(text: &str) -> String {
    text.replace("torso_lift_link", "spine")
        .replace("head_pan_joint", "neck_joint")
}

fn options(description: Option<String>) -> SessionOptions {
    SessionOptions {
        robot: Some(("my.urdf".to_owned(), renamed(PR2_URDF))),
        robot_description: description.map(|text| ("my.sexp".to_owned(), text)),
        ..SessionOptions::default()
    }
}

fn refusal(description: Option<String>) -> String {
    match Session::new(&options(description)) {
        Ok(_) => panic!("the robot was accepted"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn a_robot_without_its_description_is_told_what_it_lacks() {
    assert_eq!(
        refusal(None),
        "my.urdf lacks the link torso_lift_link and the joint head_pan_joint, which the built-in \
         description of the PR2 names: say with --robot-description FILE which links and joints \
         are the base, the torso lift, the neck, a camera, two arms of seven joints and their \
         grippers"
    );
}

#[test]
fn a_description_is_told_where_it_is_wrong() {
    assert_eq!(
        refusal(Some(PR2_DESCRIPTION.to_owned())),
        "my.sexp:14:14: there is no link named torso_lift_link"
    );
    let typo = renamed(PR2_DESCRIPTION).replace(":body base_link", ":body base_lnk");
    assert_eq!(
        refusal(Some(typo)),
        "my.sexp:9:13: there is no link named base_lnk; did you mean base_link?"
    );
    let typo = renamed(PR2_DESCRIPTION).replace("(neck ", "(neek ");
    assert_eq!(
        refusal(Some(typo)),
        "my.sexp:17:1: there is no record named neek; did you mean neck?"
    );
    let none = refusal(Some(String::new()));
    assert_eq!(none, "my.sexp:1:1: the file has no (robot …); add one");
}

#[test]
fn a_robot_with_other_names_moves() {
    let description = renamed(PR2_DESCRIPTION);
    let mut session = Session::new(&options(Some(description))).unwrap();
    let mut printed = String::new();
    let mut sink = |event: Event| match event {
        Event::Values(values) => printed.push_str(&values.join(" ")),
        Event::Aborted(abort) => printed.push_str(&abort.report),
        _ => {}
    };
    let form = "(in-package :pp-tut)
                (with-simulated-robot
                  (perform (a motion (type moving-torso) (joint-angle 0.2d0)))
                  (perform (a motion (type looking) (direction down))))";
    let outcome = session.evaluate("test", form, &mut sink);
    assert_eq!(outcome, Outcome::Finished, "{printed}");
    let world = session.simulation().world();
    let joints = &world.robot_configuration().joints;
    let torso = joints.get(world.models().description.torso.joint);
    assert!((torso - 0.2).abs() < 1e-9, "{torso}");
}

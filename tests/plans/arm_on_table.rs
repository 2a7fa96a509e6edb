//! Arms that stand on a table: robots whose base does not drive, and whose camera stands beside them.

use std::fmt::Write;

use super::cook::Cook;
use session::SessionOptions;
use spatial::pose::{distance_between, from_xyz_rpy};

/// An arm of cylinders with joints about these axes, each so far (m) above the one before, and a gripper of
/// three boxes.
fn urdf(joints: &[(&str, f64)]) -> String {
    let mut text = String::from("<robot name=\"table-arm\">\n<link name=\"foot\">");
    let body = |radius: f64, length: f64| {
        let shape = format!(
            "<origin xyz=\"0 0 {}\"/><geometry><cylinder radius=\"{radius}\" length=\"{length}\"/></geometry>",
            length / 2.0
        );
        format!("<visual>{shape}</visual><collision>{shape}</collision>")
    };
    let cuboid = |y: f64, z: f64, size: &str| {
        let shape =
            format!("<origin xyz=\"0 {y} {z}\"/><geometry><box size=\"{size}\"/></geometry>");
        format!("<visual>{shape}</visual><collision>{shape}</collision>")
    };
    let first = joints[0].1;
    let _ = writeln!(text, "{}</link>", body(0.08, first - 0.01));
    let mut parent = "foot".to_owned();
    for (i, (axis, offset)) in joints.iter().enumerate() {
        let next = joints.get(i + 1).map_or(0.06, |(_, next)| *next);
        let (xyz, limit) = match *axis {
            "z" => ("0 0 1", 2.9),
            _ => ("0 1 0", 2.1),
        };
        let _ = writeln!(
            text,
            "<link name=\"part_{i}\">{}</link>
             <joint name=\"joint_{i}\" type=\"revolute\"><parent link=\"{parent}\"/><child link=\"part_{i}\"/>
             <origin xyz=\"0 0 {offset}\"/><axis xyz=\"{xyz}\"/>
             <limit lower=\"-{limit}\" upper=\"{limit}\" velocity=\"2\" effort=\"80\"/></joint>",
            body(0.04, next - 0.01)
        );
        parent = format!("part_{i}");
    }
    let _ = writeln!(
        text,
        "<link name=\"palm\">{}</link>
         <joint name=\"palm_joint\" type=\"fixed\"><parent link=\"{parent}\"/><child link=\"palm\"/>
         <origin xyz=\"0 0 0.06\"/></joint>",
        cuboid(0.0, 0.02, "0.05 0.13 0.04")
    );
    for (name, sign) in [("left", 1.0), ("right", -1.0)] {
        let _ = writeln!(
            text,
            "<link name=\"{name}_finger\">{}</link>
             <joint name=\"{name}_joint\" type=\"prismatic\"><parent link=\"palm\"/><child link=\"{name}_finger\"/>
             <origin xyz=\"0 0 0.04\"/><axis xyz=\"0 {sign} 0\"/>
             <limit lower=\"0\" upper=\"0.05\" velocity=\"0.1\" effort=\"60\"/></joint>",
            cuboid(0.005 * sign, 0.03, "0.024 0.01 0.06")
        );
    }
    text + "</robot>\n"
}

/// Where its foot stands: on the table of the kitchen.
const START: &str = ":start ((-1.95 -1.05 0.72) (0 0 0 1))";

/// A session with such an arm, described as describe-robot does it, with what that says is missing.
fn with_arm(joints: &[(&str, f64)]) -> SessionOptions {
    let mut options = SessionOptions {
        robot: Some(("arm.urdf".to_owned(), urdf(joints))),
        ..SessionOptions::default()
    };
    let derived = options.derived_description().unwrap();
    let placed = derived.replace(":start ((0 0 0) (0 0 0 1))", START);
    assert_ne!(placed, derived, "{derived}");
    let seeing = placed.replace("; (camera beside", "(camera beside");
    assert_ne!(seeing, placed, "{placed}");
    options.robot_description = Some(("arm.sexp".to_owned(), seeing));
    options
}

const SIX: [(&str, f64); 6] = [
    ("z", 0.15),
    ("y", 0.15),
    ("y", 0.4),
    ("z", 0.2),
    ("y", 0.2),
    ("z", 0.1),
];
const SEVEN: [(&str, f64); 7] = [
    ("z", 0.15),
    ("y", 0.15),
    ("z", 0.2),
    ("y", 0.2),
    ("z", 0.2),
    ("y", 0.2),
    ("z", 0.1),
];

/// Brings a thing from one place on the table to another.
fn bring(kind: &str, height: f64, [x, y]: [f64; 2]) -> String {
    format!(
        "(btr-utils:spawn-object 'thing :{kind} :pose '((-1.5 -0.85 {height}) (0 0 0 1)))
         (with-simulated-robot
           (let ((?spot (make-pose \"map\" '(({x} {y} {height}) (0 0 0 1)))))
             (perform (an action (type transporting) (object (an object (type {kind})))
                                 (target (a location (pose ?spot)))))))"
    )
}

fn brings(joints: &[(&str, f64)], kind: &str, height: f64) {
    let mut cook = Cook::watched_with(&with_arm(joints));
    let before = cook.session.simulation().world().robot_configuration().base;
    cook.done(&bring(kind, height, [-1.55, -1.3]));
    let there = from_xyz_rpy([-1.55, -1.3, height], [0.0; 3]);
    let away = distance_between(&cook.pose("THING"), &there);
    assert!(away < 0.02, "{kind}: {away}");
    let after = cook.session.simulation().world().robot_configuration().base;
    assert_eq!(before, after);
    assert_eq!(after.translation.z, 0.72);
    cook.assert_no_overlap();
}

#[test]
fn an_arm_of_six_joints_brings_a_bottle_on_its_table() {
    brings(&SIX, "bottle", 0.82);
}

#[test]
fn an_arm_of_seven_joints_brings_a_bottle_on_its_table() {
    brings(&SEVEN, "bottle", 0.82);
}

#[test]
fn an_arm_of_seven_joints_brings_a_cup_on_its_table() {
    brings(&SEVEN, "cup", 0.77);
}

#[test]
fn what_is_beyond_reach_is_refused_because_the_base_does_not_move() {
    let mut cook = Cook::with(&with_arm(&SEVEN));
    let refused = |said: Result<String, (String, String)>| match said {
        Err((report, _)) => report,
        Ok(said) => panic!("{said}"),
    };
    let report = refused(cook.say(&bring("bottle", 0.82, [-0.65, -1.3])));
    assert!(report.contains("base does not move"), "{report}");
    let far = "(btr-utils:move-object 'thing '((-0.7 -0.8 0.82) (0 0 0 1)))
         (with-simulated-robot
           (let ((?spot (make-pose \"map\" '((-1.5 -1.3 0.82) (0 0 0 1)))))
             (perform (an action (type transporting) (object (an object (type bottle)))
                                 (target (a location (pose ?spot)))))))";
    let report = refused(cook.say(far));
    assert!(report.contains("base does not move"), "{report}");
}

#[test]
fn a_base_that_drives_starts_on_the_floor() {
    let mut options = with_arm(&SIX);
    let Some((_, text)) = &mut options.robot_description else {
        panic!("it has a description");
    };
    *text = text.replace(":drive fixed", ":drive omnidirectional");
    let error = session::Session::new(&options).err().unwrap().to_string();
    assert!(error.contains("a pose on the floor, with z 0"), "{error}");
}

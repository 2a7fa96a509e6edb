//! Descriptions that are derived from a URDF are read as they are.

use crate::robot::{DerivedRobot, KinematicTree, PostureSample, RobotDescription, Srdf};
use crate::world::self_touching::SelfTouching;
use descriptions::{FETCH_URDF, PR2_URDF};

#[test]
fn derived_descriptions_are_read_and_say_what_the_robot_is() {
    let cases = [
        (
            FETCH_URDF,
            1,
            "differential",
            "torso_lift_joint",
            "-0.6 to 99.4 mm",
        ),
        (
            PR2_URDF,
            2,
            "omnidirectional",
            "torso_lift_joint",
            "-1.7 to 92.1 mm",
        ),
    ];
    for (urdf, arms, drive, torso, gap) in cases {
        let tree = KinematicTree::from_urdf(urdf, "robot.urdf").expect("the robot is right");
        let sample = PostureSample {
            count: 1000,
            seed: 0,
        };
        let robot = DerivedRobot::of(&tree, &SelfTouching::new(&tree, sample), &Srdf::default());
        let text = robot.text(&tree);
        assert_eq!(robot.arms.len(), arms);
        assert_eq!(
            robot.torso.map(|joint| tree.joint(joint).name.as_str()),
            Some(torso)
        );
        assert_eq!(robot.neck.len(), 2);
        assert!(text.contains(&format!(":drive {drive}")), "{text}");
        assert!(text.contains(gap), "{text}");
        RobotDescription::from_sexp(&text, "derived.sexp", &tree).expect("it is read");
    }
}

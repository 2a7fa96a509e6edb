//! Descriptions that are derived from a URDF are read as they are.

use crate::robot::JointPositions;
use crate::robot::{DerivedRobot, KinematicTree, PostureSample, RobotDescription, Srdf};
use crate::world::self_touching::SelfTouching;
use crate::world::self_touching::touching_links;
use descriptions::{FETCH_URDF, PR2_URDF};
use spatial::Pose;

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

fn derived(urdf: &str, srdf: &Srdf) -> (KinematicTree, DerivedRobot) {
    let tree = KinematicTree::from_urdf(urdf, "robot.urdf").expect("the robot is right");
    let sample = PostureSample {
        count: 500,
        seed: 0,
    };
    let robot = DerivedRobot::of(&tree, &SelfTouching::new(&tree, sample), srdf);
    (tree, robot)
}

#[test]
fn a_parked_arm_is_clear_of_floor_and_base_at_every_height_of_the_torso() {
    // A torso that goes down by 0.25 m more: what is clear at the start is in the floor there.
    let urdf = FETCH_URDF.replace(
        "<limit lower=\"0\" upper=\"0.38615\"",
        "<limit lower=\"-0.25\" upper=\"0.38615\"",
    );
    assert_ne!(urdf, FETCH_URDF);
    let (tree, robot) = derived(&urdf, &Srdf::default());
    let arm = robot.arms.first().expect("it has one");
    let park = arm.park.as_ref().expect("there is a posture");
    let torso = robot.torso.expect("it has one");
    let at = |height: f64| {
        let mut q: JointPositions = tree.zero_positions();
        q.set(torso, height);
        for (joint, position) in arm.joints.iter().zip(park) {
            q.set(*joint, *position);
        }
        q
    };
    let mut poses = Vec::new();
    tree.forward_kinematics(&Pose::identity(), &at(-0.25), &mut poses);
    for joint in arm.joints.iter().skip(1) {
        let link = tree.joint(*joint).child;
        assert!(poses[link.index()].translation.z > 0.03);
    }
    let is_built = |a, b| {
        let mut groups = robot.touching.iter();
        groups.any(|group| group.contains(&a) && group.contains(&b))
    };
    let first = tree.joint(arm.joints[0]).child;
    let rolls = |link| robot.wheels.links.contains(&link);
    for height in [-0.25, 0.0, 0.38] {
        for (a, b) in touching_links(&tree, &at(height)) {
            // What else of the robot touches is no fault of the posture.
            if ![a, b].iter().any(|link| tree.carries(first, *link)) {
                continue;
            }
            let (one, other) = (&tree.link(a).name, &tree.link(b).name);
            assert!(
                is_built(a, b) || rolls(a) || rolls(b),
                "{one} {other} at {height}"
            );
        }
    }
}

#[test]
fn near_links_that_never_touch_by_an_srdf_touch_only_by_their_shapes() {
    let pair = |a: &str, b: &str| (a.to_owned(), b.to_owned());
    let srdf = Srdf {
        never: vec![
            pair("elbow_flex_link", "shoulder_lift_link"),
            pair("elbow_flex_link", "base_link"),
        ],
        ..Srdf::default()
    };
    let (tree, robot) = derived(FETCH_URDF, &srdf);
    let exempt = |a: &str, b: &str| {
        let [a, b] = [a, b].map(|name| tree.link_named(name).expect("it is there"));
        let mut groups = robot.touching.iter();
        groups.any(|group| group.contains(&a) && group.contains(&b))
    };
    assert!(exempt("elbow_flex_link", "shoulder_lift_link"));
    // Five joints are too many for random postures.
    assert!(!exempt("elbow_flex_link", "base_link"));
}

//! The whole way of a bottle from the table to the island, with the robot starting tucked at
//! the origin; nothing may ever overlap by more than 2 mm.

use super::fixture::{Kitchen, Outcome};
use crate::motion::jobs::detect::Detect;
use crate::motion::{CollisionMode, DetectQuery, Look, LookTarget, MotionOutcome, TcpPath};
use crate::robot::Side;
use crate::world::grasp_library::{GraspDefinition, Lift};
use spatial::Pose;
use spatial::pose::{from_xyz_rpy, yaw};

/// Drives to the table, raises the torso and parks the arms, all at once.
fn approach_table(kitchen: &mut Kitchen) {
    let (mut drive, mut torso, mut park) = (
        kitchen.drive(-1.447, -0.15, -90.0),
        kitchen.torso(0.3),
        kitchen.park(true, true),
    );
    for end in kitchen.run(&mut [&mut drive, &mut torso, &mut park]) {
        assert_eq!(end, Ok(MotionOutcome::Arrived));
    }
}

fn look_and_detect(kitchen: &mut Kitchen) -> Pose {
    let down = LookTarget::InBase(from_xyz_rpy([0.65335, 0.076, 0.758], [0.0; 3]));
    assert_eq!(kitchen.run_one(Look::new(down)), Ok(MotionOutcome::Arrived));
    let query = DetectQuery {
        name: None,
        types: vec!["bottle".to_owned()],
        description: "a bottle".to_owned(),
    };
    match kitchen.run_one(Detect::new(query)) {
        Ok(MotionOutcome::Detected(seen)) => seen[0].pose_in_base,
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_bottle_is_carried_from_the_table_to_the_island() {
    let mut kitchen = Kitchen::new();
    kitchen.spawn_bottle(-1.6, -0.9, 0.82);
    approach_table(&mut kitchen);
    let bottle = look_and_detect(&mut kitchen);
    let gripped = kitchen
        .pick(Side::Right, "left-side", "bottle-1", &bottle)
        .unwrap_or_else(|f| panic!("{f}"));
    assert_eq!(
        gripped,
        MotionOutcome::Gripped {
            object: "bottle-1".to_owned()
        }
    );
    let park = kitchen.park(false, true);
    kitchen.run_one(park).unwrap_or_else(|f| panic!("{f}"));
    let drive = kitchen.drive(-0.15, 2.0, 180.0);
    kitchen.run_one(drive).unwrap_or_else(|f| panic!("{f}"));

    let target = kitchen.world.robot_configuration().base.inverse()
        * from_xyz_rpy([-0.8, 2.0, 0.9], [0.0; 3]);
    let put = kitchen
        .place(Side::Right, "left-side", &target)
        .unwrap_or_else(|f| panic!("{f}"));
    assert!(
        matches!(
            put,
            MotionOutcome::Put {
                support: Some(_),
                ..
            }
        ),
        "{put:?}"
    );
    let park = kitchen.park(false, true);
    kitchen.run_one(park).unwrap_or_else(|f| panic!("{f}"));

    assert!(kitchen.world.settle(2.0));
    let pose = kitchen.world.object_pose("bottle-1").unwrap();
    let t = pose.translation;
    eprintln!("bottle at {t}, yaw {}", yaw(&pose));
    assert!((t.x + 0.8).hypot(t.y - 2.0) < 0.02, "{t}");
    let up = (pose * nalgebra::Vector3::z())
        .z
        .min(1.0)
        .acos()
        .to_degrees();
    assert!(up < 3.0, "tilted by {up} degrees");
}

#[test]
fn a_bottle_near_the_robot_is_only_reached_from_behind_with_the_torso_lowered() {
    let mut kitchen = Kitchen::new();
    kitchen.spawn_bottle(-1.0, -0.75, 0.86);
    approach_table(&mut kitchen);
    let bottle = look_and_detect(&mut kitchen);
    for grasp in ["left-side", "right-side", "front"] {
        let end: Outcome = kitchen.pick(Side::Right, grasp, "bottle-1", &bottle);
        let failure = end.unwrap_err();
        assert_eq!(
            failure.class_name(),
            "MANIPULATION-POSE-UNREACHABLE",
            "{failure}"
        );
        eprintln!("{failure}");
    }
    let end = kitchen.pick(Side::Right, "back", "bottle-1", &bottle);
    assert_eq!(
        end.unwrap_or_else(|f| panic!("{f}")),
        MotionOutcome::Gripped {
            object: "bottle-1".to_owned()
        }
    );
    let world = &kitchen.world;
    let torso = world.models().description.torso.clone();
    let torso = torso.height(&world.robot_configuration().joints);
    assert!(torso < 0.225, "{torso}");
}

#[test]
fn the_same_motions_end_with_the_same_bits() {
    let hash = || {
        let mut kitchen = Kitchen::new();
        kitchen.checked = false;
        kitchen.spawn_bottle(-1.6, -0.9, 0.82);
        approach_table(&mut kitchen);
        let bottle = look_and_detect(&mut kitchen);
        kitchen
            .pick(Side::Right, "left-side", "bottle-1", &bottle)
            .unwrap();
        kitchen.world.hash()
    };
    assert_eq!(hash(), hash());
}

/// The tutorial's grasp from the front left: its second pregrasp is the grasp itself.
fn diagonal() -> GraspDefinition {
    let s = std::f64::consts::FRAC_1_SQRT_2;
    GraspDefinition {
        translation: [-0.02, -0.02, 0.005],
        rotation: [[s, 0.0, -s], [-s, 0.0, -s], [0.0, 1.0, 0.0]],
        pregrasp: [0.02, 0.15, 0.15],
        second_pregrasp: [0.0; 3],
        lift: Lift::along_object([0.0, 0.0, 0.15]),
        second_lift: Lift::along_object([0.0; 3]),
        opening: None,
    }
}

#[test]
fn a_grasp_without_a_second_pregrasp_works_too() {
    let mut kitchen = Kitchen::parked(-1.447, -0.15, -90.0, 0.3);
    kitchen.spawn_bottle(-1.6, -0.9, 0.82);
    let bottle = kitchen.in_base("bottle-1");
    let axes = kitchen
        .world
        .models()
        .description
        .arm(Side::Right)
        .tool_axes;
    let poses = diagonal().tool_poses(&bottle, &axes).unwrap();
    let end = kitchen.pick_at(Side::Right, &poses, "bottle-1");
    assert!(end.is_ok(), "{end:?}");
    let down = kitchen.tcp(
        Side::Right,
        poses.grasp,
        TcpPath::Straight,
        CollisionMode::AllowHand,
    );
    assert_eq!(kitchen.run_one(down), Ok(MotionOutcome::Arrived));
}

#[test]
fn the_left_arm_carries_a_bottle_as_well() {
    let mut kitchen = Kitchen::parked(-1.447, -0.15, -90.0, 0.3);
    kitchen.spawn_bottle(-1.0, -0.75, 0.86);
    let bottle = kitchen.in_base("bottle-1");
    let end = kitchen.pick(Side::Left, "left-side", "bottle-1", &bottle);
    assert!(end.is_ok(), "{end:?}");
    let park = kitchen.park(true, false);
    assert_eq!(kitchen.run_one(park), Ok(MotionOutcome::Arrived));
}

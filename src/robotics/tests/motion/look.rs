//! Looking and detecting: what the robot of the tutorial sees from the table.

use super::fixture::Kitchen;
use crate::motion::jobs::detect::Detect;
use crate::motion::{DetectQuery, Look, LookDirection, LookTarget, MotionFailure, MotionOutcome};
use spatial::pose::from_xyz_rpy;

/// At the table, parked, torso up, with one bottle.
fn at_table(x: f64, y: f64) -> Kitchen {
    let mut kitchen = Kitchen::parked(-1.447, -0.15, -90.0, 0.3);
    kitchen.spawn_bottle(x, y, 0.86);
    kitchen
}

fn look_at(kitchen: &mut Kitchen, x: f64, y: f64, z: f64) {
    let target = LookTarget::InBase(from_xyz_rpy([x, y, z], [0.0; 3]));
    assert_eq!(
        kitchen.run_one(Look::new(target)),
        Ok(MotionOutcome::Arrived)
    );
}

fn detect(kitchen: &mut Kitchen) -> Result<MotionOutcome, MotionFailure> {
    let query = DetectQuery {
        name: None,
        types: vec!["bottle".to_owned()],
        description: "#<A OBJECT (TYPE BOTTLE)>".to_owned(),
    };
    kitchen.run_one(Detect::new(query))
}

/// Whether the bottle is seen when looking down, left and right, as the tutorial does.
fn seen(x: f64, y: f64) -> [bool; 3] {
    let mut kitchen = at_table(x, y);
    [0.076, 0.76, -0.76].map(|aside| {
        look_at(&mut kitchen, 0.65335, aside, 0.758);
        detect(&mut kitchen).is_ok()
    })
}

#[test]
fn a_bottle_in_the_middle_of_the_table_is_seen_when_looking_down() {
    assert!(seen(-1.6, -0.9)[0]);
}

#[test]
fn a_bottle_at_the_end_of_the_table_is_only_seen_when_looking_to_the_right() {
    assert_eq!(seen(-2.0, -0.9), [false, false, true]);
}

#[test]
fn a_bottle_near_the_robot_is_seen_when_looking_down() {
    assert!(seen(-1.0, -0.75)[0]);
}

#[test]
fn directions_see_what_the_points_of_the_tutorial_see() {
    let mut kitchen = at_table(-2.0, -0.9);
    let mut look = |direction| {
        let end = kitchen.run_one(Look::new(LookTarget::Direction(direction)));
        assert_eq!(end, Ok(MotionOutcome::Arrived));
        detect(&mut kitchen).is_ok()
    };
    use LookDirection::{Down, Forward, Left, Right, Up};
    assert_eq!(
        [Forward, Up, Down, Left, Right].map(&mut look),
        [false, false, false, false, true]
    );
}

#[test]
fn an_object_that_is_not_seen_is_reported_with_what_hides_it() {
    let mut kitchen = at_table(-2.0, -0.9);
    look_at(&mut kitchen, 0.65335, 0.076, 0.758);
    let failure = detect(&mut kitchen).unwrap_err();
    assert_eq!(failure.class_name(), "PERCEPTION-OBJECT-NOT-FOUND");
    let text = failure.to_string();
    let (first, second) = text.split_once('\n').unwrap();
    assert_eq!(first, "Could not find object #<A OBJECT (TYPE BOTTLE)>.");
    assert!(
        second.contains("degrees beyond the right border of the image"),
        "{second}"
    );
}

#[test]
fn a_point_behind_the_robot_twists_the_neck() {
    let mut kitchen = at_table(-1.6, -0.9);
    let target = LookTarget::InBase(from_xyz_rpy([-1.0, -0.01, 1.2], [0.0; 3]));
    let failure = kitchen.run_one(Look::new(target)).unwrap_err();
    assert_eq!(failure.class_name(), "PTU-GOAL-NOT-REACHED");
    assert!(
        failure
            .to_string()
            .starts_with("Look action wanted to twist the neck\n"),
        "{failure}"
    );
}

#[test]
fn the_head_points_at_what_it_looks_at() {
    let mut kitchen = at_table(-1.6, -0.9);
    look_at(&mut kitchen, 0.65335, 0.076, 0.758);
    let head = kitchen
        .world
        .models()
        .robot
        .link_named("head_tilt_link")
        .unwrap();
    let head = kitchen.world.link_pose(head);
    let point =
        kitchen.world.robot_configuration().base * nalgebra::Point3::new(0.65335, 0.076, 0.758);
    let seen = head.inverse_transform_point(&point);
    assert!(
        seen.x > 0.5 && seen.y.abs() < 1e-9 && seen.z.abs() < 1e-9,
        "{seen}"
    );
}

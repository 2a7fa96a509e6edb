//! What the PR2 sees of three bottles on the table, as in CRAM's tutorial.

use crate::perception::visibility::Border;
use crate::perception::{Sight, Visibility};
use crate::robot::JointId;
use crate::tests::world::fixture::{at, carry, models, spawn};
use crate::world::{BodyName, World};

/// The robot in front of the table with bottles A, B and C, its neck panned and tilted
/// (degrees).
fn looking(pan: f64, tilt: f64) -> World {
    let models = models();
    let mut robot = carry(&models, [-1.447, -0.15, -90.0], 0.3);
    let neck = &models.description.neck;
    let mut turn = |joint: JointId, degrees: f64| robot.joints.set(joint, degrees.to_radians());
    turn(neck.joints[0], pan);
    turn(neck.joints[1], tilt);
    let mut world = World::new(models, robot);
    for (name, x, y) in [("A", -1.6, -0.9), ("B", -2.0, -0.9), ("C", -1.0, -0.75)] {
        spawn(&mut world, name, "bottle", &at(x, y, 0.8208));
    }
    world.settle(5.0);
    world
}

/// Pixel (column, row) and share in sight (percent) of the bottles.
fn seen(world: &World) -> [(i64, i64, f64); 3] {
    let sight = Sight::of_robot(world);
    ["A", "B", "C"].map(|name| {
        let place = world.object_pose(name).unwrap().translation.vector.into();
        let [column, row] = sight.picture().camera().pixel_of(&place).unwrap();
        let share = visibility(world, name).fraction() * 100.0;
        (column as i64, row as i64, share.floor())
    })
}

fn names_seen(world: &World) -> Vec<String> {
    let sight = Sight::of_robot(world);
    let objects = world
        .objects()
        .map(|object| sight.visibility(object.name()).unwrap());
    objects
        .filter(Visibility::is_seen)
        .map(|v| v.object)
        .collect()
}

#[test]
fn looking_down_shows_two_bottles_of_three() {
    let world = looking(6.0, 58.9);
    assert_eq!(
        seen(&world),
        [(233, 57, 100.0), (336, 65, 24.0), (77, 74, 100.0)]
    );
    assert_eq!(names_seen(&world), ["A", "C"]);
}

#[test]
fn looking_left_shows_the_bottle_on_the_left() {
    let world = looking(46.5, 35.4);
    let [a, b, c] = seen(&world);
    assert_eq!((a.2, b.2, c), (0.0, 0.0, (216, 155, 100.0)));
    assert_eq!(names_seen(&world), ["C"]);
}

#[test]
fn looking_right_shows_the_bottle_that_was_missing() {
    let world = looking(-46.5, 35.4);
    let [a, b, c] = seen(&world);
    assert_eq!((a, b, c.2), ((45, 178, 100.0), (128, 126, 100.0), 0.0));
    assert_eq!(names_seen(&world), ["A", "B"]);
}

fn visibility(world: &World, name: &str) -> Visibility {
    let sight = Sight::of_robot(world);
    let visibility = sight.visibility(name).unwrap();
    assert_eq!(sight.share(name).unwrap(), visibility.fraction());
    visibility
}

#[test]
fn a_bottle_beyond_the_border_says_so() {
    let missing = visibility(&looking(6.0, 58.9), "B");
    let (border, angle) = missing.outside.unwrap();
    assert_eq!(border, Border::Right);
    assert!((angle.to_degrees() - 5.9).abs() < 0.1);
    assert_eq!(
        missing.to_string(),
        "24 % of B is in sight, it reaches 5.9 degrees beyond the right border of the image"
    );
}

#[test]
fn a_hidden_bottle_names_what_hides_it() {
    let mut world = looking(-46.5, 35.4);
    // Between the camera and bottle B.
    spawn(&mut world, "D", "bottle", &at(-1.94, -0.82, 0.82));
    world.settle(2.0);
    let hidden = visibility(&world, "B");
    assert!(!hidden.is_seen());
    assert_eq!(hidden.occluders[0].0, BodyName::Object("D".to_owned()));
    assert!(hidden.to_string().contains("hidden by D ("), "{hidden}");
}

#[test]
fn the_robot_does_not_hide_the_table_from_itself() {
    let world = looking(6.0, 58.9);
    assert!(visibility(&world, "A").occluders.is_empty());
}

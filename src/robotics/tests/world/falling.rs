//! What falls fast, in the physics engine alone.

use crate::world::physics::{BodyKind, Physics, Surface};
use crate::world::solid::Solid;
use spatial::pose::from_xyz_rpy;
use spatial::{PlacedShape, Pose, Shape};

fn cuboid(size: [f64; 3]) -> Solid {
    let shape = Shape::Box { size };
    let (pose, color) = (Pose::identity(), None);
    Solid::new(&PlacedShape { shape, pose, color }).expect("a box with a volume")
}

/// Where a cube of 1 cm comes to lie (height, m) that falls from a height (m) on a board of 2 mm at 0.
fn dropped(height: f64, board: BodyKind) -> f64 {
    let mut physics = Physics::new();
    let part = (cuboid([2.0, 2.0, 0.002]), 1, Surface::Plain);
    physics.add_body(board, &Pose::identity(), &[part]);
    let kind = BodyKind::Object {
        mass: 0.1,
        friction: 0.5,
    };
    let part = (cuboid([0.01; 3]), 2, Surface::Plain);
    let cube = physics.add_body(kind, &Pose::translation(0.0, 0.0, height), &[part]);
    for _ in 0..600 {
        physics.step();
    }
    physics.pose(cube).translation.z
}

/// Within a step, the cube moves by several times its size and the thickness of the board.
#[test]
fn a_cube_that_falls_fast_does_not_pass_through_a_thin_board() {
    for height in [0.05, 0.1, 0.3, 1.0, 3.0, 5.0, 8.0] {
        let end = dropped(height, BodyKind::Static);
        assert!(end > 0.0, "from {height} m to {end} m");
    }
}

/// The engine sweeps nothing towards a drawer, which may move.
#[test]
fn a_cube_that_falls_into_a_drawer_stays_there() {
    for height in [0.05, 0.1, 0.2, 0.3, 0.5, 0.8] {
        let end = dropped(height, BodyKind::MovingFurniture);
        assert!(end > 0.0, "from {height} m to {end} m");
    }
}

/// How far (m) a ball rolls within 4 s down a slope (rad), and whether it still moves then.
fn rolled(slope: f64) -> (f64, bool) {
    let mut physics = Physics::new();
    let tilted = from_xyz_rpy([0.0, 0.0, 1.0], [0.0, slope, 0.0]);
    let part = (cuboid([4.0, 4.0, 0.02]), 1, Surface::Plain);
    physics.add_body(BodyKind::Static, &tilted, &[part]);
    let kind = BodyKind::Object {
        mass: 0.2,
        friction: 0.6,
    };
    let ball = PlacedShape {
        shape: Shape::Sphere { radius: 0.0425 },
        pose: Pose::identity(),
        color: None,
    };
    let part = (
        Solid::new(&ball).expect("a ball with a volume"),
        2,
        Surface::Plain,
    );
    let begin = tilted * Pose::translation(0.0, 0.0, 0.0526);
    let ball = physics.add_body(kind, &begin, &[part]);
    for _ in 0..960 {
        physics.step();
    }
    let way = physics.pose(ball).translation.vector - begin.translation.vector;
    (way.norm(), physics.is_awake(ball))
}

#[test]
fn a_ball_rests_where_it_is_nearly_level_and_rolls_down_a_slope() {
    let (way, is_awake) = rolled(0.0035);
    assert!(way < 0.03 && !is_awake, "{way}");
    let (way, is_awake) = rolled(0.09);
    assert!(way > 0.2 && is_awake, "{way}");
}

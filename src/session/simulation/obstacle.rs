//! Boxes on the floor that are in the robot's way.

use robotics::world::object_library::{FRICTION, ObjectType};
use spatial::{PlacedShape, Pose, Shape};

/// The name of their type.
pub(crate) const OBSTACLE: &str = "obstacle";
/// Density (kg/m³): one that the robot does not push about by chance.
const DENSITY: f64 = 300.0;
const COLOR: [f32; 4] = [0.45, 0.35, 0.25, 1.0];

/// A box with those edges (m), whose frame is in the middle of its base.
pub(crate) fn obstacle(size: [f64; 3]) -> ObjectType {
    ObjectType {
        name: OBSTACLE.to_owned(),
        shapes: vec![PlacedShape {
            shape: Shape::Box { size },
            pose: Pose::translation(0.0, 0.0, size[2] / 2.0),
            color: None,
        }],
        mass: DENSITY * size.iter().product::<f64>(),
        friction: FRICTION,
        color: COLOR,
        is_round: false,
        looks: None,
        balance: [0.0; 3],
        inside: None,
        edition: 0,
    }
}

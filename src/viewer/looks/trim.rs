//! Small parts of the PR2's head that its model leaves out and by which it is recognised: the
//! lenses of its cameras. They are seen only and touch nothing.

use crate::spatial::pose::from_xyz_rpy;
use crate::spatial::{PlacedShape, Shape};

/// Name of the tree that has the parts, and the link that carries them.
const ROBOT: &str = "pr2";
const LINK: &str = "head_tilt_link";

/// The dark plate in the face: where its middle is and its size (m).
const PLATE: ([f64; 3], [f64; 3]) = ([0.0805, 0.0, 0.114], [0.006, 0.27, 0.062]);
const PLATE_COLOR: [f32; 4] = [0.05, 0.05, 0.055, 1.0];

/// The lenses in the plate: to the left (m, as the frames of the cameras), radius (m) and
/// linear colour.
const LENSES: [(f64, f64, [f32; 4]); 6] = [
    (-0.11, 0.019, [0.02, 0.03, 0.06, 1.0]),
    (-0.06, 0.014, [0.10, 0.12, 0.16, 1.0]),
    (-0.03, 0.011, [0.10, 0.12, 0.16, 1.0]),
    (0.03, 0.014, [0.10, 0.12, 0.16, 1.0]),
    (0.06, 0.011, [0.10, 0.12, 0.16, 1.0]),
    (0.11, 0.019, [0.30, 0.05, 0.04, 1.0]),
];

/// The small parts of the link of the tree.
pub(super) fn trim_of(tree: &str, link: &str) -> Vec<(PlacedShape, [f32; 4])> {
    if tree != ROBOT || link != LINK {
        return Vec::new();
    }
    let part = |shape: Shape, at: [f64; 3], rpy: [f64; 3], color| {
        let placed = PlacedShape {
            shape,
            pose: from_xyz_rpy(at, rpy),
            color: Some(color),
        };
        (placed, color)
    };
    let (at, size) = PLATE;
    let mut parts = vec![part(Shape::Box { size }, at, [0.0; 3], PLATE_COLOR)];
    for (left, radius, color) in LENSES {
        let lens = Shape::Cylinder {
            radius,
            length: 0.016,
        };
        let forward = [0.0, std::f64::consts::FRAC_PI_2, 0.0];
        parts.push(part(lens, [at[0], left, at[2]], forward, color));
    }
    parts
}

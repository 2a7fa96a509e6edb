//! Small parts of the PR2 that its model leaves out and by which it is recognised. They are
//! seen only and touch nothing.

use crate::spatial::pose::from_xyz_rpy;
use crate::spatial::{PlacedShape, Shape};

/// A part: the link that carries it, where it is (m), along which axis of the link, its
/// shape (m) and linear colour.
struct Part {
    link: &'static str,
    at: [f64; 3],
    rpy: [f64; 3],
    shape: Shape,
    color: [f32; 4],
}

const PARTS: &[Part] = &[];

/// The small parts of the link, each with its colour.
pub(super) fn trim_of(link: &str) -> impl Iterator<Item = (PlacedShape, [f32; 4])> {
    PARTS.iter().filter(move |p| p.link == link).map(|p| {
        let placed = PlacedShape {
            shape: p.shape.clone(),
            pose: from_xyz_rpy(p.at, p.rpy),
            color: None,
        };
        (placed, p.color)
    })
}

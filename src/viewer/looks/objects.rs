//! How objects look.

use std::sync::Arc;

use super::look::Look;
use super::vessel::{Part, parts_of};
use crate::spatial::PlacedShape;
use crate::viewer::scene::Finish;

/// Greatest width (m) of broken edges.
const BEVEL: f64 = 0.006;

/// The looks of an object of these shapes.
pub(super) fn looks_of(_name: &str, shapes: &[PlacedShape]) -> Vec<Look> {
    let look = |part| match part {
        Part::Shape(placed) => Look::of_shape(placed, BEVEL, Finish::Gloss),
        Part::Vessel { surface, at } => Look {
            surface: Arc::new(surface),
            at,
            color: None,
            finish: Finish::Gloss,
        },
    };
    parts_of(shapes).into_iter().map(look).collect()
}

//! A surface that a thing wears.

use std::sync::Arc;

use crate::spatial::{PlacedShape, Pose};
use crate::viewer::scene::{Body, Finish, Owner};
use crate::viewer::surface::Surface;

/// Linear colour of what has no colour of its own.
pub(super) const PLAIN: [f32; 4] = [0.6, 0.6, 0.6, 1.0];

/// A surface that a link or an object wears.
#[derive(Clone, Debug)]
pub(super) struct Look {
    pub(super) surface: Arc<Surface>,
    /// Pose of the surface's frame in that of the link or object.
    pub(super) at: Pose,
    /// Its own colour, if it has one.
    pub(super) color: Option<[f32; 4]>,
    pub(super) finish: Finish,
}

impl Look {
    /// A shape as it is, its edges broken by at most `bevel` (m).
    pub(super) fn of_shape(placed: &PlacedShape, bevel: f64, finish: Finish) -> Self {
        Self {
            surface: Arc::new(Surface::of(&placed.shape, bevel)),
            at: placed.pose,
            color: placed.color,
            finish,
        }
    }

    /// The body that a thing at the pose (map frame) shows; `color` is the thing's.
    pub(super) fn body(&self, owner: &Owner, pose: &Pose, color: [f32; 4]) -> Body {
        Body {
            owner: owner.clone(),
            surface: self.surface.clone(),
            pose: pose * self.at,
            color: self.color.unwrap_or(color),
            finish: self.finish,
        }
    }
}

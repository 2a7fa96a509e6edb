//! A surface that a thing wears.

use std::sync::Arc;

use crate::spatial::pose::from_xyz_rpy;
use crate::spatial::{PlacedShape, Pose};
use crate::viewer::loft::Along;
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

    /// A surface in the frame of the link or object.
    pub(super) fn of_surface(surface: Surface, color: [f32; 4], finish: Finish) -> Self {
        Self {
            surface: Arc::new(surface),
            at: Pose::identity(),
            color: Some(color),
            finish,
        }
    }

    /// What a line leaves that is turned about an axis through `middle` (m; y, z for x;
    /// z, x for y; x, y for z). The line is given by distances from the axis and places along it.
    pub(super) fn turned(
        along: Along,
        line: &[[f64; 2]],
        middle: [f64; 2],
        color: [f32; 4],
    ) -> Self {
        let quarter = std::f64::consts::FRAC_PI_2;
        let [u, v] = middle;
        let at = match along {
            Along::X => from_xyz_rpy([0.0, u, v], [0.0, quarter, 0.0]),
            Along::Y => from_xyz_rpy([v, 0.0, u], [-quarter, 0.0, 0.0]),
            Along::Z => from_xyz_rpy([u, v, 0.0], [0.0; 3]),
        };
        Self {
            at,
            ..Self::of_surface(Surface::lathed(line), color, Finish::Gloss)
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

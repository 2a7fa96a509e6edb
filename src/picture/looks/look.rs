//! A surface that a thing wears.

use std::sync::Arc;

use crate::picture::loft::Along;
use crate::picture::scene::{Body, Finish, Owner};
use crate::picture::surface::Surface;
use crate::spatial::pose::from_xyz_rpy;
use crate::spatial::{PlacedShape, Pose};

/// Linear colour of what has no colour of its own.
pub(crate) const PLAIN: [f32; 4] = [0.6, 0.6, 0.6, 1.0];

/// A surface that a link or an object wears.
#[derive(Clone, Debug)]
pub(crate) struct Look {
    pub(crate) surface: Arc<Surface>,
    /// Pose of the surface's frame in that of the link or object.
    pub(crate) at: Pose,
    /// Its own colour, if it has one.
    pub(crate) color: Option<[f32; 4]>,
    pub(crate) finish: Finish,
}

impl Look {
    /// A shape as it is, its edges broken by at most `bevel` (m).
    pub(crate) fn of_shape(placed: &PlacedShape, bevel: f64, finish: Finish) -> Self {
        Self {
            surface: Arc::new(Surface::of(&placed.shape, bevel)),
            at: placed.pose,
            color: placed.color,
            finish,
        }
    }

    /// A surface in the frame of the link or object.
    pub(crate) fn of_surface(surface: Surface, color: [f32; 4], finish: Finish) -> Self {
        Self {
            surface: Arc::new(surface),
            at: Pose::identity(),
            color: Some(color),
            finish,
        }
    }

    /// What a line leaves that is turned about an axis through `middle` (m; y, z for x;
    /// z, x for y; x, y for z). The line is given by distances from the axis and places along it.
    pub(crate) fn turned(
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
    pub(crate) fn body(&self, owner: &Owner, pose: &Pose, color: [f32; 4]) -> Body {
        Body {
            owner: owner.clone(),
            surface: self.surface.clone(),
            pose: pose * self.at,
            color: self.color.unwrap_or(color),
            finish: self.finish,
        }
    }
}

//! A surface that a link or an object shows.

use std::sync::Arc;

use crate::picture::loft::Along;
use crate::picture::scene::{Body, Finish, Owner};
use crate::picture::surface::Surface;
use spatial::pose::from_xyz_rpy;
use spatial::{PlacedShape, Pose};

/// A linear colour: red, green, blue, alpha.
pub(crate) type Color = [f32; 4];

/// Colour of things without a colour of their own.
pub(crate) const PLAIN: Color = [0.6, 0.6, 0.6, 1.0];

/// A surface that a link or an object shows.
#[derive(Clone, Debug)]
pub(crate) struct Look {
    pub surface: Arc<Surface>,
    /// Pose of the surface's frame in the frame of the link or object.
    pub at: Pose,
    /// Its own colour, if it has one.
    pub color: Option<Color>,
    pub finish: Finish,
}

impl Look {
    /// The shape itself, its edges bevelled by at most `bevel` (m).
    pub(crate) fn of_shape(placed: &PlacedShape, bevel: f64, finish: Finish) -> Self {
        Self {
            surface: Arc::new(Surface::of(&placed.shape, bevel)),
            at: placed.pose,
            color: placed.color,
            finish,
        }
    }

    /// A glossy surface at a pose in the frame of the link or object.
    pub(crate) fn of_surface(surface: Arc<Surface>, at: Pose, color: Option<Color>) -> Self {
        Self {
            surface,
            at,
            color,
            finish: Finish::Gloss,
        }
    }

    /// The pose of a surface of revolution about an axis through `middle` (m; y, z for x; z, x
    /// for y; x, y for z).
    pub(crate) fn pose_of_axis(along: Along, middle: [f64; 2]) -> Pose {
        let quarter = std::f64::consts::FRAC_PI_2;
        let [u, v] = middle;
        match along {
            Along::X => from_xyz_rpy([0.0, u, v], [0.0, quarter, 0.0]),
            Along::Y => from_xyz_rpy([v, 0.0, u], [-quarter, 0.0, 0.0]),
            Along::Z => from_xyz_rpy([u, v, 0.0], [0.0; 3]),
        }
    }

    /// The body shown by a thing at the pose (map frame); `color` is the thing's own, which is
    /// shown as a [`pigment`].
    pub(super) fn body(&self, owner: &Owner, pose: &Pose, color: Color) -> Body {
        Body {
            owner: owner.clone(),
            surface: self.surface.clone(),
            pose: pose * self.at,
            color: self.color.unwrap_or_else(|| pigment(color)),
            finish: self.finish,
        }
    }
}

/// Greatest and least share of the light that a pure colour reflects.
const PURE: [f32; 2] = [0.62, 0.012];

/// A colour as paint can have it: nothing is both as pure and as bright as `(1 0 0)`, on which
/// light and shade could not be told apart.
fn pigment([red, green, blue, alpha]: Color) -> Color {
    let color = [red, green, blue].map(|c| c.clamp(0.0, 1.0));
    let most = color.iter().copied().fold(0.0, f32::max);
    let least = color.iter().copied().fold(1.0, f32::min);
    if most <= 0.0 {
        return [PURE[1], PURE[1], PURE[1], alpha];
    }
    let purity = 1.0 - least / most;
    let limit = 1.0 + (PURE[0] - 1.0) * purity;
    let [red, green, blue] = color.map(|c| (c * limit.min(most) / most).max(PURE[1]));
    [red, green, blue, alpha]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pure_colours_leave_room_for_light_and_shade() {
        assert_eq!(pigment([1.0, 0.0, 0.0, 0.5]), [0.62, 0.012, 0.012, 0.5]);
        let grey = [0.5, 0.5, 0.5, 1.0];
        assert_eq!(pigment(grey), grey);
        let dull = [0.3, 0.2, 0.1, 1.0];
        assert_eq!(pigment(dull), dull);
        assert_eq!(pigment([0.0, 0.0, f32::NAN, 1.0])[3], 1.0);
    }
}

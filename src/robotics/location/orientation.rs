//! How things are turned when they are put down.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::constraint::edge_heading;
use super::draw::Draw;
use crate::world::Extent;
use spatial::{Pose, pose};

/// Number of headings that are drawn for a point.
const DRAWS: usize = 3;

/// Which orientations are wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Orientation {
    /// Upright, with any heading.
    #[default]
    Random,
    /// Upright, along an axis of the map.
    AxisAligned,
    /// Upright, perpendicular to the nearest edge of the support.
    SupportAligned,
    /// Turned over, along an axis of the map.
    UpsideDown,
}

impl Orientation {
    /// All of them.
    pub const ALL: [Self; 4] = [
        Self::SupportAligned,
        Self::AxisAligned,
        Self::Random,
        Self::UpsideDown,
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Random => "random",
            Self::AxisAligned => "axis-aligned",
            Self::SupportAligned => "support-aligned",
            Self::UpsideDown => "upside-down",
        }
    }

    /// Poses at the point (m) on the support, all to be tried; their height is 0.
    pub(super) fn poses(self, point: [f64; 2], extent: &Extent, draw: &mut Draw) -> Vec<Pose> {
        let [x, y] = point;
        let turned = |roll: f64, yaw: f64| pose::from_xyz_rpy([x, y, 0.0], [roll, 0.0, yaw]);
        let axes = [0.0, PI, FRAC_PI_2, -FRAC_PI_2];
        match self {
            Self::Random => (0..DRAWS)
                .map(|_| turned(0.0, draw.unit() * TAU - PI))
                .collect(),
            Self::AxisAligned => axes.map(|yaw| turned(0.0, yaw)).into(),
            Self::UpsideDown => axes.map(|yaw| turned(PI, yaw)).into(),
            Self::SupportAligned => vec![turned(0.0, edge_heading(extent, point))],
        }
    }
}

//! What the camera makes of an object that is in sight.

use nalgebra::Vector3;

use super::levels::NoiseLevels;
use super::{Draws, moved};
use spatial::Pose;

/// Where an object is in the sight of the camera.
#[derive(Clone, Copy, Debug)]
pub struct Sighting {
    /// Its distance from the camera (m).
    pub distance: f64,
    /// The cosine of the angle between it and the optical axis.
    pub cosine: f64,
}

impl Sighting {
    /// By how much errors of position grow beyond 1 m: with the square of the distance, as those of
    /// depth images do (the source is named at [`NoiseSetting::ALL`](super::levels::NoiseSetting::ALL)).
    fn blur(&self) -> f64 {
        (self.distance * self.distance).max(1.0)
    }

    /// By how much misses become more probable: an object has fewer pixels, by the square of its
    /// distance, and towards the edge of the picture less light, by the fourth power of the cosine.
    fn dimness(&self) -> f64 {
        let square = self.cosine * self.cosine;
        self.blur() / (square * square).max(0.01)
    }
}

/// What the camera makes of an object that is in sight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Perceived {
    /// Whether it is overlooked.
    pub(crate) is_missed: bool,
    /// If it is taken for one of another type, which of them: a number from 0 up to 1.
    pub(crate) other_type: Option<f64>,
    /// The error of its position (m, along the axes of the map) and of its yaw (rad).
    error: ([f64; 3], f64),
}

impl Perceived {
    /// What a look makes of an object that the camera sees so.
    pub(super) fn drawn(levels: &NoiseLevels, sighting: &Sighting, draws: &mut Draws) -> Self {
        let is_missed = draws.unit() < levels.misses * sighting.dimness();
        let position = levels.position * sighting.blur();
        let other_type = (draws.unit() < levels.false_types).then(|| draws.unit());
        Self {
            is_missed,
            other_type,
            error: (
                [(); 3].map(|()| draws.normal() * position),
                draws.normal() * levels.yaw,
            ),
        }
    }

    /// Where an object at the pose, in the map, appears to be.
    pub fn pose(&self, truth: &Pose) -> Pose {
        let (error, yaw) = self.error;
        moved(truth, &Vector3::from(error), yaw)
    }
}

//! What the robot takes to be so, and what is.

use nalgebra::Vector3;

use super::{Noise, moved};
use crate::world::World;
use spatial::Pose;

impl World {
    /// The errors of sensors and motors; `None` if there are none.
    pub fn noise(&self) -> Option<&Noise> {
        self.state.noise.as_ref()
    }

    /// The same, to be changed.
    pub(crate) fn noise_mut(&mut self) -> Option<&mut Noise> {
        self.state.noise.as_mut()
    }

    /// Where the robot takes its base to be, in the map: where it is, without noise.
    pub fn believed_base(&self) -> Pose {
        let base = self.robot_configuration().base;
        let Some(noise) = &self.state.noise else {
            return base;
        };
        let [x, y, yaw] = noise.base;
        moved(&base, &-Vector3::new(x, y, 0.0), -yaw)
    }

    /// The true pose in the map of what the robot takes to be at a pose in the map.
    pub fn from_belief(&self, believed: &Pose) -> Pose {
        match &self.state.noise {
            None => *believed,
            Some(_) => self.robot_configuration().base * self.believed_base().inverse() * believed,
        }
    }

    /// Where the robot takes something to be, in the map, that is at a pose in the map.
    pub fn to_belief(&self, truth: &Pose) -> Pose {
        match &self.state.noise {
            None => *truth,
            Some(_) => self.believed_base() * self.robot_configuration().base.inverse() * truth,
        }
    }

    /// Sets the errors of sensors and motors.
    pub fn set_noise(&mut self, noise: Option<Noise>) {
        self.state.noise = noise;
    }
}

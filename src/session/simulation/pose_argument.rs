//! Poses as arguments: lists, poses, stamped poses, location designators.

use super::Simulation;
use crate::simulation::properties::property;
use cram::pose::argument;
use cram::pose::value::{as_placement, frame_of};
use lisp::image::Image;
use lisp::print;
use lisp::value::Value;
use lisp::value::raise::Raise;
use spatial::Pose;

impl Simulation {
    /// The pose of a pose argument in the map frame. A stamped pose is transformed from its
    /// frame; a list or a plain pose is in the map frame.
    pub(crate) fn pose_in_map(&self, image: &Image, pose: &Value) -> Result<Pose, Box<Raise>> {
        let local = self.pose_as_given(image, pose)?;
        match frame_of(pose) {
            Some(frame) => Ok(self.frame_in_map(image, &frame)? * local),
            None => Ok(local),
        }
    }

    /// Position and orientation of a pose argument as given, whatever the frame; an error if
    /// there is no such frame, or if the quaternion is no rotation.
    pub(crate) fn pose_as_given(&self, image: &Image, pose: &Value) -> Result<Pose, Box<Raise>> {
        let placement = match as_placement(pose) {
            Some(placement) => placement,
            None => argument::placement(image, pose)?,
        };
        if let Some(frame) = frame_of(pose) {
            self.frame_in_map(image, &frame)?;
        }
        if !placement.orientation.is_rotation() {
            let [x, y, z, w] = placement.orientation.0;
            return Err(Raise::simple(format!(
                "{} has the quaternion ({x} {y} {z} {w}), which is no rotation: (0 0 0 1) stands \
                 for none, (0 0 0.7071 0.7071) for a quarter turn to the left.",
                print::to_string(image, pose, true)
            )));
        }
        Ok(placement.to_pose())
    }

    /// The pose of a resolved location designator, or of a pose itself.
    pub(crate) fn location_pose(image: &mut Image, location: &Value) -> Result<Value, Box<Raise>> {
        if as_placement(location).is_some() {
            return Ok(location.clone());
        }
        match property(image, location, "POSE") {
            Some(pose) => Ok(pose),
            None => Err(Raise::simple(format!(
                "{} has no pose: write (a location (pose ?pose)).",
                print::to_string(image, location, false)
            ))),
        }
    }
}

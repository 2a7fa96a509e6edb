//! Named frames: the map, the robot's links, the kitchen's links, objects.

use super::Simulation;
use super::names::suggestion;
use cram::pose::value::pose_stamped;
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::raise::Raise;
use spatial::Pose;

/// The frame to which everything refers.
pub(crate) const MAP: &str = "map";

impl Simulation {
    /// Whether the frame is that of the map, under one of its names.
    pub(crate) fn is_map(&self, frame: &str) -> bool {
        let name = frame.trim_start_matches('/');
        let odometry = self.models.description.base.odometry.as_deref();
        matches!(name, MAP | "world") || odometry == Some(name)
    }

    /// The name of the frame of the robot's base on the floor.
    pub(crate) fn base_frame(&self) -> &str {
        let models = &self.models;
        &models.robot.link(models.description.base.frame).name
    }

    /// Whether the frame is that of the robot's base, under one of its names.
    pub(crate) fn is_base(&self, frame: &str) -> bool {
        self.models.robot.link_named(frame) == Some(self.models.description.base.frame)
    }

    /// A pose in the frame of the robot's base.
    pub(crate) fn in_base(&self, pose: &Pose) -> Value {
        pose_stamped(self.base_frame(), pose)
    }

    /// The pose of a frame in the map frame, for the robot's links as the robot takes it to be.
    pub(crate) fn frame_in_map(&self, _: &Image, frame: &str) -> Result<Pose, Box<Raise>> {
        let name = frame.trim_start_matches('/');
        if self.is_map(name) {
            return Ok(Pose::identity());
        }
        if let Some(link) = self.models.robot.link_named(name) {
            return Ok(self.world.to_belief(&self.world.link_pose(link)));
        }
        if let Some(link) = self.models.kitchen.link_named(name) {
            return Ok(self.world.furniture_pose(link));
        }
        let object = name.to_uppercase().replace('_', "-");
        if let Ok(pose) = self.world.object_pose(&object) {
            return Ok(pose);
        }
        let trees = [&self.models.robot, &self.models.kitchen];
        let links = trees.into_iter().flat_map(|tree| tree.links());
        let names = links.map(|(_, link)| link.name.as_str()).chain([MAP]);
        let near = suggestion(name, names, |n| format!("{n:?}"));
        Err(Raise::simple(format!(
            "There is no frame {frame:?}{near}{}",
            if near.is_empty() { "." } else { "" }
        )))
    }
}

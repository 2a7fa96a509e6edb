//! Named frames: the map, the robot's links, the kitchen's links, objects.

use super::Simulation;
use super::names::suggestion;
use lisp::image::Image;
use lisp::value::raise::Raise;
use spatial::Pose;

/// The frame to which everything refers.
pub(crate) const MAP: &str = "map";
/// The frame of the robot's base on the floor.
pub(crate) const BASE: &str = "base_footprint";

/// Whether the frame is that of the map, under one of its names.
pub(crate) fn is_map(frame: &str) -> bool {
    matches!(
        frame.trim_start_matches('/'),
        "map" | "world" | "odom_combined"
    )
}

impl Simulation {
    /// The pose of a frame in the map frame.
    pub(crate) fn frame_in_map(&self, _: &Image, frame: &str) -> Result<Pose, Box<Raise>> {
        let name = frame.trim_start_matches('/');
        if is_map(name) {
            return Ok(Pose::identity());
        }
        if let Some(link) = self.models.robot.link_named(name) {
            return Ok(self.world.link_pose(link));
        }
        if let Some(link) = self.models.kitchen.link_named(name) {
            return Ok(self.world.furniture_pose(link));
        }
        // The name that a robot gives its root link does not matter.
        if name == BASE {
            return Ok(self.base());
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

//! The robot's configuration in the world, and how it changes.

use super::robot_configuration::RobotConfiguration;
use super::scene::{World, pose_of};
use crate::robot::LinkId;
use spatial::Pose;

impl World {
    /// The current base pose and joint positions.
    pub fn robot_configuration(&self) -> &RobotConfiguration {
        &self.state.robot
    }

    /// Makes the robot move to the configuration during the next step. Meant for one tick of
    /// a smooth motion: the path there is not checked.
    pub fn set_robot_configuration(&mut self, configuration: &RobotConfiguration) {
        if self.state.robot != *configuration {
            self.place_robot_links(configuration);
            self.state.robot_moves = true;
        }
    }

    /// Puts the robot into the configuration at once, with the objects that it holds; it loses the
    /// handles. An edit of the world, not a motion.
    pub fn teleport_robot(&mut self, configuration: &RobotConfiguration) {
        self.place_robot_links(configuration);
        self.release_handles(None);
        self.state.robot_moves = false;
        self.place_robot_bodies();
        let held = self.state.objects.values().filter_map(|object| {
            let attachment = object.attachment.as_ref()?;
            let link = pose_of(&self.state.robot_poses, attachment.link);
            Some((object.name.clone(), object.body, link * attachment.at))
        });
        for (name, body, to) in held.collect::<Vec<_>>() {
            let from = self.physics.pose(body);
            self.take_grains_along(&name, &from, &to);
            self.physics.place(body, &to);
        }
    }

    /// Takes the links to where the configuration has them; the engine's bodies stay behind.
    pub(super) fn place_robot_links(&mut self, configuration: &RobotConfiguration) {
        let (tree, state) = (&self.models.robot, &mut self.state);
        let poses = &mut state.robot_poses;
        if state.robot.base == configuration.base {
            let (before, now) = (&state.robot.joints, &configuration.joints);
            tree.update_forward_kinematics(before, now, poses, &mut Vec::new());
        } else {
            tree.forward_kinematics(&configuration.base, &configuration.joints, poses);
        }
        state.robot.clone_from(configuration);
    }

    /// Pose of a link of the robot in the map frame.
    pub fn link_pose(&self, link: LinkId) -> Pose {
        pose_of(&self.state.robot_poses, link)
    }
}

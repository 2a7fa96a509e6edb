//! Objects that are held by links.

use super::error::WorldError;
use super::object::Attachment;
use super::scene::{World, pose_of};
use crate::robot::LinkId;

impl World {
    /// Welds the object softly to the robot's link, where it is now. An object that was
    /// attached elsewhere is let go there.
    pub fn attach(&mut self, name: &str, link: LinkId) -> Result<(), WorldError> {
        self.detach(name)?;
        let object = self.object(name)?;
        let (body, pose) = (object.body, self.physics.pose(object.body));
        let link_pose = self.link_pose(link);
        let geometry = &self.models.robot_geometry;
        // Every link has a group, and every group of the robot a body.
        let group = geometry.group_of[link.index()];
        let root = pose_of(&self.state.robot_poses, geometry.groups[group].root);
        let weld = self
            .physics
            .weld(self.robot_bodies[group], &(root.inverse() * pose), body);
        let at = link_pose.inverse() * pose;
        if let Some(object) = self.state.objects.get_mut(name) {
            object.attachment = Some(Attachment { link, at, weld });
        }
        Ok(())
    }

    /// Lets go of the object. Returns the link that held it.
    pub fn detach(&mut self, name: &str) -> Result<Option<LinkId>, WorldError> {
        self.object(name)?;
        let Some(object) = self.state.objects.get_mut(name) else {
            return Ok(None);
        };
        let held = object.attachment.take();
        if let Some(attachment) = held {
            self.physics.unweld(attachment.weld);
            self.physics.wake(object.body);
        }
        Ok(held.map(|a| a.link))
    }
}

//! Objects that are held by links.

use super::error::WorldError;
use super::object::Attachment;
use super::scene::World;
use crate::robot::LinkId;

impl World {
    /// Welds the object softly to the robot's link at its current pose. An object that was
    /// attached elsewhere is detached first.
    pub(crate) fn attach(&mut self, name: &str, link: LinkId) -> Result<(), WorldError> {
        self.detach(name)?;
        let body = self.object(name)?.body;
        let Some((carrier, root)) = self.body_of_link(link) else {
            // A link of another tree has no body here that could hold anything.
            return Ok(());
        };
        // The engine's poses, since the robot may already be set to move in the next step.
        let grip = self.physics.pose(carrier).inverse() * self.physics.pose(body);
        let weld = self.physics.weld(carrier, &grip, body);
        let at = self.link_pose(link).inverse() * self.link_pose(root) * grip;
        if let Some(object) = self.state.objects.get_mut(name) {
            object.attachment = Some(Attachment { link, at, weld });
        }
        Ok(())
    }

    /// Lets go of the object. Returns the link that held it.
    pub(crate) fn detach(&mut self, name: &str) -> Result<Option<LinkId>, WorldError> {
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

//! The world as it would be with an object and the robot elsewhere, to ask what could be
//! done there. The world itself stays as it is.

use crate::robot::Side;
use crate::spatial::{Pose, pose};
use crate::world::{World, WorldError};

/// How a world would differ from that of now.
pub(super) struct Imagined<'a> {
    /// Name of the object, which no hand would hold.
    pub object: &'a str,
    /// Where it would be, in the map frame; it would stand on what is closely below.
    pub object_pose: Option<Pose>,
    /// Where the base would be, in the map frame.
    pub base_pose: Option<Pose>,
    /// The hand that would be open.
    pub side: Side,
    /// How wide it would be open (m).
    pub opening: f64,
}

impl Imagined<'_> {
    /// A copy of the world with these differences.
    pub fn world(&self, now: &World) -> Result<World, WorldError> {
        let mut world = now.clone();
        let gripper = &now.models().description.arm(self.side).gripper;
        let mut robot = now.robot_configuration().clone();
        let fingers = gripper.position_for_opening(self.opening);
        robot.joints.set(gripper.joint, fingers);
        if let Some(base) = &self.base_pose {
            let t = base.translation;
            robot.base = pose::from_xy_yaw(t.x, t.y, pose::yaw(base));
        }
        world.teleport_robot(&robot);
        world.detach(self.object)?;
        if let Some(pose) = &self.object_pose {
            world.move_object(self.object, pose)?;
        }
        Ok(world)
    }
}

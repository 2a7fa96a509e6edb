//! The world as it would be with an object and the robot elsewhere, to ask what could be
//! done there. The world itself stays as it is.

use crate::robot::Side;
use crate::spatial::{Pose, pose};
use crate::world::{World, WorldError};

/// How far (m) a surface may be above the height that was asked for: people give heights
/// roughly, and things come to stand on what is there.
const HIGHEST_LIFT: f64 = 0.1;

/// How a world would differ from that of now.
pub(in crate::session) struct Imagined<'a> {
    /// Name of the object, which no hand would hold.
    pub(crate) object: &'a str,
    /// Where it would be, in the map frame; it would stand on what is closely below.
    pub(crate) object_pose: Option<Pose>,
    /// Where the base would be, in the map frame.
    pub(crate) base_pose: Option<Pose>,
    /// The hand that would be open.
    pub(crate) side: Side,
    /// How wide it would be open (m).
    pub(crate) opening: f64,
}

impl Imagined<'_> {
    /// A copy of the world with these differences; none if something else is where the object
    /// would be.
    pub(crate) fn world(&self, now: &World) -> Result<Option<World>, WorldError> {
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
            let report = world.move_object(self.object, pose)?;
            if report.shifted > 0.0 || report.lifted > HIGHEST_LIFT {
                return Ok(None);
            }
        }
        Ok(Some(world))
    }
}

//! A copy of the world with an object and the robot elsewhere, to find out what could be
//! done there. The world itself is not changed.

use robotics::robot::Side;
use robotics::world::{RobotConfiguration, World, WorldError};
use spatial::{Pose, pose};

/// How far (m) a surface may be above the requested height: users give heights roughly, and
/// things end up standing on what is there.
const HIGHEST_LIFT: f64 = 0.1;

/// How the imagined world differs from the present one.
pub(crate) struct Imagined<'a> {
    /// Name of the object, which no hand holds.
    pub object: &'a str,
    /// Its pose in the map frame; it stands on what is just below.
    pub object_pose: Option<Pose>,
    /// The pose of the base in the map frame.
    pub(crate) base_pose: Option<Pose>,
    /// The open hand.
    pub side: Side,
    /// Its opening (m).
    pub opening: f64,
}

impl Imagined<'_> {
    /// A copy of the world with these differences; `None` if something else is where the object
    /// would be.
    pub(crate) fn world(&self, now: &World) -> Result<Option<World>, WorldError> {
        let mut world = now.clone();
        world.teleport_robot(&self.robot(now));
        world.detach(self.object)?;
        if let Some(pose) = &self.object_pose {
            let report = world.move_object(self.object, pose)?;
            if report.shifted > 0.0 || report.lifted > HIGHEST_LIFT {
                return Ok(None);
            }
        }
        Ok(Some(world))
    }

    /// The robot in that world.
    pub(crate) fn robot(&self, now: &World) -> RobotConfiguration {
        let gripper = &now.models().description.arm(self.side).gripper;
        let mut robot = now.robot_configuration().clone();
        let fingers = gripper.position_for_opening(self.opening);
        robot.joints.set(gripper.joint, fingers);
        if let Some(base) = &self.base_pose {
            let t = base.translation;
            let height = robot.base.translation.z;
            robot.base = pose::from_xy_yaw(t.x, t.y, pose::yaw(base));
            robot.base.translation.z = height;
        }
        robot
    }

    /// Whether the robot alone differs from what it is now: the object stays where it is, and no hand holds any that
    /// goes with it.
    pub(crate) fn is_only_robot(&self, now: &World) -> Result<bool, WorldError> {
        let stays = self.object_pose.is_none() && now.object(self.object)?.attachment().is_none();
        let mut objects = now.objects();
        Ok(stays && objects.all(|object| object.attachments().count() < 2))
    }
}

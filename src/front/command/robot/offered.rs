//! The actions that the robot offers.

use super::goal::Deed;
use robotics::robot::RobotPart;
use robotics::world::Models;

/// An action that the robot offers.
#[derive(Clone, Debug)]
pub(super) struct Offered {
    /// Its name.
    pub(super) name: String,
    /// Its type.
    pub(super) action: &'static str,
    /// What it does.
    pub(super) deed: Deed,
}

/// All that a robot can do.
pub(super) fn offered(models: &Models) -> Vec<Offered> {
    let body = &models.description;
    let offer = |part: RobotPart, action, deed| {
        let known = body.interface.part(part);
        Offered {
            name: known.map_or_else(String::new, |known| known.name.clone()),
            action,
            deed,
        }
    };
    let trajectory = |part: RobotPart, arm| {
        offer(
            part,
            "control_msgs/action/FollowJointTrajectory",
            Deed::Follow(arm),
        )
    };
    let mut all = vec![offer(
        RobotPart::Base,
        "nav2_msgs/action/NavigateToPose",
        Deed::Navigate,
    )];
    for arm in &body.arms {
        let side = arm.side;
        all.push(trajectory(RobotPart::Arm(side), Some(side)));
        all.push(offer(
            RobotPart::Gripper(side),
            "control_msgs/action/GripperCommand",
            Deed::Gripper(side),
        ));
    }
    if body.torso.joint.is_some() {
        all.push(trajectory(RobotPart::Torso, None));
    }
    all.push(offer(
        RobotPart::Neck,
        "control_msgs/action/PointHead",
        Deed::PointHead,
    ));
    all
}

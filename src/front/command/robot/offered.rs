//! The actions that the robot offers.

use super::goal::Deed;
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
    let offer = |name: String, action, deed| Offered { name, action, deed };
    let trajectory = |part: &str, arm| {
        offer(
            format!("/{part}_controller/follow_joint_trajectory"),
            "control_msgs/action/FollowJointTrajectory",
            Deed::Follow(arm),
        )
    };
    let body = &models.description;
    let mut all = vec![offer(
        "/navigate_to_pose".to_owned(),
        "nav2_msgs/action/NavigateToPose",
        Deed::Navigate,
    )];
    for arm in &body.arms {
        let side = arm.side;
        all.push(trajectory(&format!("{side}_arm"), Some(side)));
        all.push(offer(
            format!("/{side}_gripper_controller/gripper_cmd"),
            "control_msgs/action/GripperCommand",
            Deed::Gripper(side),
        ));
    }
    if body.torso.joint.is_some() {
        all.push(trajectory("torso", None));
    }
    all.push(offer(
        "/head_controller/point_head_action".to_owned(),
        "control_msgs/action/PointHead",
        Deed::PointHead,
    ));
    all
}

//! The actions that the robot offers.

use super::goal::Deed;
use robotics::robot::Side;

/// An action that the robot offers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Offered {
    /// Its name.
    pub(super) name: &'static str,
    /// Its type.
    pub(super) action: &'static str,
    /// What it does.
    pub(super) deed: Deed,
}

/// All of them.
pub(super) const OFFERED: [Offered; 4] = [
    Offered {
        name: "/navigate_to_pose",
        action: "nav2_msgs/action/NavigateToPose",
        deed: Deed::Navigate,
    },
    Offered {
        name: "/left_gripper_controller/gripper_cmd",
        action: "control_msgs/action/GripperCommand",
        deed: Deed::Gripper(Side::Left),
    },
    Offered {
        name: "/right_gripper_controller/gripper_cmd",
        action: "control_msgs/action/GripperCommand",
        deed: Deed::Gripper(Side::Right),
    },
    Offered {
        name: "/head_controller/point_head_action",
        action: "control_msgs/action/PointHead",
        deed: Deed::PointHead,
    },
];

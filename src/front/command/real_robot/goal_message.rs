//! Goals as the actions of ROS 2 have them.

use std::time::Duration;

use robotics::robot::RobotPart;
use ros::{Value, message};
use session::outside::PartGoal;

/// How fast (rad/s) a head may turn.
const HEAD_SPEED: f64 = 1.0;

/// The type of the action by which a part is moved.
pub(super) fn action_of(part: RobotPart) -> &'static str {
    match part {
        RobotPart::Base => "nav2_msgs/action/NavigateToPose",
        RobotPart::Torso | RobotPart::Arm(_) => "control_msgs/action/FollowJointTrajectory",
        RobotPart::Neck => "control_msgs/action/PointHead",
        RobotPart::Gripper(_) => "control_msgs/action/GripperCommand",
    }
}

/// A goal as a message. Poses are in the frame `map`; `camera` is the frame that is aimed. A trajectory begins when the stamp
/// says, by the robot's clock, or at once if that is zero.
pub(super) fn goal_message(goal: &PartGoal, map: &str, camera: &str, begin: Duration) -> Value {
    // A stamp of zero is now.
    let header = || message::header(Duration::ZERO, map);
    match goal {
        PartGoal::Drive(pose) => Value::record([(
            "pose",
            Value::record([("header", header()), ("pose", message::pose(pose))]),
        )]),
        PartGoal::Follow { joints, points } => {
            let points = points.iter().map(|point| {
                let time = Duration::try_from_secs_f64(point.time).unwrap_or_default();
                Value::record([
                    ("positions", Value::floats(point.positions.iter().copied())),
                    (
                        "velocities",
                        Value::floats(point.velocities.iter().copied()),
                    ),
                    ("time_from_start", message::time(time)),
                ])
            });
            Value::record([(
                "trajectory",
                Value::record([
                    ("header", message::header(begin, "")),
                    ("joint_names", Value::texts(joints.iter().cloned())),
                    ("points", Value::list(points)),
                ]),
            )])
        }
        PartGoal::Fingers { gap, effort } => Value::record([(
            "command",
            Value::record([
                ("position", (*gap).into()),
                ("max_effort", (*effort).into()),
            ]),
        )]),
        PartGoal::Aim([x, y, z]) => {
            let point = Value::record([("x", (*x).into()), ("y", (*y).into()), ("z", (*z).into())]);
            Value::record([
                (
                    "target",
                    Value::record([("header", header()), ("point", point)]),
                ),
                (
                    "pointing_axis",
                    Value::record([("x", 0.0.into()), ("y", 0.0.into()), ("z", 1.0.into())]),
                ),
                ("pointing_frame", camera.into()),
                ("max_velocity", HEAD_SPEED.into()),
            ])
        }
    }
}

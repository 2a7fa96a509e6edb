//! The atomic motions as jobs that are advanced step by step, and the planning of paths.
//!
//! Only this folder moves the robot. Nothing here knows of the plan language.

mod arm_axes;
pub mod arm_path;
mod arm_way;
pub mod base_path;
pub mod detect;
pub mod drive;
pub mod drive_plan;
pub mod expected_contacts;
pub mod failure;
mod follower;
pub mod gripper;
pub mod guard;
pub mod hold;
pub mod job;
mod joint_follow;
mod joint_limit;
mod judge;
pub mod look;
pub mod move_joints;
pub mod move_tcp;
pub mod move_torso;
mod patience;
pub mod put;
mod put_plan;
pub mod reach;
pub mod speeds;
pub mod tcp_line;
mod tcp_plan;
mod touching;
pub mod trajectory;
pub mod unreachable;

pub use detect::{Detect, DetectQuery};
pub use drive::Drive;
pub use expected_contacts::CollisionMode;
pub use failure::MotionFailure;
pub use gripper::{GripperCommand, MoveGripper};
pub use hold::{LetGo, held_objects, take_hold};
pub use job::{
    DetectedObject, Motion, MotionOutcome, MotionStatus, PlannedWay, ProcessModule, Progress,
    WayAxes,
};
pub use look::{Look, LookDirection, LookTarget, pan_and_tilt};
pub use move_joints::MoveJoints;
pub use move_tcp::{MoveTcp, TcpGoal, TcpPath};
pub use move_torso::MoveTorso;
pub use put::Put;
pub use reach::{can_reach, can_stand, touching_at};
pub use unreachable::{UnreachablePose, UnreachableReason};

//! The atomic motions: jobs that are advanced step by step. Only this folder moves the robot.

pub(crate) mod detect;
pub(crate) mod drive;
pub(crate) mod follow_trajectory;
pub(crate) mod grasp_path;
mod grip;
pub(crate) mod gripper;
pub(crate) mod job;
mod joint_follower;
mod joint_motion;
pub(crate) mod let_go;
pub(crate) mod look;
pub(crate) mod move_joints;
pub(crate) mod move_tcp;
pub(crate) mod move_torso;
pub(crate) mod pull;
pub(crate) mod put;
mod replanning;
mod standstill;
pub(crate) mod together;

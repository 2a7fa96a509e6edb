//! The atomic motions as jobs that are advanced step by step, and the planning of paths.
//!
//! Only this folder moves the robot. Nothing here knows of the plan language.

pub mod arm_path;
pub mod base_path;
pub mod drive;
pub mod failure;
mod follower;
pub mod guard;
pub mod job;
mod patience;
pub mod speeds;
pub mod trajectory;
pub mod unreachable;

pub use drive::Drive;
pub use failure::{LimitViolation, MotionFailure, Side};
pub use job::{DetectedObject, Motion, MotionOutcome, MotionStatus, ProcessModule, Progress};
pub use unreachable::{Unreachable, UnreachableReason};

//! The atomic motions as jobs that are advanced step by step, and the planning of paths.
//!
//! Only this folder moves the robot. Nothing here knows of the plan language.

pub mod arm_path;
pub mod base_path;
pub mod trajectory;

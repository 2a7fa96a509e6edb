//! The builtins on the world, one table per topic.

pub mod explaining;
pub mod grasps;
pub mod leaving;
pub mod moments;
pub mod objects;
mod picture_request;
pub mod pictures;
pub mod plans;
pub mod prompt;
pub mod reaching;
pub mod robot_macros;
pub mod ros;
pub mod tutorial;
pub mod watching;

//! The builtins on the world, one table per topic.

pub mod grasps;
pub mod leaving;
pub mod objects;
pub mod plans;
pub mod robot_macros;
pub mod ros;
pub mod tutorial;
pub mod watching;

//! The builtins on the world, one table per topic.

pub(crate) mod explaining;
pub(crate) mod grasps;
pub(crate) mod leaving;
pub(crate) mod objects;
mod picture_request;
pub(crate) mod pictures;
pub(crate) mod plans;
pub(crate) mod prompt;
pub(crate) mod reaching;
pub(crate) mod robot_macros;
pub(crate) mod ros;
pub(crate) mod snapshots;
pub(crate) mod tutorial;
pub(crate) mod watching;

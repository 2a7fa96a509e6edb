//! The builtins that act on the world, one table per topic.

mod asking;
mod carrying;
mod choosing;
mod containers;
mod contents;
mod explaining;
mod grasps;
mod kitchens;
mod leaving;
mod lessons;
mod locations;
mod noise;
mod object_record;
mod object_types;
mod objects;
mod picture_request;
mod pictures;
mod plans;
mod prompt;
mod reaching;
mod robot_macros;
mod robot_state;
mod ros;
mod scene;
mod serving;
mod sight;
mod snapshots;
mod sweep_things;
mod sweeps;
mod tables;
pub mod tour;
mod tutorial;
mod watching;

pub(super) use prompt::install_topics;
pub(super) use ros::name_system_folders;
pub(super) use tables::install;

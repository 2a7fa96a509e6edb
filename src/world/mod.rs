//! The physical world.
pub mod allowed_pairs;
pub mod body_name;
pub mod collision;
pub mod error;
pub mod hash;
mod link_geometry;
pub mod models;
pub mod object;
pub mod part_key;
pub mod physics;
pub mod robot_configuration;
pub mod roles;
pub mod scene;
mod separation;
mod solid;

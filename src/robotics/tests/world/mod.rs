//! The physical world.

mod carrying;
mod collisions;
mod contents;
mod derived_robots;
mod falling;
pub(crate) mod fixture;
mod grains;
mod kitchen_surfaces;
mod link_shapes;
mod motion;
mod objects;
mod packed;
mod robot_bodies;
mod self_touching;
mod sight;

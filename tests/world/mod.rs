//! The physical world.

mod collisions;
pub(crate) mod fixture;
mod kitchen_surfaces;
mod motion;
mod objects;
mod sight;

//! The physical world.

mod collisions;
pub(crate) mod kitchen;
mod motion;
mod objects;
mod sight;

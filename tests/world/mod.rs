//! The physical world.

mod collisions;
pub(crate) mod fixture;
mod motion;
mod objects;
mod sight;

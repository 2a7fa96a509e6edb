//! The physical world.
pub mod hash;
pub mod physics;
mod solid;

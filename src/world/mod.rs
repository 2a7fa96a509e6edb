//! The physical world.
pub mod grasp_library;
pub mod object_library;

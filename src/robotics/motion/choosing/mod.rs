//! Choices without moving: which grasp, which way to take a handle, and what is within reach from
//! where.

mod aligned_bases;
pub(crate) mod carrying_posture;
pub(crate) mod fitted_grasps;
pub(crate) mod grasp_candidates;
pub(crate) mod grasp_chooser;
pub(crate) mod grasp_reach;
mod hand_directions;
pub(crate) mod hand_reach;
mod hand_shape;
pub(crate) mod handle_chooser;
mod handle_grasps;
mod lone_hand;
pub(crate) mod overhead;
pub(crate) mod put_reach;
pub(crate) mod reach;
pub(crate) mod shape_grasps;
mod shoulder;
pub(crate) mod ungraspable;

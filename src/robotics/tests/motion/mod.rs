//! The atomic motions.

mod arms;
mod drive;
pub(crate) mod fixture;
mod follow_trajectory;
mod gripper;
mod hand_reach;
mod handles;
mod level;
mod look;
mod not_finite;
mod pick_and_place;
mod shape_grasps;
mod together;
mod torso;

//! The atomic motions.

mod arms;
pub(crate) mod bench;
mod drive;
mod gripper;
mod look;
mod not_finite;
mod pick_and_place;
mod together;

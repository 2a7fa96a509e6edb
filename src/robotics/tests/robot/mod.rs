//! The description of the robot and its kinematics.

mod chains;
mod description;
mod fetch;
mod forward_kinematics;
mod garbled_files;
mod hsr;
mod inverse_kinematics;
mod jaw_gap;
mod kitchen;
mod lenient_urdf;
mod numeric_kinematics;
mod reach;
mod urdf;

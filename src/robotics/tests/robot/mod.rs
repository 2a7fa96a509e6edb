//! The description of the robot and its kinematics.

mod description;
mod forward_kinematics;
mod garbled_files;
mod inverse_kinematics;
mod kitchen;
mod lenient_urdf;
mod reach;
mod urdf;

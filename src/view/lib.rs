//! What people get to see of a robot in its kitchen: pictures, recordings and the live view.

pub mod picture;
pub mod watch;

//! What the robot's camera sees.
//!
//! A picture is a z-buffer of body keys: which body each pixel shows, and how far away it is.
//! Nothing here moves anything or knows of the plan language.

pub(crate) mod camera;
pub(crate) mod mesh;
pub(crate) mod picture;
pub(crate) mod visibility;
mod window;

pub(crate) use camera::Camera;
pub(crate) use picture::Picture;
pub(crate) use visibility::{Sight, Visibility};

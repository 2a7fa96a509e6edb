//! What the robot's camera sees.
//!
//! A picture is a z-buffer of body keys: which body each pixel shows, and how far it is.
//! Nothing here moves anything or knows of the plan language.

pub mod camera;
pub mod mesh;
pub mod picture;
pub mod visibility;

pub use camera::Camera;
pub use picture::Picture;
pub use visibility::{Border, Sight, Visibility};

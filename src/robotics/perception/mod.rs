//! What the robot's camera sees.
//!
//! A picture is a z-buffer of body keys: which body each pixel shows, and how far away it is.
//! Nothing here moves anything or knows of the plan language.

pub mod camera;
pub mod mesh;
pub mod picture;
mod raster;
mod silhouette;
pub mod visibility;
mod window;

pub use camera::Camera;
pub use picture::Picture;
pub use visibility::{Sight, Visibility};

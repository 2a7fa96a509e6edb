//! Pictures of the world from any viewpoint, without a display or a graphics card.
//!
//! A [`Scene`] describes what is visible of a [`World`](robotics::world::World), a [`View`] the
//! viewpoint, and [`render`](render::render) makes an [`Image`] of the two. Nothing here
//! changes the world. The same world and view give the same bytes, however many threads draw.

pub mod animation;
pub mod camera_picture;
mod facet;
pub mod floor;
pub mod image;
mod inline;
mod lamp;
mod lettering;
mod location_map;
mod loft;
pub mod looks;
pub mod map_picture;
mod obstruction;
mod painter;
mod palette;
mod projector;
mod raster;
pub mod render;
pub mod scene;
pub mod shade;
mod smooth;
pub mod surface;
pub mod view;

pub use camera_picture::CameraPicture;
pub use image::Image;
pub use inline::InlinePictures;
pub use lettering::Line;
pub use location_map::LocationMap;
pub use looks::Looks;
pub use map_picture::{FloorMap, map_scene};
pub use obstruction::Obstruction;
pub use render::render;
pub use scene::Scene;
pub use view::{View, ViewError};

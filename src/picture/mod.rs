//! Pictures of the world from any viewpoint, without a display or a graphics card.
//!
//! A [`Scene`] describes what is visible of a [`World`](crate::world::World), a [`View`] the
//! viewpoint, and [`render`](render::render) makes an [`Image`] of the two. Nothing here
//! changes the world. The same world and view give the same bytes, however many threads draw.

pub(crate) mod animation;
pub(crate) mod camera_picture;
mod facet;
pub(crate) mod floor;
pub(crate) mod image;
mod inline;
mod lamp;
mod lettering;
mod location_map;
mod loft;
pub(crate) mod looks;
pub(crate) mod map_picture;
mod obstruction;
mod painter;
mod palette;
mod projector;
mod raster;
pub(crate) mod render;
pub(crate) mod scene;
pub(crate) mod shade;
mod smooth;
pub(crate) mod surface;
pub(crate) mod view;

pub(crate) use camera_picture::CameraPicture;
pub use image::Image;
pub(crate) use inline::InlinePictures;
pub(crate) use lettering::Line;
pub(crate) use location_map::LocationMap;
pub(crate) use looks::Looks;
pub(crate) use map_picture::{FloorMap, map_scene};
pub(crate) use obstruction::Obstruction;
pub(crate) use render::render;
pub(crate) use scene::Scene;
pub(crate) use view::{View, ViewError};

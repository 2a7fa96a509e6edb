//! Pictures of the world, from any place, without a display or a graphics card.
//!
//! A [`Scene`] says what there is to be seen of a [`World`](crate::world::World), a [`View`]
//! from where, [`render`](render::render) makes an [`Image`] of the two. Nothing here changes
//! the world. The same world and view give the same bytes, however many threads draw.

pub mod animation;
pub mod camera_picture;
mod facet;
pub mod image;
mod inline;
mod lamp;
mod lettering;
mod loft;
pub mod looks;
pub mod map_picture;
mod palette;
mod projector;
mod raster;
pub mod render;
pub mod scene;
mod shade;
mod smooth;
pub mod surface;
pub mod view;

pub use camera_picture::CameraPicture;
pub use image::Image;
pub use inline::InlinePictures;
pub use looks::Looks;
pub use map_picture::{FloorMap, map_scene};
pub use render::{render, segments};
pub use scene::{Body, Finish, Kind, Owner, Scene};
pub use surface::Surface;
pub use view::{View, ViewError};

//! Pictures of the world, from any place, without a display or a graphics card.
//!
//! A [`Scene`] says what there is to be seen of a [`World`](crate::world::World), a [`View`]
//! from where, [`render`](render::render) makes an [`Image`] of the two. Nothing here changes
//! the world. The same world and view give the same bytes, however many threads draw.

mod facet;
pub mod image;
mod lamp;
pub mod live;
mod projector;
mod raster;
pub mod recording;
pub mod render;
pub mod scene;
mod shade;
pub mod surface;
mod trim;
mod vessel;
pub mod view;
pub mod watch;

pub use image::Image;
pub use render::render;
pub use scene::{Body, Finish, Scene};
pub use surface::Surface;
pub use view::{View, ViewError};

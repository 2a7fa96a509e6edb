//! Triangle meshes from files: what a URDF shows with them, and the convex bodies that stand for them
//! where things collide.
//!
//! Reading is lenient as long as it is clear what is meant; what is broken is left out (triangles without
//! area, numbers that are none) or refused, soon and without much memory. Nothing depends on the number of
//! threads, and what is kept from earlier makes nothing but speed.

mod clean;
mod collada;
mod convex;
mod decompose;
mod error;
mod files;
mod format;
mod hull;
mod kept;
mod library;
mod locate;
mod part;
mod split;
mod stl;
mod wavefront;

pub use error::MeshError;
pub use files::{MeshFiles, NoMeshFiles};
pub use library::{MeshLibrary, MeshPurpose, MeshRequest};
pub use part::MeshPart;

//! Which fields the messages of a distribution have.

mod layouts;
mod reading;

pub use layouts::{Field, FieldType, Layouts, Multiplicity, Scalar};
pub use reading::LayoutError;

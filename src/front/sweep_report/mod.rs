//! What came of a sweep, as documents and pictures: for files, and for notebooks.

mod csv;
mod escape;
mod heat_map;
mod junit;
mod names;
mod page;

pub(crate) use csv::{csv, row};
pub(crate) use escape::escaped;
pub(crate) use heat_map::{axes, heat_map};
pub(crate) use junit::junit;
pub(crate) use page::{STYLE, fragment, html};

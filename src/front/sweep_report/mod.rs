//! What came of a sweep, as documents and pictures: for files, and for notebooks.

mod documents;
mod heat_map;

pub(crate) use documents::{csv, escaped, fragment, html, junit};
pub(crate) use heat_map::{axes, heat_map};

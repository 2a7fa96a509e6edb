//! The room inside things whose solids are closed: cartons and bottles once they are opened, and shakers.

use crate::sexp::{DataError, Record};

/// The kinds of openings, each with its keys.
const OPENINGS: &[(&str, &[&str])] = &[
    ("opening", &["radius", "wall"]),
    ("holes", &["radius", "wall", "portion"]),
];

/// What is inside something, behind the middle of its top.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inside {
    /// Radius (m) of the opening, or of the part of the top that has holes.
    pub radius: f64,
    /// How thick (m) walls, bottom and top are.
    pub wall: f64,
    /// How much (ml) falls out of holes each time it is shaken; `None` for an opening.
    pub portion: Option<f64>,
}

/// What the record of a type says of its inside: `:inside (opening :radius :wall)`, or
/// `:inside (holes :radius :wall :portion)`.
pub(super) fn inside_of(record: &Record<'_>) -> Result<Option<Inside>, DataError> {
    let Some(node) = record.optional("inside") else {
        return Ok(None);
    };
    let inside = node.record("opening", OPENINGS)?;
    let portion = match inside.head() {
        "holes" => Some(inside.required("portion")?.positive()?),
        _ => None,
    };
    Ok(Some(Inside {
        radius: inside.required("radius")?.positive()?,
        wall: inside.required("wall")?.positive()?,
        portion,
    }))
}

//! What types of actions and motions there are, and which keys they take.
//!
//! The one table that resolution, checks, completion, hints, help and the manual read. An
//! image has its own: actions come into it by `def-action`, the program's own and those of
//! users alike; motions are put there by whoever can carry them out. A type may have several
//! rows, told apart by the keys that are required.

mod described;
mod kind;
mod row;
mod types;

pub(crate) use described::{LOCATION_KEYS, OBJECT_KEYS};
pub(crate) use kind::Kind;
pub(crate) use row::{Key, Text, TypeRow};
pub(crate) use types::{all, define, install, is_type, nearest_type, rows};

/// Keys that every designator of a class takes, beside those of its type.
pub(crate) const COMMON_KEYS: &[&str] = &["TYPE", "GOAL", "FOR", "DESCRIPTION"];

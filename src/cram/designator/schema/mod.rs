//! The types of actions and motions, and the keys that they take.
//!
//! The single table used for resolution, checks, completion, hints, help and the manual. Every
//! image has its own: `def-action` adds actions, both the built-in ones and those of users; the
//! host adds the motions that it can carry out. A type may have several rows, distinguished by the
//! keys they require.

mod described;
mod kind;
mod row;
mod types;

pub use described::{LOCATION_KEYS, OBJECT_KEYS};
pub use kind::Kind;
pub use row::{Key, Text, TypeRow};
pub(crate) use types::nearest_type;
pub use types::{all, define, install, is_type, rows};

/// Keys that every designator of a class takes, in addition to those of its type.
pub(crate) const COMMON_KEYS: &[&str] = &["TYPE", "GOAL", "FOR", "DESCRIPTION"];

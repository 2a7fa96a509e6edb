//! `coerce`.

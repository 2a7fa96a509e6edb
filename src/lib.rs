//! planwright.

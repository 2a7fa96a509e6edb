//! The symbols of the types of poses.

use lisp::value::known::spare;
use lisp::value::symbol::Sym;

/// The symbol `3D-VECTOR`.
pub const VECTOR_3D: Sym = spare(0);
/// The symbol `QUATERNION`.
pub(crate) const QUATERNION: Sym = spare(1);
/// The symbol `POSE`.
pub const POSE: Sym = spare(2);
/// The symbol `TRANSFORM`.
pub(crate) const TRANSFORM: Sym = spare(3);
/// The symbol `POSE-STAMPED`.
pub(crate) const POSE_STAMPED: Sym = spare(4);
/// The symbol `TRANSFORM-STAMPED`.
pub(crate) const TRANSFORM_STAMPED: Sym = spare(5);

//! The symbols of the types of poses.

use lisp::value::known::spare;
use lisp::value::symbol::Sym;

/// The symbol `3D-VECTOR`.
pub const VECTOR_3D: Sym = spare(0);
/// The symbol `QUATERNION`.
pub const QUATERNION: Sym = spare(1);
/// The symbol `POSE`.
pub const POSE: Sym = spare(2);
/// The symbol `TRANSFORM`.
pub const TRANSFORM: Sym = spare(3);
/// The symbol `POSE-STAMPED`.
pub const POSE_STAMPED: Sym = spare(4);
/// The symbol `TRANSFORM-STAMPED`.
pub const TRANSFORM_STAMPED: Sym = spare(5);

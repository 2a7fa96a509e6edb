//! Builtins as typed Rust functions: what the code that `#[builtin]` makes names, and how arguments
//! and results are converted.

mod from_value;
mod host;
pub(crate) mod keywords;
mod returned;

pub use planwright_lisp_macros::{builtin, builtins};

pub use crate::builtin::Builtin;
pub use crate::image::Image;
pub use crate::native::BuiltinCall;
pub use crate::value::Value;
pub use crate::value::raise::Raise;
pub use crate::vm::calls::run;
pub use crate::vm::machine::Machine;
pub use crate::vm::step::Step;
pub use from_value::{FromValue, all, designated, keys, keyword, optional, required, wrong_count};
pub use host::{Host, HostCall, HostFn, HostOf, Owner, ReplyTo};
pub use returned::Returned;

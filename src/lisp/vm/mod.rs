//! What runs Lisp, as data: the machine with its fiber, and the steps that builtins tell it
//! to take. [`super::evaluator`] takes them.

pub(crate) mod callable;
pub(crate) mod calls;
pub(crate) mod computation;
pub(crate) mod fiber;
pub(crate) mod machine;
pub(crate) mod step;

//! The data of what runs Lisp: the machine with its fiber, and the steps that builtins ask it to
//! take. [`super::evaluator`] carries them out.

pub(crate) mod callable;
pub(crate) mod calls;
pub(crate) mod computation;
pub(crate) mod fiber;
pub(crate) mod frames;
pub(crate) mod machine;
pub(crate) mod stack;
pub(crate) mod step;

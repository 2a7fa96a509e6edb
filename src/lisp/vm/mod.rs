//! The data of what runs Lisp: the machine with its fiber, and the steps that builtins ask it to
//! take. [`super::evaluator`] carries them out.

pub mod callable;
pub mod calls;
pub mod computation;
pub mod fiber;
pub mod frames;
pub mod machine;
pub mod stack;
pub mod step;

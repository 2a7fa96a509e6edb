//! The machine: one fiber running on one image.
//!
//! Calls of Lisp functions never recurse on the Rust stack. The machine stops when the fiber is
//! done, when a builtin makes a request to the code that runs the fiber, when a condition has found
//! no handler (the stack is still there), or on an interrupt.

use std::any::Any;

use super::fiber::Fiber;
use crate::image::Image;
use crate::value::Value;

/// A fiber that runs on an image.
pub struct Machine<'a> {
    pub image: &'a mut Image,
    pub fiber: &'a mut Fiber,
}

/// Why the machine stopped.
pub enum Event {
    /// The fiber's function returned (`Value::Multiple` unless exactly one value).
    Done(Value),
    /// A builtin made a request; `resume` takes the answer.
    Request(Box<dyn Any>),
    /// A condition was signalled by `error` and no handler took it. The fiber can be
    /// resumed with a value in place of the failed call, or unwound.
    Unhandled(Value),
    /// The interrupt flag was set; `run` continues.
    Interrupted,
    /// The program has written something that is to be shown now; `run` goes on.
    Output,
    /// An unwinding of everything has ended.
    Unwound,
}

impl<'a> Machine<'a> {
    /// A machine for a fiber.
    pub fn new(image: &'a mut Image, fiber: &'a mut Fiber) -> Machine<'a> {
        Machine { image, fiber }
    }
}

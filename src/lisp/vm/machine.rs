//! The machine: one fiber running on one image.

use super::fiber::Fiber;
use crate::lisp::image::Image;

/// A fiber that runs on an image.
pub struct Machine<'a> {
    /// The image.
    pub image: &'a mut Image,
    /// The fiber.
    pub fiber: &'a mut Fiber,
}

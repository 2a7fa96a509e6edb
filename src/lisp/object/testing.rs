//! A small image for the tests of this layer.

use crate::lisp::image::Image;

/// An image as sessions start with.
pub fn image() -> Image {
    Image::new()
}

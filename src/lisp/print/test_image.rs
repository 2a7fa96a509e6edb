//! A small image for unit tests.

use crate::lisp::image::Image;

/// An image as sessions start with, in `COMMON-LISP-USER`.
pub(crate) fn image() -> Image {
    Image::new()
}

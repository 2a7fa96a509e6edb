//! A small image for unit tests.

use crate::image::Image;

/// An image like the one that sessions start with, in `COMMON-LISP-USER`.
pub(crate) fn image() -> Image {
    Image::new()
}

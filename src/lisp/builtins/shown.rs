//! How values appear in the messages of errors.

use crate::image::Image;
use crate::print;
use crate::value::Value;

/// A value as `prin1` prints it.
pub fn shown(image: &Image, value: &Value) -> String {
    print::to_string(image, value, true)
}

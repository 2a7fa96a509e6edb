//! How values appear in the messages of errors.

use crate::lisp::image::Image;
use crate::lisp::print;
use crate::lisp::value::Value;

/// A value as `prin1` prints it.
pub(crate) fn shown(image: &Image, value: &Value) -> String {
    print::to_string(image, value, true)
}

//! Reading properties of designators.

use cram::designator::value::as_designator;
use lisp::image::Image;
use lisp::value::Value;

/// The first value of a designator's property, unless it is `NIL`. The key is in upper
/// case.
pub(crate) fn property(image: &Image, designator: &Value, key: &str) -> Option<Value> {
    as_designator(designator)?
        .property_named(image, key)
        .filter(Value::is_true)
}

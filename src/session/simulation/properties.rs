//! Reading properties of designators.

use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::plan::designator::value::as_designator;

/// The first value of a designator's property, unless it is `NIL`. The key is in upper
/// case.
pub(in crate::session) fn property(image: &Image, designator: &Value, key: &str) -> Option<Value> {
    as_designator(designator)?
        .property_named(image, key)
        .filter(Value::is_true)
}

//! Errors about indices of arrays.

use crate::value::Value;
use crate::value::element_type::ElementType;
use crate::value::known;
use crate::value::raise::Raise;

/// "Invalid index 5 for (SIMPLE-VECTOR 2), should be a non-negative integer below 2."
pub(crate) fn invalid(array: &Value, index: &Value, bound: usize) -> Box<Raise> {
    invalid_on_axis(array, index, None, bound)
}

/// The same for one of several dimensions.
pub(crate) fn invalid_on_axis(
    array: &Value,
    index: &Value,
    axis: Option<usize>,
    bound: usize,
) -> Box<Raise> {
    let shown = match index {
        Value::Int(n) => n.to_string(),
        Value::Big(n) => n.to_string(),
        _ => {
            return Raise::type_error(
                index,
                Value::list([
                    known::INTEGER.into(),
                    Value::Int(0),
                    Value::list([bound.into()]),
                ]),
            );
        }
    };
    let axis = axis
        .map(|axis| format!("axis {axis} of "))
        .unwrap_or_default();
    Raise::new(
        known::TYPE_ERROR,
        format!(
            "Invalid index {shown} for {axis}{}, should be a non-negative integer below {bound}.",
            type_name(array)
        ),
    )
    .with(known::K_DATUM, index.clone())
    .with(
        known::K_EXPECTED_TYPE,
        Value::list([
            known::INTEGER.into(),
            Value::Int(0),
            Value::list([bound.into()]),
        ]),
    )
}

/// The type of an array as messages show it.
fn type_name(array: &Value) -> String {
    match array {
        Value::Vector(v) => {
            let size = v.items.len();
            match (v.is_simple(), v.element_type) {
                (true, ElementType::T) => format!("(SIMPLE-VECTOR {size})"),
                (true, ElementType::Bit) => format!("(SIMPLE-BIT-VECTOR {size})"),
                (true, other) => format!("(SIMPLE-ARRAY {} ({size}))", other),
                (false, other) => {
                    format!("(AND (VECTOR {} {size}) (NOT SIMPLE-ARRAY))", other)
                }
            }
        }
        Value::Str(s) if !s.is_simple() => {
            format!(
                "(AND (VECTOR CHARACTER {}) (NOT SIMPLE-ARRAY))",
                s.capacity()
            )
        }
        Value::Str(s) => format!("(SIMPLE-ARRAY CHARACTER ({}))", s.len()),
        Value::Array(a) => {
            let dimensions: Vec<String> = a
                .dimensions
                .borrow()
                .iter()
                .map(ToString::to_string)
                .collect();
            format!(
                "(SIMPLE-ARRAY {} ({}))",
                a.element_type,
                dimensions.join(" ")
            )
        }
        _ => "an array".to_owned(),
    }
}

//! Arrays with dimensions and element type, as `*print-readably*` prints them:
//! `#A((2) (UNSIGNED-BYTE 8) 1 2)`.

use std::rc::Rc;

use super::error::ReadErrorKind;
use super::literal::elements;
use crate::guard::MAX_ELEMENTS;
use crate::value::Value;
use crate::value::array::{Array, Vector};
use crate::value::element_type::ElementType;

/// The array from the list after `#A`.
pub(super) fn read(parts: &Value) -> Result<Value, ReadErrorKind> {
    if !matches!(parts, Value::Cons(_)) {
        return Err(ReadErrorKind::BadArray("it is not such a list"));
    }
    let dimensions = dimensions(&parts.car_or_nil())?;
    let rest = parts.cdr_or_nil();
    let element = element_type(&rest.car_or_nil())?;
    let mut level = vec![rest.cdr_or_nil()];
    for size in &dimensions {
        let rows = level.iter().map(elements).collect::<Option<Vec<_>>>();
        let rows = rows.filter(|rows| rows.iter().all(|row| row.len() == *size));
        let rows = rows.ok_or(ReadErrorKind::BadArray(
            "its contents have other dimensions",
        ))?;
        level = rows.into_iter().flatten().collect();
    }
    if !level.iter().all(|item| element.holds(item)) {
        return Err(ReadErrorKind::BadArray("it has elements of another type"));
    }
    Ok(match (dimensions.as_slice(), element) {
        ([_], ElementType::Character) => {
            let text = level.iter().filter_map(|item| match item {
                Value::Char(c) => Some(*c),
                _ => None,
            });
            Value::string(text.collect::<String>())
        }
        ([_], _) => Value::Vector(Rc::new(Vector::of_type(element, level))),
        _ => Value::Array(Rc::new(Array::new(element, dimensions, level))),
    })
}

fn dimensions(list: &Value) -> Result<Vec<usize>, ReadErrorKind> {
    let bad = || {
        ReadErrorKind::BadArray("its dimensions are not a list of natural numbers in the limits")
    };
    let sizes = list.list_to_vec().ok_or_else(bad)?;
    let size = |value: &Value| match value {
        Value::Int(n) => usize::try_from(*n).ok().filter(|n| *n <= MAX_ELEMENTS),
        _ => None,
    };
    sizes
        .iter()
        .map(size)
        .collect::<Option<_>>()
        .ok_or_else(bad)
}

fn element_type(specifier: &Value) -> Result<ElementType, ReadErrorKind> {
    let mut all = std::iter::once(ElementType::T).chain(ElementType::specialized());
    all.find(|element| is_same(&element.specifier(), specifier))
        .ok_or(ReadErrorKind::BadArray(
            "there are no arrays of its element type",
        ))
}

/// Are two specifiers the same symbol, or lists of the same symbols and numbers?
fn is_same(one: &Value, other: &Value) -> bool {
    match (one.list_to_vec(), other.list_to_vec()) {
        (Some(ones), Some(others)) if !ones.is_empty() => {
            ones.len() == others.len() && ones.iter().zip(&others).all(|(a, b)| a.is_eql(b))
        }
        _ => one.is_eql(other),
    }
}

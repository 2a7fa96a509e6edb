//! Arrays of any rank: access, shape, kinds.

use std::slice;

use super::array_index;
use crate::builtin::Builtin;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::cycles;
use crate::value::element_type::ElementType;
use crate::value::elements::displacement;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::sequence::{checked_element, index};

type Outcome = Result<Value, Box<Raise>>;

/// Sizes of an array's dimensions; a fill pointer does not count.
pub(crate) fn dimensions(array: &Value) -> Result<Vec<usize>, Box<Raise>> {
    match array {
        Value::Vector(v) => Ok(vec![v.items.len()]),
        Value::Str(s) => Ok(vec![s.capacity()]),
        Value::Array(a) => Ok(a.dimensions.borrow().clone()),
        _ => Err(Raise::type_error(array, known::ARRAY)),
    }
}

/// The element type that an array has.
pub(crate) fn element_type(array: &Value) -> Result<ElementType, Box<Raise>> {
    match array {
        Value::Vector(v) => Ok(v.element_type),
        Value::Str(_) => Ok(ElementType::Character),
        Value::Array(a) => Ok(a.element_type),
        _ => Err(Raise::type_error(array, known::ARRAY)),
    }
}

/// Index in row-major order of the element with these subscripts.
fn row_major_index(array: &Value, subscripts: &[Value]) -> Result<usize, Box<Raise>> {
    if let ([subscript], Value::Vector(v)) = (subscripts, array) {
        let size = v.items.len();
        return match subscript {
            Value::Int(n) if usize::try_from(*n).is_ok_and(|n| n < size) => index(subscript),
            _ => Err(array_index::invalid(array, subscript, size)),
        };
    }
    let dimensions = dimensions(array)?;
    if dimensions.len() != subscripts.len() {
        return Err(Raise::program(format!(
            "Wrong number of subscripts, {}, for an array of rank {}.",
            subscripts.len(),
            dimensions.len()
        )));
    }
    let mut at = 0;
    for (axis, (subscript, size)) in subscripts.iter().zip(&dimensions).enumerate() {
        let i = match subscript {
            Value::Int(n) => usize::try_from(*n).ok().filter(|i| i < size),
            _ => None,
        };
        let Some(i) = i else {
            let axis = (dimensions.len() > 1).then_some(axis);
            return Err(array_index::invalid_on_axis(array, subscript, axis, *size));
        };
        at = at * size + i;
    }
    Ok(at)
}

/// The element at an index in row-major order.
pub(super) fn row_major(array: &Value, at: usize) -> Option<Value> {
    match array {
        Value::Vector(v) => v.get(at),
        Value::Str(s) => s.element(at).map(Value::Char),
        Value::Array(a) => a.items.get(at),
        _ => None,
    }
}

fn set_row_major(array: &Value, at: usize, value: &Value) -> Outcome {
    let value = checked_element(element_type(array)?, value.clone())?;
    let holder = displacement(array).and_then(|displacement| displacement.holder(at));
    match holder.as_ref().map_or(array, |(holder, _)| holder) {
        Value::Vector(vector) => cycles::note(vector, &value),
        Value::Array(array) => cycles::note(array, &value),
        _ => {}
    }
    let done = match (array, &value) {
        (Value::Vector(v), _) => v.set(at, value.clone()),
        (Value::Str(s), Value::Char(c)) => s.set_element(at, *c),
        (Value::Array(a), _) => a.items.set(at, value.clone()),
        _ => false,
    };
    if done {
        Ok(value)
    } else {
        Err(array_index::invalid(array, &at.into(), total_size(array)?))
    }
}

pub(super) fn total_size(array: &Value) -> Result<usize, Box<Raise>> {
    Ok(dimensions(array)?.iter().product())
}

/// The element of an array at subscripts from 0.
///
/// `(aref #(1 2 3) 2)` => `3`
/// `(aref #2A((1 2) (3 4)) 1 0)` => `3`
#[builtin]
fn aref(array: &Value, subscripts: &[Value]) -> Outcome {
    let at = row_major_index(array, subscripts)?;
    match row_major(array, at) {
        Some(value) => Ok(value),
        None => Err(array_index::invalid(array, &at.into(), total_size(array)?)),
    }
}

/// Replaces an element.
#[builtin("AREF")]
fn set_aref(value: &Value, array: &Value, subscripts: &[Value]) -> Outcome {
    let at = row_major_index(array, subscripts)?;
    set_row_major(array, at, value)
}

/// The element of a simple vector.
///
/// `(svref #(1 2 3) 1)` => `2`
#[builtin]
fn svref(vector: &Value, index: &Value) -> Outcome {
    if is_simple_vector(vector) {
        aref(vector, slice::from_ref(index))
    } else {
        Err(Raise::type_error(vector, known::SIMPLE_VECTOR))
    }
}

/// Replaces an element.
#[builtin("SVREF")]
fn set_svref(value: &Value, vector: &Value, index: &Value) -> Outcome {
    if is_simple_vector(vector) {
        set_aref(value, vector, slice::from_ref(index))
    } else {
        Err(Raise::type_error(vector, known::SIMPLE_VECTOR))
    }
}

/// The element of a bit array.
///
/// `(bit #*1010 0)` => `1`
#[builtin]
fn bit(array: &Value, subscripts: &[Value]) -> Outcome {
    if element_type(array)? == ElementType::Bit {
        aref(array, subscripts)
    } else {
        Err(Raise::type_error(array, bit_array_type()))
    }
}

/// Replaces an element.
#[builtin("BIT")]
fn set_bit(value: &Value, array: &Value, subscripts: &[Value]) -> Outcome {
    if element_type(array)? == ElementType::Bit {
        set_aref(value, array, subscripts)
    } else {
        Err(Raise::type_error(array, bit_array_type()))
    }
}

/// `(array bit)`.
pub(crate) fn bit_array_type() -> Value {
    Value::list([known::ARRAY.into(), known::BIT.into()])
}

/// The element of an array seen as a vector.
///
/// `(row-major-aref #2A((1 2) (3 4)) 2)` => `3`
#[builtin(_, "array index")]
fn row_major_aref(array: &Value, index_value: &Value) -> Outcome {
    match row_major(array, index(index_value)?) {
        Some(value) => Ok(value),
        None => Err(array_index::invalid(array, index_value, total_size(array)?)),
    }
}

/// Replaces an element.
#[builtin("ROW-MAJOR-AREF")]
fn set_row_major_aref(value: &Value, array: &Value, index: usize) -> Outcome {
    set_row_major(array, index, value)
}

/// The index of an element of an array seen as a vector.
///
/// `(array-row-major-index #2A((1 2) (3 4)) 1 0)` => `2`
#[builtin]
fn array_row_major_index(array: &Value, subscripts: &[Value]) -> Outcome {
    row_major_index(array, subscripts).map(Value::from)
}

/// The number of dimensions.
///
/// `(array-rank #2A((1)))` => `2`
#[builtin]
fn array_rank(array: &Value) -> Outcome {
    Ok(dimensions(array)?.len().into())
}

/// The sizes of all dimensions.
///
/// `(array-dimensions #2A((1 2 3)))` => `(1 3)`
#[builtin]
fn array_dimensions(array: &Value) -> Outcome {
    Ok(Value::list(dimensions(array)?.into_iter().map(Value::from)))
}

/// The size of a dimension.
///
/// `(array-dimension #(1 2) 0)` => `2`
#[builtin]
fn array_dimension(array: &Value, axis: usize) -> Outcome {
    let dimensions = dimensions(array)?;
    match dimensions.get(axis) {
        Some(size) => Ok((*size).into()),
        None => Err(Raise::simple(format!(
            "Axis {} is too large; the array has rank {}.",
            axis,
            dimensions.len()
        ))),
    }
}

/// The number of elements.
///
/// `(array-total-size #2A((1 2) (3 4)))` => `4`
#[builtin]
fn array_total_size(array: &Value) -> Outcome {
    Ok(total_size(array)?.into())
}

/// Is there an element at these subscripts?
///
/// `(array-in-bounds-p #(1 2 3) 3)` => `NIL`
#[builtin]
fn array_in_bounds_p(array: &Value, subscripts: &[Value]) -> Result<bool, Box<Raise>> {
    let dimensions = dimensions(array)?;
    if dimensions.len() != subscripts.len() {
        // The wrong number of subscripts is an error, not out of bounds.
        row_major_index(array, subscripts)?;
    }
    Ok(subscripts.iter().zip(dimensions).all(|(i, size)| match i {
        Value::Int(n) => usize::try_from(*n).is_ok_and(|n| n < size),
        _ => false,
    }))
}

/// The type of the elements.
///
/// `(array-element-type "a")` => `CHARACTER`
#[builtin]
fn array_element_type(array: &Value) -> Outcome {
    element_type(array).map(ElementType::specifier)
}

/// Can the array be adjusted in place?
pub(super) fn is_adjustable(array: &Value) -> bool {
    match array {
        Value::Vector(v) => v.adjustable || v.fill_pointer.get().is_some(),
        Value::Str(s) => s.has_fill_pointer.get() || s.adjustable.get(),
        Value::Array(a) => a.adjustable,
        _ => false,
    }
}

/// Can the array be adjusted in place?
///
/// `(adjustable-array-p #(1))` => `NIL`
#[builtin]
fn adjustable_array_p(array: &Value) -> Outcome {
    element_type(array)?;
    Ok(Value::bool(is_adjustable(array)))
}

/// The array that an array shares its elements with, or `NIL`, and the index of the first of them.
///
/// `(array-displacement #(1))` => `NIL ; 0`
/// `(array-displacement (make-array 2 :displaced-to #(1 2 3) :displaced-index-offset 1))` => `#(1 2 3) ; 1`
#[builtin]
fn array_displacement(array: &Value) -> Outcome {
    element_type(array)?;
    let (target, offset) = match displacement(array) {
        Some(displacement) => (displacement.target.clone(), displacement.offset),
        None => (Value::NIL, 0),
    };
    Ok(Value::values(vec![target, offset.into()]))
}

/// Is the object an array?
///
/// `(arrayp "a")` => `T`
#[builtin]
fn arrayp(object: &Value) -> bool {
    dimensions(object).is_ok()
}

/// Is the object a vector?
///
/// `(vectorp #2A((1)))` => `NIL`
#[builtin]
fn vectorp(object: &Value) -> bool {
    matches!(object, Value::Vector(_) | Value::Str(_))
}

/// Is this a vector without a fill pointer whose elements may be anything?
fn is_simple_vector(value: &Value) -> bool {
    matches!(value, Value::Vector(v) if v.element_type == ElementType::T && v.is_simple())
}

/// Is the object a simple vector?
///
/// `(simple-vector-p #(1))` => `T`
#[builtin]
fn simple_vector_p(object: &Value) -> bool {
    is_simple_vector(object)
}

fn is_bit_vector(value: &Value) -> bool {
    matches!(value, Value::Vector(v) if v.element_type == ElementType::Bit)
}

/// Is the object a bit vector?
///
/// `(bit-vector-p #*1)` => `T`
#[builtin]
fn bit_vector_p(object: &Value) -> bool {
    is_bit_vector(object)
}

/// Is the object a simple bit vector?
///
/// `(simple-bit-vector-p #*1)` => `T`
#[builtin]
fn simple_bit_vector_p(object: &Value) -> bool {
    matches!(object, Value::Vector(v) if v.element_type == ElementType::Bit && v.is_simple())
}

/// The element of a bit array.
///
/// `(sbit #*1010 1)` => `0`
#[builtin]
fn sbit(array: &Value, subscripts: &[Value]) -> Outcome {
    bit(array, subscripts)
}

/// Replaces an element.
#[builtin("SBIT")]
fn set_sbit(value: &Value, array: &Value, subscripts: &[Value]) -> Outcome {
    set_bit(value, array, subscripts)
}

/// Arrays.
pub(crate) static TABLE: &[Builtin] = builtins![
    aref,
    svref,
    bit,
    sbit,
    row_major_aref,
    array_row_major_index,
    array_rank,
    array_dimensions,
    array_dimension,
    array_total_size,
    array_in_bounds_p,
    array_element_type,
    adjustable_array_p,
    array_displacement,
    arrayp,
    vectorp,
    simple_vector_p,
    bit_vector_p,
    simple_bit_vector_p,
];

/// Places for `setf`; the new value is the first argument.
pub(crate) static SETTERS: &[Builtin] =
    builtins![set_aref, set_svref, set_bit, set_sbit, set_row_major_aref,];

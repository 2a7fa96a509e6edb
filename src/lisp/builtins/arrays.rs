//! Arrays of any rank: access, shape, kinds.

use super::array_index;
use crate::lisp::builtin::Builtin;
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::cycles;
use crate::lisp::value::element_type::ElementType;
use crate::lisp::value::elements::displacement;
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;
use crate::lisp::value::sequence::{checked_element, index};
use crate::lisp::{builtin, builtins};

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
#[builtin(_, "array &rest subscripts")]
fn aref(_: &mut Image, args: &[Value]) -> Outcome {
    let at = row_major_index(&args[0], &args[1..])?;
    match row_major(&args[0], at) {
        Some(value) => Ok(value),
        None => Err(array_index::invalid(
            &args[0],
            &at.into(),
            total_size(&args[0])?,
        )),
    }
}

/// Replaces an element.
#[builtin("AREF", "value array &rest subscripts")]
fn set_aref(_: &mut Image, args: &[Value]) -> Outcome {
    let at = row_major_index(&args[1], &args[2..])?;
    set_row_major(&args[1], at, &args[0])
}

/// The element of a simple vector.
///
/// `(svref #(1 2 3) 1)` => `2`
#[builtin(_, "vector index")]
fn svref(image: &mut Image, args: &[Value]) -> Outcome {
    if is_simple_vector(&args[0]) {
        aref(image, args)
    } else {
        Err(Raise::type_error(&args[0], known::SIMPLE_VECTOR))
    }
}

/// Replaces an element.
#[builtin("SVREF", "value vector index")]
fn set_svref(image: &mut Image, args: &[Value]) -> Outcome {
    if is_simple_vector(&args[1]) {
        set_aref(image, args)
    } else {
        Err(Raise::type_error(&args[1], known::SIMPLE_VECTOR))
    }
}

/// The element of a bit array.
///
/// `(bit #*1010 0)` => `1`
#[builtin(_, "array &rest subscripts")]
fn bit(image: &mut Image, args: &[Value]) -> Outcome {
    if element_type(&args[0])? == ElementType::Bit {
        aref(image, args)
    } else {
        Err(Raise::type_error(&args[0], bit_array_type()))
    }
}

/// Replaces an element.
#[builtin("BIT", "value array &rest subscripts")]
fn set_bit(image: &mut Image, args: &[Value]) -> Outcome {
    if element_type(&args[1])? == ElementType::Bit {
        set_aref(image, args)
    } else {
        Err(Raise::type_error(&args[1], bit_array_type()))
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
fn row_major_aref(_: &mut Image, args: &[Value]) -> Outcome {
    match row_major(&args[0], index(&args[1])?) {
        Some(value) => Ok(value),
        None => Err(array_index::invalid(
            &args[0],
            &args[1],
            total_size(&args[0])?,
        )),
    }
}

/// Replaces an element.
#[builtin("ROW-MAJOR-AREF", "value array index")]
fn set_row_major_aref(_: &mut Image, args: &[Value]) -> Outcome {
    set_row_major(&args[1], index(&args[2])?, &args[0])
}

/// The index of an element of an array seen as a vector.
///
/// `(array-row-major-index #2A((1 2) (3 4)) 1 0)` => `2`
#[builtin(_, "array &rest subscripts")]
fn array_row_major_index(_: &mut Image, args: &[Value]) -> Outcome {
    row_major_index(&args[0], &args[1..]).map(Value::from)
}

/// The number of dimensions.
///
/// `(array-rank #2A((1)))` => `2`
#[builtin(_, "array")]
fn array_rank(_: &mut Image, args: &[Value]) -> Outcome {
    Ok(dimensions(&args[0])?.len().into())
}

/// The sizes of all dimensions.
///
/// `(array-dimensions #2A((1 2 3)))` => `(1 3)`
#[builtin(_, "array")]
fn array_dimensions(_: &mut Image, args: &[Value]) -> Outcome {
    Ok(Value::list(
        dimensions(&args[0])?.into_iter().map(Value::from),
    ))
}

/// The size of a dimension.
///
/// `(array-dimension #(1 2) 0)` => `2`
#[builtin(_, "array axis")]
fn array_dimension(_: &mut Image, args: &[Value]) -> Outcome {
    let dimensions = dimensions(&args[0])?;
    match dimensions.get(index(&args[1])?) {
        Some(size) => Ok((*size).into()),
        None => Err(Raise::simple(format!(
            "Axis {} is too large; the array has rank {}.",
            index(&args[1])?,
            dimensions.len()
        ))),
    }
}

/// The number of elements.
///
/// `(array-total-size #2A((1 2) (3 4)))` => `4`
#[builtin(_, "array")]
fn array_total_size(_: &mut Image, args: &[Value]) -> Outcome {
    Ok(total_size(&args[0])?.into())
}

/// Is there an element at these subscripts?
///
/// `(array-in-bounds-p #(1 2 3) 3)` => `NIL`
#[builtin(_, "array &rest subscripts")]
fn array_in_bounds_p(_: &mut Image, args: &[Value]) -> Outcome {
    let dimensions = dimensions(&args[0])?;
    if dimensions.len() != args.len() - 1 {
        // The wrong number of subscripts is an error, not out of bounds.
        row_major_index(&args[0], &args[1..])?;
    }
    let inside = args[1..].iter().zip(dimensions).all(|(i, size)| match i {
        Value::Int(n) => usize::try_from(*n).is_ok_and(|n| n < size),
        _ => false,
    });
    Ok(Value::bool(inside))
}

/// The type of the elements.
///
/// `(array-element-type "a")` => `CHARACTER`
#[builtin(_, "array")]
fn array_element_type(_: &mut Image, args: &[Value]) -> Outcome {
    element_type(&args[0]).map(ElementType::specifier)
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
#[builtin(_, "array")]
fn adjustable_array_p(_: &mut Image, args: &[Value]) -> Outcome {
    element_type(&args[0])?;
    Ok(Value::bool(is_adjustable(&args[0])))
}

/// The array that an array shares its elements with, or `NIL`, and the index of the first of them.
///
/// `(array-displacement #(1))` => `NIL ; 0`
/// `(array-displacement (make-array 2 :displaced-to #(1 2 3) :displaced-index-offset 1))` => `#(1 2 3) ; 1`
#[builtin(_, "array")]
fn array_displacement(_: &mut Image, args: &[Value]) -> Outcome {
    element_type(&args[0])?;
    let (target, offset) = match displacement(&args[0]) {
        Some(displacement) => (displacement.target.clone(), displacement.offset),
        None => (Value::NIL, 0),
    };
    Ok(Value::values(vec![target, offset.into()]))
}

/// Is the object an array?
///
/// `(arrayp "a")` => `T`
#[builtin(_, "object")]
fn arrayp(_: &mut Image, args: &[Value]) -> Outcome {
    Ok(Value::bool(dimensions(&args[0]).is_ok()))
}

/// Is the object a vector?
///
/// `(vectorp #2A((1)))` => `NIL`
#[builtin(_, "object")]
fn vectorp(_: &mut Image, args: &[Value]) -> Outcome {
    Ok(Value::bool(matches!(
        args[0],
        Value::Vector(_) | Value::Str(_)
    )))
}

/// Is this a vector without a fill pointer whose elements may be anything?
fn is_simple_vector(value: &Value) -> bool {
    matches!(value, Value::Vector(v) if v.element_type == ElementType::T && v.is_simple())
}

/// Is the object a simple vector?
///
/// `(simple-vector-p #(1))` => `T`
#[builtin(_, "object")]
fn simple_vector_p(_: &mut Image, args: &[Value]) -> Outcome {
    Ok(Value::bool(is_simple_vector(&args[0])))
}

fn is_bit_vector(value: &Value) -> bool {
    matches!(value, Value::Vector(v) if v.element_type == ElementType::Bit)
}

/// Is the object a bit vector?
///
/// `(bit-vector-p #*1)` => `T`
#[builtin(_, "object")]
fn bit_vector_p(_: &mut Image, args: &[Value]) -> Outcome {
    Ok(Value::bool(is_bit_vector(&args[0])))
}

/// Is the object a simple bit vector?
///
/// `(simple-bit-vector-p #*1)` => `T`
#[builtin(_, "object")]
fn simple_bit_vector_p(_: &mut Image, args: &[Value]) -> Outcome {
    let simple =
        matches!(&args[0], Value::Vector(v) if v.element_type == ElementType::Bit && v.is_simple());
    Ok(Value::bool(simple))
}

/// The element of a bit array.
///
/// `(sbit #*1010 1)` => `0`
#[builtin(_, "array &rest subscripts")]
fn sbit(image: &mut Image, args: &[Value]) -> Outcome {
    bit(image, args)
}

/// Replaces an element.
#[builtin("SBIT", "value array &rest subscripts")]
fn set_sbit(image: &mut Image, args: &[Value]) -> Outcome {
    set_bit(image, args)
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

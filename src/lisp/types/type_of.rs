//! `type-of`.

use std::rc::Rc;

use super::complex_numbers;
use super::test::is_standard_char;
use crate::image::Image;
use crate::object::class_of::builtin_class_name;
use crate::value::Value;
use crate::value::array::Vector;
use crate::value::class::Class;
use crate::value::element_type::ElementType;
use crate::value::function::Body;
use crate::value::known;
use crate::value::number::is_complex;

/// The largest fixnum.
const LARGEST_FIXNUM: i64 = 0x3fff_ffff_ffff_ffff;

/// The type of a value as a specifier, in SBCL's words.
pub fn type_of(image: &Image, value: &Value) -> Value {
    match value {
        Value::Symbol(known::T, ..) => known::BOOLEAN.into(),
        Value::Int(0 | 1) => known::BIT.into(),
        Value::Int(_) | Value::Big(_) => integer_type(image, value),
        Value::Char(c) if is_standard_char(*c) => known::STANDARD_CHAR.into(),
        Value::Str(s) => array_type(s.is_simple(), ElementType::Character, &[s.capacity()]),
        Value::Vector(v) => vector_type(v),
        Value::Array(a) => array_type(a.is_simple(), a.element_type, &a.dimensions.borrow()),
        Value::Function(f) => match f.body {
            Body::Generic(_) => known::STANDARD_GENERIC_FUNCTION.into(),
            _ => known::COMPILED_FUNCTION.into(),
        },
        Value::Instance(instance) => name_or_class(image, instance.class()),
        other if is_complex(other) => complex_numbers::type_of(other).unwrap_or(Value::T),
        other => builtin_class_name(image, other).into(),
    }
}

/// The name of a class that has one; else the class itself.
fn name_or_class(image: &Image, class: Rc<Class>) -> Value {
    let name = class.class_name();
    let named = name.as_symbol().and_then(|name| image.class(name));
    if named.is_some_and(|named| Rc::ptr_eq(named, &class)) {
        name
    } else {
        Value::Class(class)
    }
}

/// Integers other than bits: `(INTEGER 0 4611686018427387903)`, negative ones `FIXNUM`.
fn integer_type(image: &Image, value: &Value) -> Value {
    match value {
        Value::Int(0..=LARGEST_FIXNUM) => Value::list([
            known::INTEGER.into(),
            Value::Int(0),
            Value::Int(LARGEST_FIXNUM),
        ]),
        Value::Int(1..) => unsigned_beyond_fixnum(),
        Value::Big(n) if n.sign() == num_bigint::Sign::Plus => unsigned_beyond_fixnum(),
        other => builtin_class_name(image, other).into(),
    }
}

fn unsigned_beyond_fixnum() -> Value {
    Value::list([known::INTEGER.into(), Value::Int(LARGEST_FIXNUM + 1)])
}

fn vector_type(vector: &Vector) -> Value {
    let size = vector.items.len();
    match (vector.element_type, vector.is_simple()) {
        (ElementType::T, true) => Value::list([known::SIMPLE_VECTOR.into(), size.into()]),
        (ElementType::Bit, true) => Value::list([known::SIMPLE_BIT_VECTOR.into(), size.into()]),
        (element, simple) => array_type(simple, element, &[size]),
    }
}

fn array_type(simple: bool, element: ElementType, sizes: &[usize]) -> Value {
    let all = Value::list(sizes.iter().map(|n| Value::from(*n)));
    if simple {
        return Value::list([known::SIMPLE_ARRAY.into(), element.specifier(), all]);
    }
    Value::list(match sizes {
        [size] => [known::VECTOR.into(), element.specifier(), (*size).into()],
        _ => [known::ARRAY.into(), element.specifier(), all],
    })
}

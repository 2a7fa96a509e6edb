//! `type-of`.

use super::test::is_standard_char;
use crate::lisp::image::Image;
use crate::lisp::object::class_of::builtin_class_name;
use crate::lisp::value::Value;
use crate::lisp::value::array::Vector;
use crate::lisp::value::element_type::ElementType;
use crate::lisp::value::function::Body;
use crate::lisp::value::known;

/// The largest fixnum.
const LARGEST_FIXNUM: i64 = 0x3fff_ffff_ffff_ffff;

/// The type of a value as a specifier, in SBCL's words.
pub(crate) fn type_of(image: &Image, value: &Value) -> Value {
    match value {
        Value::Symbol(known::T, ..) => known::BOOLEAN.into(),
        Value::Int(0 | 1) => known::BIT.into(),
        Value::Int(_) | Value::Big(_) => integer_type(image, value),
        Value::Char(c) if is_standard_char(*c) => known::STANDARD_CHAR.into(),
        Value::Char(c) if c.is_ascii() => known::BASE_CHAR.into(),
        Value::Str(s) => array_type(s.is_simple(), ElementType::Character, &[s.capacity()]),
        Value::Vector(v) => vector_type(v),
        Value::Array(a) => array_type(a.is_simple(), a.element_type, &a.dimensions.borrow()),
        Value::Function(f) => match f.body {
            Body::Generic(_) => known::STANDARD_GENERIC_FUNCTION.into(),
            _ => known::COMPILED_FUNCTION.into(),
        },
        other => builtin_class_name(image, other).into(),
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
    let array = match sizes {
        [size] => [known::VECTOR.into(), element.specifier(), (*size).into()],
        _ => [known::ARRAY.into(), element.specifier(), all],
    };
    let not_simple = [known::NOT.into(), known::SIMPLE_ARRAY.into()];
    Value::list([
        known::AND.into(),
        Value::list(array),
        Value::list(not_simple),
    ])
}

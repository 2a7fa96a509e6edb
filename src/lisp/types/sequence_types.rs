//! Type specifiers that name kinds of sequences, for results of `map`, `concatenate`,
//! `merge`, `make-sequence` and `coerce`.

use super::parse::{element_type, expanded, is_star};
use super::specifier::{Answers, Stop};
use crate::image::Image;
use crate::object::text as shown;
use crate::value::Value;
use crate::value::element_type::ElementType;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::sequence::Kind;

/// A kind of sequence, and its length if the type specifies one.
#[derive(Clone)]
pub(crate) struct SequenceType {
    pub kind: Kind,
    /// The length, with the type specifier as the user wrote it.
    length: Option<usize>,
    specifier: Value,
}

impl SequenceType {
    /// The sequence type that a type specifier denotes, if it names a kind of sequence.
    pub(crate) fn of(
        image: &Image,
        specifier: &Value,
        answers: &mut Answers,
    ) -> Result<Option<SequenceType>, Stop> {
        let named = match expanded(image, specifier, answers)? {
            Value::Class(class) => class.name.into(),
            other => other,
        };
        let mut parts = named.iter_list();
        let (name, first, second) = match &named {
            Value::Symbol(sym, ..) => (Some(*sym), None, None),
            _ => {
                let name = parts.next().and_then(|name| name.as_symbol());
                (name, parts.next(), parts.next())
            }
        };
        let size = |value: Option<Value>| match value {
            Some(Value::Int(n)) => usize::try_from(n).ok(),
            // The dimensions of an array type.
            Some(Value::Cons(dimensions)) => match dimensions.car() {
                Value::Int(n) => usize::try_from(n).ok(),
                _ => None,
            },
            _ => None,
        };
        let Some(name) = name else { return Ok(None) };
        let (kind, length) = match name {
            known::LIST | known::CONS => (Kind::List, None),
            known::NULL => (Kind::List, Some(0)),
            known::VECTOR | known::ARRAY | known::SIMPLE_ARRAY => {
                let element = first.filter(|element| !is_star(element));
                let element = element.map(|element| element_type(image, &element, answers));
                let kind = match element.transpose()? {
                    Some(ElementType::Character) => Kind::Str,
                    other => Kind::Vector(other.unwrap_or(ElementType::T)),
                };
                (kind, size(second))
            }
            known::SIMPLE_VECTOR => (Kind::Vector(ElementType::T), size(first)),
            known::BIT_VECTOR | known::SIMPLE_BIT_VECTOR => {
                (Kind::Vector(ElementType::Bit), size(first))
            }
            known::STRING
            | known::SIMPLE_STRING
            | known::BASE_STRING
            | known::SIMPLE_BASE_STRING => (Kind::Str, size(first)),
            _ => return Ok(None),
        };
        Ok(Some(SequenceType {
            kind,
            length,
            specifier: specifier.clone(),
        }))
    }

    /// The sequence type that a type specifier denotes; an error if it is not a kind of sequence.
    pub(crate) fn new(
        image: &Image,
        specifier: &Value,
        answers: &mut Answers,
    ) -> Result<SequenceType, Stop> {
        SequenceType::of(image, specifier, answers)?.ok_or_else(|| {
            Raise::new(
                known::SIMPLE_TYPE_ERROR,
                format!(
                    "{} is not a type of sequence; LIST, VECTOR and STRING are.",
                    shown(image, specifier)
                ),
            )
            .with(known::K_DATUM, specifier.clone())
            .with(known::K_EXPECTED_TYPE, kinds_of_sequences())
            .into()
        })
    }

    /// A fresh sequence of this type.
    pub(crate) fn make(&self, items: Vec<Value>) -> Result<Value, Box<Raise>> {
        self.check_length(items.len())?;
        self.kind.make(items)
    }

    /// Checks that a sequence of this type can have a length.
    pub(crate) fn check_length(&self, length: usize) -> Result<(), Box<Raise>> {
        let is_cons = self.specifier.as_symbol() == Some(known::CONS);
        match self.length {
            _ if is_cons && length == 0 => Err(Raise::new(
                known::SIMPLE_TYPE_ERROR,
                "The empty list is not of type CONS.",
            )
            .with(known::K_DATUM, Value::NIL)
            .with(known::K_EXPECTED_TYPE, self.specifier.clone())),
            Some(expected) if expected != length => Err(Raise::new(
                known::SIMPLE_TYPE_ERROR,
                format!(
                    "A sequence of length {expected} is wanted, but this one has length {length}."
                ),
            )
            .with(known::K_DATUM, length.into())
            .with(
                known::K_EXPECTED_TYPE,
                Value::list([known::EQL.into(), expected.into()]),
            )),
            _ => Ok(()),
        }
    }
}

/// The type of names of kinds of sequences, which a specifier of another type is not of.
fn kinds_of_sequences() -> Value {
    Value::list([
        known::MEMBER.into(),
        known::LIST.into(),
        known::VECTOR.into(),
        known::STRING.into(),
    ])
}

/// The actual element type of an array that is made for elements of a type, given by a specifier
/// whose name `deftype` has not defined.
pub(super) fn upgraded(element_type: &Value) -> ElementType {
    match element_type {
        Value::Symbol(sym, ..) => match *sym {
            known::CHARACTER | known::BASE_CHAR | known::STANDARD_CHAR | known::EXTENDED_CHAR => {
                ElementType::Character
            }
            known::BIT => ElementType::Bit,
            known::NIL => ElementType::Nil,
            known::DOUBLE_FLOAT | known::LONG_FLOAT => ElementType::Double,
            known::SINGLE_FLOAT | known::SHORT_FLOAT => ElementType::Single,
            known::FIXNUM => ElementType::Fixnum,
            _ => ElementType::T,
        },
        Value::Cons(cons) => {
            let arguments: Vec<Value> = cons.cdr().iter_list().collect();
            let Value::Symbol(name, ..) = cons.car() else {
                return ElementType::T;
            };
            match (name, arguments.as_slice()) {
                (known::UNSIGNED_BYTE, [Value::Int(bits @ 1..)]) => {
                    ElementType::of_unsigned_bytes(*bits)
                }
                (known::SIGNED_BYTE, [Value::Int(bits @ 1..)]) => {
                    ElementType::of_signed_bytes(*bits)
                }
                (known::MOD, [Value::Int(size @ 1..)]) => {
                    ElementType::of_integers(&Value::Int(0), &Value::Int(size - 1))
                }
                (known::INTEGER, [low, high]) => {
                    ElementType::of_integers(&inclusive(low, 1), &inclusive(high, -1))
                }
                (known::DOUBLE_FLOAT | known::LONG_FLOAT, _) => ElementType::Double,
                (known::SINGLE_FLOAT | known::SHORT_FLOAT, _) => ElementType::Single,
                _ => ElementType::T,
            }
        }
        _ => ElementType::T,
    }
}

/// A bound of a range of integers, the integer beside it if it is exclusive, as `(5)`.
fn inclusive(bound: &Value, step: i64) -> Value {
    match bound {
        Value::Cons(exclusive) => match exclusive.car() {
            Value::Int(n) => n.checked_add(step).map_or(Value::NIL, Value::Int),
            other => other,
        },
        inclusive => inclusive.clone(),
    }
}

//! `coerce`: a value of another type that means the same.

use super::specifier::{Answers, Stop};
use super::test::typep_with;
use crate::image::Image;
use crate::object::text;
use crate::types::parse::expanded;
use crate::types::sequence_types::SequenceType;
use crate::value::Value;
use crate::value::known;
use crate::value::number;
use crate::value::raise::Raise;
use crate::value::sequence::Sequence;
use crate::value::symbol::{FunctionCell, Sym};

/// Converts a value to a type.
pub fn coerce(
    image: &Image,
    value: &Value,
    specifier: &Value,
    answers: &mut Answers,
) -> Result<Value, Stop> {
    if typep_with(image, value, specifier, answers)? {
        return Ok(value.clone());
    }
    let specifier = match expanded(image, specifier, answers)? {
        Value::Class(class) => class.name.into(),
        other => other,
    };
    let name = match &specifier {
        Value::Class(class) => Some(class.name),
        Value::Cons(list) => list.car().as_symbol(),
        other => other.as_symbol(),
    };
    let converted = match name {
        Some(name) => convert(image, value, name, &specifier, answers)?,
        None => None,
    };
    match converted {
        // A rational number with an imaginary part of zero is no complex number.
        Some(result) if name == Some(known::COMPLEX) && number::is_rational(&result) => Ok(result),
        // The result must satisfy a range or another restriction.
        Some(result) if typep_with(image, &result, &specifier, answers)? => Ok(result),
        _ => Err(cannot(image, value, &specifier).into()),
    }
}

fn convert(
    image: &Image,
    value: &Value,
    name: Sym,
    specifier: &Value,
    answers: &mut Answers,
) -> Result<Option<Value>, Stop> {
    let is_real = number::is_real(value);
    Ok(match name {
        known::FLOAT | known::SINGLE_FLOAT | known::SHORT_FLOAT if is_real => {
            Some(number::to_single(value)?)
        }
        known::DOUBLE_FLOAT | known::LONG_FLOAT if is_real => Some(number::to_double(value)?),
        known::COMPLEX if is_real => {
            let part = match specifier.cdr_or_nil().car_or_nil() {
                any if any.is_nil() || any.as_symbol() == Some(known::TIMES) => value.clone(),
                kind => coerce(image, value, &kind, answers)?,
            };
            Some(number::complex(&part, &Value::Int(0))?)
        }
        known::CHARACTER => character(image, value),
        known::FUNCTION => function(image, value, answers)?,
        _ => match SequenceType::of(image, specifier, answers)? {
            Some(wanted) => match Sequence::of(value) {
                Ok(sequence) => Some(wanted.make(sequence.all()?)?),
                Err(_) => None,
            },
            None => None,
        },
    })
}

/// The character of a string or symbol name of length one.
fn character(image: &Image, value: &Value) -> Option<Value> {
    let name = match value {
        Value::Str(s) => s.text(),
        Value::Symbol(sym, ..) => image.name(*sym).to_owned(),
        _ => return None,
    };
    let mut chars = name.chars();
    match (chars.next(), chars.next()) {
        (Some(c), None) => Some(Value::Char(c)),
        _ => None,
    }
}

/// The function that a symbol names or a lambda expression describes.
fn function(image: &Image, value: &Value, answers: &mut Answers) -> Result<Option<Value>, Stop> {
    match value {
        Value::Symbol(sym, ..) => match &image.symbol(*sym).function {
            FunctionCell::Function(function) => Ok(Some(Value::Function(function.clone()))),
            _ => Err(Raise::undefined_function(value.clone()).into()),
        },
        Value::Cons(list) => match list.car().as_symbol() {
            Some(known::LAMBDA) => {
                let form = Value::list([known::FUNCTION.into(), value.clone()]);
                answers.ask(&known::EVAL.into(), vec![form]).map(Some)
            }
            _ => Ok(None),
        },
        _ => Ok(None),
    }
}

fn cannot(image: &Image, value: &Value, specifier: &Value) -> Box<Raise> {
    Raise::new(
        known::SIMPLE_TYPE_ERROR,
        format!(
            "{} can't be converted to type {}.",
            text(image, value),
            text(image, specifier)
        ),
    )
    .with(known::K_DATUM, value.clone())
    .with(known::K_EXPECTED_TYPE, specifier.clone())
}

//! The types of handlers: are they types, and does a condition match them?

use crate::evaluator::nested;
use crate::image::Image;
use crate::types::parse::{is_plain_class, parse};
use crate::types::specifier::{Answers, Stop, Type};
use crate::types::typep_with;
use crate::value::Value;
use crate::value::raise::Raise;

/// Is a condition of a handler's type?
pub fn is_of_type(
    image: &mut Image,
    condition: &Value,
    specifier: &Value,
) -> Result<bool, Box<Raise>> {
    if let (Value::Instance(instance), Value::Symbol(name, ..)) = (condition, specifier)
        && instance.is_a(*name)
    {
        return Ok(true);
    }
    settled(image, |image, answers| {
        typep_with(image, condition, specifier, answers)
    })
}

/// Signals an error unless a handler's type is one: a misspelt one would otherwise be noticed only
/// when a condition arrives, instead of that condition.
pub(super) fn check_type(image: &mut Image, specifier: &Value) -> Result<(), Box<Raise>> {
    if let Value::Symbol(name, ..) = specifier
        && is_plain_class(image, *name)
        && image
            .class(*name)
            .is_some_and(|class| class.is_defined.get())
    {
        return Ok(());
    }
    let parsed = settled(image, |image, answers| parse(image, specifier, answers))?;
    check_predicates(image, &parsed)
}

/// Signals an error if a predicate of `satisfies` is not a function.
fn check_predicates(image: &Image, set: &Type) -> Result<(), Box<Raise>> {
    match set {
        Type::And(types) | Type::Or(types) => types
            .iter()
            .try_for_each(|each| check_predicates(image, each)),
        Type::Not(of) => check_predicates(image, of),
        Type::Cons(car, cdr) => {
            check_predicates(image, car)?;
            check_predicates(image, cdr)
        }
        Type::Satisfies(function) => image.coerce_to_function(function).map(|_| ()),
        _ => Ok(()),
    }
}

/// What an operation on types comes to, with the calls that it asks for.
fn settled<T>(
    image: &mut Image,
    operation: impl Fn(&Image, &mut Answers) -> Result<T, Stop>,
) -> Result<T, Box<Raise>> {
    let mut answers = Answers::default();
    loop {
        match operation(image, &mut answers) {
            Ok(answer) => return Ok(answer),
            Err(Stop::Raise(raise) | Stop::UnknownType(raise)) => return Err(raise),
            Err(Stop::Call { function, args }) => {
                answers.add(nested::call_nested(image, function, args)?);
            }
        }
    }
}

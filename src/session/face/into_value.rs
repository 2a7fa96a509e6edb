//! Data as values of the language.

use num_bigint::BigInt;

use super::{Datum, Failure, names};
use crate::simulation::Simulation;
use cram::designator::value::{Class, make};
use cram::pose::value::pose_stamped;
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::number;

/// A datum as a value of an image.
pub(super) fn value(
    image: &mut Image,
    simulation: &Simulation,
    datum: &Datum,
) -> Result<Value, Failure> {
    let mut all = |items: &[Datum]| -> Result<Vec<Value>, Failure> {
        let values = items.iter().map(|item| value(image, simulation, item));
        values.collect()
    };
    Ok(match datum {
        Datum::Nil => Value::NIL,
        Datum::True => Value::T,
        Datum::Integer(number) => Value::Int(*number),
        Datum::Big(digits) => ratio(digits, "1")?,
        Datum::Ratio(numerator, denominator) => ratio(numerator, denominator)?,
        Datum::Single(number) => Value::Single(*number),
        Datum::Float(number) => Value::Double(*number),
        Datum::Character(character) => Value::Char(*character),
        Datum::String(text) => Value::string(text.as_str()),
        Datum::Keyword(name) => image.keyword(name).into(),
        Datum::Symbol { package, name } => {
            let package = names::package(image, package.as_deref())?;
            image.intern(package, name).into()
        }
        Datum::List(items) => Value::list(all(items)?),
        Datum::Dotted(items, end) => {
            let items = all(items)?;
            let end = value(image, simulation, end)?;
            Value::list_with_tail(items, end)
        }
        Datum::Vector(items) => Value::vector(all(items)?),
        Datum::Pose(placed) => pose_stamped(&placed.frame, &placed.pose),
        Datum::Object(name) => {
            let known = simulation.symbol_of(name);
            let name = match known.is_nil() {
                true => image.intern(image.current_package(), name).into(),
                false => known,
            };
            make(image, Class::Object, &[("NAME", name)])
        }
        Datum::Other(text) => {
            return Err(Failure::Invalid(format!(
                "A value that is known only as {text} cannot be an argument."
            )));
        }
    })
}

/// A ratio, or an integer, in its simplest form.
fn ratio(numerator: &str, denominator: &str) -> Result<Value, Failure> {
    let parsed = |digits: &str| digits.parse::<BigInt>().ok();
    let ratio = parsed(numerator).zip(parsed(denominator));
    let ratio = ratio.and_then(|(numerator, denominator)| number::ratio(numerator, denominator));
    ratio.ok_or_else(|| {
        Failure::Invalid(format!(
            "{numerator}/{denominator} is no number in decimal digits."
        ))
    })
}

//! Types of complex numbers, by the type of both their parts.

use super::compare;
use super::specifier::{Answers, Bound, RealKind, Stop, Type};
use super::subtype::{Verdict, are_disjoint, is_subset};
use super::test::contains;
use crate::image::Image;
use crate::object::text;
use crate::value::Value;
use crate::value::known;
use crate::value::number::{imaginary_part, is_complex, real_part};
use crate::value::raise::Raise;

use RealKind::{Double, Integer, Ratio, Single};
use Verdict::{No, Unknown};

/// The representations that the parts of one complex number can have together.
const TOGETHER: [&[RealKind]; 3] = [&[Integer, Ratio], &[Single], &[Double]];

/// All real numbers.
pub(super) fn all_reals() -> Type {
    reals(&[Integer, Ratio, Single, Double])
}

fn reals(kinds: &[RealKind]) -> Type {
    let all = kinds
        .iter()
        .map(|kind| Type::Real(*kind, Bound::None, Bound::None));
    union(all.collect())
}

fn union(mut parts: Vec<Type>) -> Type {
    match parts.len() {
        0 => Type::Nothing,
        1 => parts.remove(0),
        _ => Type::Or(parts),
    }
}

/// The complex numbers with parts of a type.
pub(super) fn of_parts(part: &Type) -> Type {
    let alike = TOGETHER.iter().map(|kinds| restricted(part, kinds));
    let alike = alike.filter(|part| !matches!(part, Type::Nothing));
    union(alike.map(|part| Type::Complex(Box::new(part))).collect())
}

/// What a type has of some representations.
fn restricted(part: &Type, kinds: &[RealKind]) -> Type {
    match part {
        Type::Any => reals(kinds),
        Type::Nothing => Type::Nothing,
        Type::Real(kind, ..) if kinds.contains(kind) => part.clone(),
        Type::Real(..) => Type::Nothing,
        Type::Or(parts) => {
            let parts = parts.iter().map(|part| restricted(part, kinds));
            union(parts.filter(|p| !matches!(p, Type::Nothing)).collect())
        }
        Type::Member(values) => {
            let is_one = |value: &&Value| kinds.iter().any(|kind| kind.has(value));
            let values: Vec<Value> = values.iter().filter(is_one).cloned().collect();
            if values.is_empty() {
                Type::Nothing
            } else {
                Type::Member(values)
            }
        }
        other => Type::And(vec![other.clone(), reals(kinds)]),
    }
}

/// Fails if a type certainly has others than real numbers.
pub(super) fn check_parts(image: &Image, part: &Type, specifier: &Value) -> Result<(), Stop> {
    if is_subset(image, part, &all_reals()) == No {
        return Err(Raise::simple(format!(
            "{} is no type of parts of complex numbers, which are real.",
            text(image, specifier)
        ))
        .into());
    }
    Ok(())
}

/// Is a value a complex number with parts of a type?
pub(super) fn has_parts(
    image: &Image,
    value: &Value,
    part: &Type,
    answers: &mut Answers,
) -> Result<bool, Stop> {
    Ok(is_complex(value)
        && contains(image, part, &real_part(value)?, answers)?
        && contains(image, part, &imaginary_part(value)?, answers)?)
}

/// Has no complex number both parts of one type and both of another?
pub(super) fn have_disjoint_parts(image: &Image, a: &Type, b: &Type) -> Verdict {
    let has_zero = |part| may_have(image, part, &Value::Int(0));
    match are_disjoint(image, a, b) {
        // Zero alone makes no complex number.
        No if has_zero(a) && has_zero(b) => Unknown,
        verdict => verdict,
    }
}

fn may_have(image: &Image, part: &Type, value: &Value) -> bool {
    contains(image, part, value, &mut Answers::default()).unwrap_or(true)
}

/// The type of a complex number: `(COMPLEX (INTEGER 1 2))`.
pub(super) fn type_of(value: &Value) -> Option<Value> {
    let (re, im) = (real_part(value).ok()?, imaginary_part(value).ok()?);
    let name = match (&re, &im) {
        (Value::Single(_), _) => known::SINGLE_FLOAT,
        (Value::Double(_), _) => known::DOUBLE_FLOAT,
        (Value::Int(_) | Value::Big(_), Value::Int(_) | Value::Big(_)) => known::INTEGER,
        _ => known::RATIONAL,
    };
    let (low, high) = if compare(&im, &re)?.is_lt() {
        (im, re)
    } else {
        (re, im)
    };
    let range = Value::list([name.into(), low, high]);
    Some(Value::list([known::COMPLEX.into(), range]))
}

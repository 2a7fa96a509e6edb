//! Order and equality of numbers by value.

use std::cmp::Ordering;

use num_integer::Integer;

use super::complex;
use super::complex::is_complex;
use super::convert::{exact, fraction_of, is_number, is_rational, is_real};
use super::error::{NumberResult, not_a_number, not_an_integer, not_real};
use crate::value::Value;
use crate::value::operation::Comparison;
use crate::value::raise::Raise;

/// Integers up to this magnitude are exact as double floats.
const EXACT_IN_DOUBLE: u64 = 1 << 53;

/// The order of two real numbers; `None` if one is not a number (NaN).
pub fn compare(a: &Value, b: &Value) -> Result<Option<Ordering>, Box<Raise>> {
    match (a, b) {
        (Value::Int(x), Value::Int(y)) => Ok(Some(x.cmp(y))),
        (Value::Double(x), Value::Double(y)) => Ok(x.partial_cmp(y)),
        (Value::Single(x), Value::Single(y)) => Ok(x.partial_cmp(y)),
        (Value::Single(x), Value::Double(y)) => Ok(f64::from(*x).partial_cmp(y)),
        (Value::Double(x), Value::Single(y)) => Ok(x.partial_cmp(&f64::from(*y))),
        _ => compare_slowly(a, b),
    }
}

fn as_float(value: &Value) -> Option<f64> {
    match value {
        Value::Single(x) => Some(f64::from(*x)),
        Value::Double(x) => Some(*x),
        _ => None,
    }
}

fn compare_slowly(a: &Value, b: &Value) -> Result<Option<Ordering>, Box<Raise>> {
    for operand in [a, b] {
        if !is_real(operand) {
            return Err(not_real(operand));
        }
    }
    if let Some(x) = as_float(a) {
        return Ok(compare_exact(b, x).map(Ordering::reverse));
    }
    if let Some(y) = as_float(b) {
        return Ok(compare_exact(a, y));
    }
    Ok(compare_rationals(a, b))
}

/// The order of an exact number and a float.
fn compare_exact(a: &Value, x: f64) -> Option<Ordering> {
    match a {
        Value::Int(n) if n.unsigned_abs() <= EXACT_IN_DOUBLE => (*n as f64).partial_cmp(&x),
        _ if x.is_nan() => None,
        _ if x.is_infinite() => 0.0.partial_cmp(&x),
        _ => compare_rationals(a, &exact(x)?),
    }
}

fn compare_rationals(a: &Value, b: &Value) -> Option<Ordering> {
    match (a, b) {
        (Value::Int(x), Value::Int(y)) => Some(x.cmp(y)),
        (Value::Big(x), Value::Big(y)) => Some(x.cmp(y)),
        _ => {
            let (n, d) = fraction_of(a)?;
            let (m, e) = fraction_of(b)?;
            Some((n * e).cmp(&(m * d)))
        }
    }
}

/// Are two numbers of whatever types equal in value? False unless both are numbers.
pub(crate) fn equal_by_value(a: &Value, b: &Value) -> bool {
    is_number(a) && is_number(b) && matches!(number_equal(a, b), Ok(true))
}

/// `(= a b)`.
#[inline]
pub fn number_equal(a: &Value, b: &Value) -> Result<bool, Box<Raise>> {
    match (a, b) {
        (Value::Int(x), Value::Int(y)) => Ok(x == y),
        (Value::Double(x), Value::Double(y)) => Ok(x == y),
        _ => {
            for operand in [a, b] {
                if !is_number(operand) {
                    return Err(not_a_number(operand));
                }
            }
            if is_complex(a) || is_complex(b) {
                return complex::equal(a, b);
            }
            Ok(compare(a, b)? == Some(Ordering::Equal))
        }
    }
}

/// `(< a b)`.
#[inline]
pub fn less(a: &Value, b: &Value) -> Result<bool, Box<Raise>> {
    match (a, b) {
        (Value::Int(x), Value::Int(y)) => Ok(x < y),
        (Value::Double(x), Value::Double(y)) => Ok(x < y),
        _ => Ok(compare(a, b)? == Some(Ordering::Less)),
    }
}

/// `(> a b)`.
#[inline]
pub fn greater(a: &Value, b: &Value) -> Result<bool, Box<Raise>> {
    match (a, b) {
        (Value::Int(x), Value::Int(y)) => Ok(x > y),
        (Value::Double(x), Value::Double(y)) => Ok(x > y),
        _ => Ok(compare(a, b)? == Some(Ordering::Greater)),
    }
}

/// `(<= a b)`.
#[inline]
pub fn less_equal(a: &Value, b: &Value) -> Result<bool, Box<Raise>> {
    match (a, b) {
        (Value::Int(x), Value::Int(y)) => Ok(x <= y),
        (Value::Double(x), Value::Double(y)) => Ok(x <= y),
        _ => Ok(compare(a, b)?.is_some_and(Ordering::is_le)),
    }
}

/// `(>= a b)`.
#[inline]
pub fn greater_equal(a: &Value, b: &Value) -> Result<bool, Box<Raise>> {
    match (a, b) {
        (Value::Int(x), Value::Int(y)) => Ok(x >= y),
        (Value::Double(x), Value::Double(y)) => Ok(x >= y),
        _ => Ok(compare(a, b)?.is_some_and(Ordering::is_ge)),
    }
}

/// Do two numbers compare like that?
#[inline(always)]
pub(crate) fn compare_like(
    comparison: Comparison,
    a: &Value,
    b: &Value,
) -> Result<bool, Box<Raise>> {
    match (a, b) {
        (Value::Int(x), Value::Int(y)) => Ok(comparison.holds(*x, *y)),
        _ => compare_any(comparison, a, b),
    }
}

#[inline(never)]
fn compare_any(comparison: Comparison, a: &Value, b: &Value) -> Result<bool, Box<Raise>> {
    match comparison {
        Comparison::Less => less(a, b),
        Comparison::Equal => number_equal(a, b),
        Comparison::LessEqual => less_equal(a, b),
        Comparison::Greater => greater(a, b),
        Comparison::GreaterEqual => greater_equal(a, b),
    }
}

/// The larger of two numbers, unconverted; the first if they are equal.
pub fn maximum(a: &Value, b: &Value) -> NumberResult {
    Ok(if less(a, b)? { b.clone() } else { a.clone() })
}

/// The smaller of two numbers, unconverted; the first if they are equal.
pub(crate) fn minimum(a: &Value, b: &Value) -> NumberResult {
    Ok(if less(b, a)? { b.clone() } else { a.clone() })
}

/// `(zerop a)`.
pub fn is_zero(a: &Value) -> Result<bool, Box<Raise>> {
    match a {
        Value::Int(n) => Ok(*n == 0),
        Value::Double(x) => Ok(*x == 0.0),
        Value::Single(x) => Ok(*x == 0.0),
        other if is_rational(other) => Ok(false),
        z if is_complex(z) => complex::equal(z, &Value::Int(0)),
        other => Err(not_a_number(other)),
    }
}

/// `(plusp a)`.
pub(crate) fn is_plus(a: &Value) -> Result<bool, Box<Raise>> {
    greater(a, &Value::Int(0))
}

/// `(minusp a)`.
pub(crate) fn is_minus(a: &Value) -> Result<bool, Box<Raise>> {
    less(a, &Value::Int(0))
}

/// `(evenp a)`.
pub(crate) fn is_even(a: &Value) -> Result<bool, Box<Raise>> {
    match a {
        Value::Int(n) => Ok(n % 2 == 0),
        Value::Big(n) => Ok(n.is_even()),
        other => Err(not_an_integer(other)),
    }
}

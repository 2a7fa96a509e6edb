//! Division with remainder under the four ways of rounding.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use super::arithmetic::{mul, sub};
use super::convert::{exact_fraction, fraction_of, from_big, is_rational, is_real, to_f32, to_f64};
use super::error::{NumberResult, division_by_zero, invalid, not_real, overflow};
use super::large;
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;

/// Which integer a quotient becomes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Rounding {
    /// The one below or equal.
    Floor,
    /// The one above or equal.
    Ceiling,
    /// The one towards zero.
    Truncate,
    /// The nearest; of two, the even one.
    Round,
}

impl Rounding {
    fn operation(self) -> Sym {
        match self {
            Rounding::Floor => known::FLOOR,
            Rounding::Ceiling => known::CEILING,
            Rounding::Truncate => known::TRUNCATE,
            Rounding::Round => known::ROUND,
        }
    }
}

/// Quotient, an integer, and remainder of `a` by `b`: `a = quotient * b + remainder`.
pub(crate) fn divide(
    a: &Value,
    b: &Value,
    rounding: Rounding,
) -> Result<(Value, Value), Box<Raise>> {
    if let (Value::Int(x), Value::Int(y)) = (a, b)
        && *y != 0
        && *y != -1
    {
        return Ok(divide_small(*x, *y, rounding));
    }
    for operand in [a, b] {
        if !is_real(operand) {
            return Err(not_real(operand));
        }
    }
    if let (Some((n, d)), Some((m, e))) = (fraction_of(a), fraction_of(b)) {
        if m.is_zero() {
            return Err(division_by_zero(rounding.operation(), &[a, b]));
        }
        let quotient = from_big(divide_big(
            &large::multiply(&n, &e),
            &large::multiply(&d, &m),
            rounding,
        ));
        let rest = sub(a, &mul(&quotient, b)?)?;
        return Ok((quotient, rest));
    }
    divide_floats(a, b, rounding)
}

fn divide_small(x: i64, y: i64, rounding: Rounding) -> (Value, Value) {
    let (mut quotient, mut rest) = (x / y, x % y);
    let is_away = rest != 0
        && match rounding {
            Rounding::Floor => (rest < 0) != (y < 0),
            Rounding::Ceiling => (rest < 0) == (y < 0),
            Rounding::Truncate => false,
            Rounding::Round => {
                // The remainder is smaller than the divisor, so the difference is no less
                // than zero.
                let to_next = y.unsigned_abs() - rest.unsigned_abs();
                match rest.unsigned_abs().cmp(&to_next) {
                    Ordering::Less => false,
                    Ordering::Greater => true,
                    Ordering::Equal => quotient % 2 != 0,
                }
            }
        };
    if is_away {
        if (x < 0) == (y < 0) {
            quotient += 1;
            rest -= y;
        } else {
            quotient -= 1;
            rest += y;
        }
    }
    (Value::Int(quotient), Value::Int(rest))
}

/// The integer quotient. The divisor must not be zero.
fn divide_big(numerator: &BigInt, divisor: &BigInt, rounding: Rounding) -> BigInt {
    match rounding {
        Rounding::Floor => large::divide_down(numerator, divisor).0,
        Rounding::Ceiling => -large::divide_down(&-numerator, divisor).0,
        Rounding::Truncate => large::divide(numerator, divisor).0,
        Rounding::Round => {
            let (quotient, rest) = large::divide_down(numerator, divisor);
            let twice: BigInt = rest.abs() * 2;
            match twice.cmp(&divisor.abs()) {
                Ordering::Less => quotient,
                Ordering::Greater => quotient + 1,
                Ordering::Equal if quotient.is_even() => quotient,
                Ordering::Equal => quotient + 1,
            }
        }
    }
}

fn divide_floats(a: &Value, b: &Value, rounding: Rounding) -> Result<(Value, Value), Box<Raise>> {
    let is_double = matches!(a, Value::Double(_)) || matches!(b, Value::Double(_));
    let convert = |v: &Value| {
        if is_double {
            to_f64(v)
        } else {
            to_f32(v).map(f64::from)
        }
        .unwrap_or(0.0)
    };
    let (x, y) = (convert(a), convert(b));
    if y == 0.0 {
        return Err(division_by_zero(rounding.operation(), &[a, b]));
    }
    if [(a, x), (b, y)]
        .iter()
        .any(|(v, converted)| converted.is_infinite() && is_rational(v))
    {
        return Err(overflow(rounding.operation(), &[a, b]));
    }
    // In single precision each step is rounded; the double result of one operation on two
    // singles rounds to the same single as the exact one.
    let step = |value: f64| {
        if is_double {
            value
        } else {
            f64::from(value as f32)
        }
    };
    let mut quotient = libm::trunc(step(x / y));
    if !quotient.is_finite() {
        return Err(invalid(rounding.operation(), &[a, b]));
    }
    let mut rest = step(x - step(quotient * y));
    let towards = if (x < 0.0) == (y < 0.0) { 1.0 } else { -1.0 };
    let is_away = rest != 0.0
        && match rounding {
            Rounding::Floor => {
                if y < 0.0 {
                    x > 0.0
                } else {
                    x < 0.0
                }
            }
            Rounding::Ceiling => {
                if y < 0.0 {
                    x < 0.0
                } else {
                    x > 0.0
                }
            }
            Rounding::Truncate => false,
            Rounding::Round => {
                let half = y.abs() / 2.0;
                rest.abs() > half || rest.abs() == half && libm::fmod(quotient, 2.0) != 0.0
            }
        };
    if is_away {
        quotient += towards;
        rest = step(rest - towards * y);
    }
    let rest = if is_double {
        Value::Double(rest)
    } else {
        Value::Single(rest as f32)
    };
    Ok((integer_of(quotient), rest))
}

/// A float without a fraction, as an integer.
fn integer_of(x: f64) -> Value {
    // Two to the power of 63 and more do not fit.
    if x.abs() < 9.2e18 {
        return Value::Int(x as i64);
    }
    match exact_fraction(x) {
        Some((n, d)) if d.is_one() => from_big(n),
        _ => Value::Int(0),
    }
}

/// Like [`divide`], but the quotient is a float (`ffloor` and so on).
pub(crate) fn divide_to_float(
    a: &Value,
    b: &Value,
    rounding: Rounding,
) -> Result<(Value, Value), Box<Raise>> {
    let (quotient, rest) = divide(a, b, rounding)?;
    let is_double = matches!(a, Value::Double(_)) || matches!(b, Value::Double(_));
    let quotient = if is_double {
        crate::value::number::convert::to_double(&quotient)?
    } else {
        crate::value::number::convert::to_single(&quotient)?
    };
    Ok((quotient, rest))
}

/// `(floor a b)`.
#[cfg(test)]
pub fn floor(a: &Value, b: &Value) -> Result<(Value, Value), Box<Raise>> {
    divide(a, b, Rounding::Floor)
}

/// `(ceiling a b)`.
#[cfg(test)]
pub fn ceiling(a: &Value, b: &Value) -> Result<(Value, Value), Box<Raise>> {
    divide(a, b, Rounding::Ceiling)
}

/// `(truncate a b)`.
#[cfg(test)]
pub fn truncate(a: &Value, b: &Value) -> Result<(Value, Value), Box<Raise>> {
    divide(a, b, Rounding::Truncate)
}

/// `(round a b)`.
#[cfg(test)]
pub fn round(a: &Value, b: &Value) -> Result<(Value, Value), Box<Raise>> {
    divide(a, b, Rounding::Round)
}

/// `(mod a b)`.
pub(crate) fn modulo(a: &Value, b: &Value) -> NumberResult {
    Ok(divide(a, b, Rounding::Floor)?.1)
}

/// `(rem a b)`.
pub(crate) fn remainder(a: &Value, b: &Value) -> NumberResult {
    Ok(divide(a, b, Rounding::Truncate)?.1)
}

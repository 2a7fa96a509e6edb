//! From one type of number to another.

use std::rc::Rc;

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::error::{NumberResult, not_real, overflow};
use super::large;
use super::ratio::Ratio;
use crate::value::Value;
use crate::value::known;

/// An integer as a value: immediate if it fits 64 bits.
pub(crate) fn from_big(n: BigInt) -> Value {
    match n.to_i64() {
        Some(small) => Value::Int(small),
        None => Value::Big(Rc::new(n)),
    }
}

/// A fraction as a value, in lowest terms; `None` if the denominator is zero.
pub fn ratio(numerator: BigInt, denominator: BigInt) -> Option<Value> {
    if denominator.is_zero() {
        return None;
    }
    let mut divisor = large::common_divisor(&numerator, &denominator);
    if denominator.is_negative() {
        divisor = -divisor;
    }
    let (numerator, _) = large::divide(&numerator, &divisor);
    let (denominator, _) = large::divide(&denominator, &divisor);
    if denominator.is_one() {
        return Some(from_big(numerator));
    }
    Some(Value::Ratio(Rc::new(Ratio {
        numerator,
        denominator,
    })))
}

/// The integer as a big one; `None` if the value is not an integer.
pub(crate) fn to_big(value: &Value) -> Option<BigInt> {
    match value {
        Value::Int(n) => Some(BigInt::from(*n)),
        Value::Big(n) => Some(n.as_ref().clone()),
        _ => None,
    }
}

/// Is this a number?
pub fn is_number(value: &Value) -> bool {
    is_real(value) || crate::value::number::complex::is_complex(value)
}

/// Is this a real number?
pub fn is_real(value: &Value) -> bool {
    is_rational(value) || matches!(value, Value::Single(_) | Value::Double(_))
}

/// Is this an integer or a ratio?
pub(crate) fn is_rational(value: &Value) -> bool {
    is_integer(value) || matches!(value, Value::Ratio(_))
}

/// Is this an integer?
pub(crate) fn is_integer(value: &Value) -> bool {
    matches!(value, Value::Int(_) | Value::Big(_))
}

/// The number as the nearest double float; infinite beyond the largest one; `None` if it is not a
/// real number.
pub fn to_f64(value: &Value) -> Option<f64> {
    match value {
        Value::Int(n) => Some(*n as f64),
        Value::Big(n) => n.to_f64(),
        Value::Ratio(r) => Some(fraction_to_f64(
            &r.numerator,
            &r.denominator,
            f64::MANTISSA_DIGITS,
            -1074,
        )),
        Value::Single(x) => Some(f64::from(*x)),
        Value::Double(x) => Some(*x),
        _ => None,
    }
}

/// The number as the nearest single float; infinite beyond the largest one; `None` if it is not a
/// real number.
pub(crate) fn to_f32(value: &Value) -> Option<f32> {
    match value {
        Value::Int(n) => Some(*n as f32),
        Value::Big(n) => n.to_f32(),
        // A mantissa of 24 bits within the range of single floats converts exactly.
        Value::Ratio(r) => {
            Some(fraction_to_f64(&r.numerator, &r.denominator, f32::MANTISSA_DIGITS, -149) as f32)
        }
        Value::Single(x) => Some(*x),
        Value::Double(x) => Some(*x as f32),
        _ => None,
    }
}

/// The fraction rounded to a mantissa of `bits` bits (ties to even), with no bit below two to the
/// power of `lowest`.
fn fraction_to_f64(numerator: &BigInt, denominator: &BigInt, bits: u32, lowest: i64) -> f64 {
    let magnitude = numerator.abs();
    // Lengths of numbers that fit in memory fit 63 bits.
    let length = |n: &BigInt| i64::try_from(n.bits()).unwrap_or(i64::MAX / 4);
    // The quotient lies in 2^(difference-1) .. 2^(difference+1).
    let difference = length(&magnitude) - length(denominator);
    let mut exponent = difference - i64::from(bits) - 1;
    exponent = exponent.max(lowest - 2);
    if exponent > 2000 {
        return if numerator.is_negative() {
            f64::NEG_INFINITY
        } else {
            f64::INFINITY
        };
    }
    if difference < lowest - 2 {
        return if numerator.is_negative() { -0.0 } else { 0.0 };
    }
    let shift = usize::try_from(exponent.unsigned_abs()).unwrap_or(usize::MAX);
    let (scaled, divisor) = if exponent < 0 {
        (magnitude << shift, denominator.clone())
    } else {
        (magnitude, denominator << shift)
    };
    let (quotient, rest) = large::divide(&scaled, &divisor);
    // At most `bits` + 2 bits.
    let mut mantissa = quotient.to_u64().unwrap_or(u64::MAX);
    let mut is_inexact = !rest.is_zero();
    // Keep `bits` bits, and none below `lowest`.
    let used = i64::from(64 - mantissa.leading_zeros());
    let drop = (used - i64::from(bits)).max(lowest - exponent).max(0);
    for _ in 0..drop.saturating_sub(1) {
        is_inexact |= mantissa & 1 == 1;
        mantissa >>= 1;
    }
    if drop > 0 {
        let half = mantissa & 1 == 1;
        mantissa >>= 1;
        if half && (is_inexact || mantissa & 1 == 1) {
            mantissa += 1;
        }
    }
    let exponent = i32::try_from(exponent + drop).unwrap_or(i32::MAX);
    let result = libm::ldexp(mantissa as f64, exponent);
    if numerator.is_negative() {
        -result
    } else {
        result
    }
}

/// `(coerce x 'single-float)`.
pub(crate) fn to_single(value: &Value) -> NumberResult {
    let x = to_f32(value).ok_or_else(|| not_real(value))?;
    if x.is_infinite() && to_f64(value).is_some_and(f64::is_finite)
        || x.is_infinite() && is_rational(value)
    {
        return Err(overflow(known::FLOAT, &[value]));
    }
    Ok(Value::Single(x))
}

/// `(coerce x 'double-float)`.
pub(crate) fn to_double(value: &Value) -> NumberResult {
    let x = to_f64(value).ok_or_else(|| not_real(value))?;
    if x.is_infinite() && is_rational(value) {
        return Err(overflow(known::FLOAT, &[value]));
    }
    Ok(Value::Double(x))
}

/// `(float x prototype)`.
pub(crate) fn to_float_like(value: &Value, prototype: &Value) -> NumberResult {
    match prototype {
        Value::Double(_) => to_double(value),
        _ => to_single(value),
    }
}

/// `rational`: the exact value of a number.
pub(crate) fn rational(value: &Value) -> NumberResult {
    match value {
        Value::Single(x) => Ok(exact(f64::from(*x)).unwrap_or(Value::Int(0))),
        Value::Double(x) => Ok(exact(*x).unwrap_or(Value::Int(0))),
        exact if is_rational(exact) => Ok(exact.clone()),
        other => Err(not_real(other)),
    }
}

/// A finite float as an exact number.
pub(crate) fn exact(x: f64) -> Option<Value> {
    let (numerator, denominator) = exact_fraction(x)?;
    ratio(numerator, denominator)
}

/// A finite float as a fraction whose denominator is a power of two.
pub(crate) fn exact_fraction(x: f64) -> Option<(BigInt, BigInt)> {
    if !x.is_finite() {
        return None;
    }
    let (mantissa, exponent, sign) = num_traits::float::FloatCore::integer_decode(x);
    let signed = BigInt::from(mantissa) * i32::from(sign);
    let shift = usize::from(exponent.unsigned_abs());
    Some(if exponent >= 0 {
        (signed << shift, BigInt::one())
    } else {
        (signed, BigInt::one() << shift)
    })
}

/// Numerator and denominator of an exact number.
pub(crate) fn fraction_of(value: &Value) -> Option<(BigInt, BigInt)> {
    match value {
        Value::Ratio(r) => Some((r.numerator.clone(), r.denominator.clone())),
        other => Some((to_big(other)?, BigInt::one())),
    }
}

/// `numerator`.
pub(crate) fn numerator(value: &Value) -> NumberResult {
    match value {
        Value::Ratio(r) => Ok(from_big(r.numerator.clone())),
        n if is_integer(n) => Ok(n.clone()),
        other => Err(crate::value::raise::Raise::type_error(
            other,
            known::RATIONAL,
        )),
    }
}

/// `denominator`.
pub(crate) fn denominator(value: &Value) -> NumberResult {
    match value {
        Value::Ratio(r) => Ok(from_big(r.denominator.clone())),
        n if is_integer(n) => Ok(Value::Int(1)),
        other => Err(crate::value::raise::Raise::type_error(
            other,
            known::RATIONAL,
        )),
    }
}

/// `rationalize`: the simplest exact number that is read back as the same float.
pub(crate) fn rationalize(value: &Value) -> NumberResult {
    let (x, is_same): (f64, fn(f64, f64) -> bool) = match value {
        Value::Single(x) => (f64::from(*x), |a, b| a as f32 == b as f32),
        Value::Double(x) => (*x, |a, b| a == b),
        other => return rational(other),
    };
    let Some((mut numerator, mut denominator)) = exact_fraction(x) else {
        return Ok(Value::Int(0));
    };
    // Convergents of the continued fraction, the first one that rounds to the float.
    let (mut p0, mut q0) = (BigInt::zero(), BigInt::one());
    let (mut p1, mut q1) = (BigInt::one(), BigInt::zero());
    while !denominator.is_zero() {
        let (whole, rest) = numerator.div_mod_floor(&denominator);
        let p2 = &whole * &p1 + &p0;
        let q2 = &whole * &q1 + &q0;
        (p0, q0, p1, q1) = (p1, q1, p2, q2);
        (numerator, denominator) = (denominator, rest);
        let digits = if matches!(value, Value::Single(_)) {
            (24, -149)
        } else {
            (53, -1074)
        };
        if is_same(fraction_to_f64(&p1, &q1, digits.0, digits.1), x) {
            break;
        }
    }
    Ok(ratio(p1, q1).unwrap_or(Value::Int(0)))
}

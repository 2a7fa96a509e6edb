//! Powers, roots and common divisors.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::arithmetic::div;
use super::compare::{is_minus, is_zero};
use super::complex;
use super::complex::is_complex;
use super::convert::{
    fraction_of, from_big, is_integer, is_number, is_rational, is_real, ratio, to_big, to_f64,
};
use super::error::{
    NumberResult, division_by_zero, invalid, not_a_number, not_an_integer, overflow,
};
use super::large;
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;

/// Integers of more bits than this (8 MB) are not computed.
pub(crate) const MAX_BITS: u64 = 1 << 26;

/// A result beyond [`MAX_BITS`].
#[cold]
pub(crate) fn too_large(operation: &str) -> Box<Raise> {
    Raise::new(
        known::HEAP_EXHAUSTED_ERROR,
        format!("The result of {operation} would have more than {MAX_BITS} bits."),
    )
}

/// `(expt base power)`.
pub fn expt(base: &Value, power: &Value) -> NumberResult {
    for operand in [base, power] {
        if !is_number(operand) {
            return Err(not_a_number(operand));
        }
    }
    if is_integer(power) && is_rational(base) {
        return exact_power(base, power);
    }
    if is_complex(base) || is_complex(power) {
        return complex::power(base, power);
    }
    let is_double = matches!(base, Value::Double(_)) || matches!(power, Value::Double(_));
    let (Some(x), Some(y)) = (to_f64(base), to_f64(power)) else {
        return Err(not_a_number(base));
    };
    if y == 0.0 {
        return Ok(float(1.0, is_double));
    }
    if x < 0.0 && y != libm::trunc(y) {
        return complex::power(base, power);
    }
    if x == 0.0 && y < 0.0 {
        return Err(division_by_zero(known::EXPT, &[base, power]));
    }
    finite(libm::pow(x, y), is_double, known::EXPT, &[base, power])
}

fn float(x: f64, is_double: bool) -> Value {
    if is_double {
        Value::Double(x)
    } else {
        Value::Single(x as f32)
    }
}

/// A float result, unless it is out of range.
pub(crate) fn finite(
    x: f64,
    is_double: bool,
    operation: crate::value::symbol::Sym,
    operands: &[&Value],
) -> NumberResult {
    let result = float(x, is_double);
    let is_finite = match result {
        Value::Single(x) => x.is_finite(),
        _ => x.is_finite(),
    };
    if is_finite {
        return Ok(result);
    }
    let had_infinity = operands.iter().any(|v| match v {
        Value::Single(x) => x.is_infinite(),
        Value::Double(x) => x.is_infinite(),
        _ => false,
    });
    if x.is_nan() {
        Err(invalid(operation, operands))
    } else if had_infinity {
        Ok(result)
    } else {
        Err(overflow(operation, operands))
    }
}

fn exact_power(base: &Value, power: &Value) -> NumberResult {
    let (Some((numerator, denominator)), Some(power)) = (fraction_of(base), to_big(power)) else {
        return Err(not_a_number(base));
    };
    let exponent = power.abs();
    let is_unit = |n: &BigInt| n.is_zero() || n.abs().is_one();
    let small = match exponent.to_u64() {
        Some(small) => small,
        // Only 0, 1 and -1 have powers that large.
        None if is_unit(&numerator) && denominator.is_one() => u64::from(exponent.is_odd()) + 2,
        None => return Err(too_large("EXPT")),
    };
    let bits = numerator.bits().max(denominator.bits());
    let is_large = bits.saturating_sub(1).saturating_mul(small) > MAX_BITS;
    if is_large && !(is_unit(&numerator) && denominator.is_one()) {
        return Err(too_large("EXPT"));
    }
    let raise_to = |n: &BigInt| -> BigInt {
        if is_unit(n) {
            // 0, 1 and -1 only depend on whether the power is zero, odd or even.
            match (small, small % 2) {
                (0, _) => BigInt::one(),
                (_, 1) => n.clone(),
                _ => large::multiply(n, n),
            }
        } else {
            large::power(n, small)
        }
    };
    let (n, d) = (raise_to(&numerator), raise_to(&denominator));
    let result = if power.is_negative() {
        ratio(d, n)
    } else {
        ratio(n, d)
    };
    result.ok_or_else(|| division_by_zero(known::DIVIDE, &[&Value::Int(1), &Value::Int(0)]))
}

/// `(sqrt x)`; complex for a negative number.
pub fn sqrt(value: &Value) -> NumberResult {
    if is_complex(value) || is_real(value) && is_minus(value)? {
        return complex::square_root(value);
    }
    let x = to_f64(value).ok_or_else(|| not_a_number(value))?;
    finite(
        x.sqrt(),
        matches!(value, Value::Double(_)),
        known::SQRT,
        &[value],
    )
}

/// `(isqrt n)`: the largest integer whose square is not above `n`.
pub fn isqrt(value: &Value) -> NumberResult {
    let expected = || Raise::type_error(value, known::UNSIGNED_BYTE);
    let n = to_big(value).ok_or_else(expected)?;
    if n.is_negative() {
        return Err(expected());
    }
    Ok(from_big(large::square_root(n.magnitude()).into()))
}

/// `(gcd a b)`.
pub fn gcd(a: &Value, b: &Value) -> NumberResult {
    let x = to_big(a).ok_or_else(|| not_an_integer(a))?;
    let y = to_big(b).ok_or_else(|| not_an_integer(b))?;
    Ok(from_big(large::common_divisor(&x, &y)))
}

/// `(lcm a b)`.
pub(crate) fn lcm(a: &Value, b: &Value) -> NumberResult {
    if is_zero(a).map_err(|_| not_an_integer(a))? || is_zero(b).map_err(|_| not_an_integer(b))? {
        return Ok(Value::Int(0));
    }
    let x = to_big(a).ok_or_else(|| not_an_integer(a))?;
    let y = to_big(b).ok_or_else(|| not_an_integer(b))?;
    let divisor = gcd(a, b)?;
    crate::value::number::arithmetic::abs(&div(&from_big(large::multiply(&x, &y)), &divisor)?)
}

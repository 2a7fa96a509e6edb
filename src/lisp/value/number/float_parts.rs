//! Mantissa, exponent and sign of floats.

use super::error::{NumberResult, not_a_float, overflow};
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;

fn like(value: &Value, x: f64) -> Value {
    match value {
        Value::Double(_) => Value::Double(x),
        _ => Value::Single(x as f32),
    }
}

fn as_double(value: &Value) -> Result<f64, Box<Raise>> {
    match value {
        Value::Single(x) => Ok(f64::from(*x)),
        Value::Double(x) => Ok(*x),
        other => Err(not_a_float(other)),
    }
}

fn sign(value: &Value, x: f64) -> Value {
    like(value, if x.is_sign_negative() { -1.0 } else { 1.0 })
}

/// `decode-float`: a mantissa in 1/2 .. 1, an exponent, and the sign as a float.
pub fn decode(value: &Value) -> Result<[Value; 3], Box<Raise>> {
    let x = as_double(value)?;
    let (mantissa, exponent) = libm::frexp(x.abs());
    Ok([
        like(value, mantissa),
        Value::Int(i64::from(exponent)),
        sign(value, x),
    ])
}

/// `integer-decode-float`: an integer mantissa, an exponent, and the sign as an integer.
pub(crate) fn integer_decode(value: &Value) -> Result<[Value; 3], Box<Raise>> {
    let x = as_double(value)?;
    let bits = if matches!(value, Value::Double(_)) {
        53
    } else {
        24
    };
    let (mantissa, exponent) = libm::frexp(x.abs());
    // A whole number of at most 53 bits; infinities and NaN have no mantissa.
    let scaled = libm::ldexp(mantissa, bits);
    let integer = Value::Int(if scaled.is_finite() { scaled as i64 } else { 0 });
    let exponent = if x == 0.0 { 0 } else { exponent - bits };
    Ok([
        integer,
        Value::Int(i64::from(exponent)),
        Value::Int(if x.is_sign_negative() { -1 } else { 1 }),
    ])
}

/// `(scale-float x n)`: x times two to the power of n.
pub fn scale(value: &Value, power: &Value) -> NumberResult {
    let x = as_double(value)?;
    let n = match power {
        Value::Int(n) => i32::try_from((*n).clamp(-10_000, 10_000)).unwrap_or(0),
        other => return Err(crate::value::number::error::not_an_integer(other)),
    };
    let result = like(value, libm::ldexp(x, n));
    match as_double(&result)? {
        r if r.is_infinite() && x.is_finite() => Err(overflow(known::SCALE_FLOAT, &[value, power])),
        _ => Ok(result),
    }
}

/// `float-digits`: bits of the mantissa.
pub fn digits(value: &Value) -> NumberResult {
    match value {
        Value::Single(_) => Ok(Value::Int(24)),
        Value::Double(_) => Ok(Value::Int(53)),
        other => Err(not_a_float(other)),
    }
}

/// `float-precision`: significant bits of the mantissa.
pub(crate) fn precision(value: &Value) -> NumberResult {
    let x = as_double(value)?;
    let (full, lowest) = match value {
        Value::Double(_) => (53, -1074),
        _ => (24, -149),
    };
    if x == 0.0 {
        return Ok(Value::Int(0));
    }
    let (_, exponent) = libm::frexp(x.abs());
    Ok(Value::Int(i64::from((exponent - lowest).min(full))))
}

/// `(float-sign x y)`: the magnitude of y with the sign of x.
pub(crate) fn sign_of(value: &Value, magnitude: Option<&Value>) -> NumberResult {
    let x = as_double(value)?;
    match magnitude {
        None => Ok(sign(value, x)),
        Some(y) => {
            let magnitude = as_double(y)?.abs();
            Ok(like(
                y,
                if x.is_sign_negative() {
                    -magnitude
                } else {
                    magnitude
                },
            ))
        }
    }
}

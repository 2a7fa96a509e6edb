//! Logarithms, exponentials, trigonometric and hyperbolic functions.
//!
//! All go through `libm`, so that results have the same bits on every platform. A single
//! float is computed as a double and rounded.

use std::f64::consts::LN_2;

use num_traits::ToPrimitive;

use super::arithmetic::div;
use super::compare::{is_minus, is_zero};
use super::complex;
use super::convert::to_f64;
use super::error::{NumberResult, complex_result, division_by_zero, not_a_number};
use super::exponential;
use super::power::finite;
use crate::lisp::value::Value;
use crate::lisp::value::known;
use crate::lisp::value::symbol::Sym;

fn is_double(value: &Value) -> bool {
    matches!(value, Value::Double(_))
}

fn apply(value: &Value, operation: Sym, function: fn(f64) -> f64) -> NumberResult {
    let x = to_f64(value).ok_or_else(|| not_a_number(value))?;
    finite(function(x), is_double(value), operation, &[value])
}

macro_rules! functions {
    ($($(#[$doc:meta])* $name:ident = $sym:ident;)*) => {
        $($(#[$doc])*
        pub(crate) fn $name(value: &Value) -> NumberResult {
            apply(value, known::$sym, libm::$name)
        })*
    };
}

functions! {
    /// `(sin x)`, x in rad.
    sin = SIN;
    /// `(cos x)`, x in rad.
    cos = COS;
    /// `(tan x)`, x in rad.
    tan = TAN;
    /// `(atan x)`, in rad.
    atan = ATAN;
    /// `(sinh x)`.
    sinh = SINH;
    /// `(cosh x)`.
    cosh = COSH;
    /// `(tanh x)`.
    tanh = TANH;
    /// `(asinh x)`.
    asinh = ASINH;
}

/// `(exp x)`.
pub(crate) fn exp(value: &Value) -> NumberResult {
    if complex::is_complex(value) {
        return complex::exponential(value);
    }
    apply(value, known::EXP, exponential::exp)
}

/// A function that is real only where `holds` is true.
fn apply_within(
    value: &Value,
    operation: Sym,
    function: fn(f64) -> f64,
    holds: fn(f64) -> bool,
) -> NumberResult {
    let x = to_f64(value).ok_or_else(|| not_a_number(value))?;
    if !holds(x) {
        return Err(complex_result(operation, value));
    }
    finite(function(x), is_double(value), operation, &[value])
}

/// `(asin x)`, in rad.
pub(crate) fn asin(value: &Value) -> NumberResult {
    apply_within(value, known::ASIN, libm::asin, |x| x.abs() <= 1.0)
}

/// `(acos x)`, in rad.
pub(crate) fn acos(value: &Value) -> NumberResult {
    apply_within(value, known::ACOS, libm::acos, |x| x.abs() <= 1.0)
}

/// `(acosh x)`.
pub(crate) fn acosh(value: &Value) -> NumberResult {
    apply_within(value, known::ACOSH, libm::acosh, |x| x >= 1.0)
}

/// `(atanh x)`.
pub(crate) fn atanh(value: &Value) -> NumberResult {
    apply_within(value, known::ATANH, libm::atanh, |x| x.abs() <= 1.0)
}

/// `(atan y x)`: the angle (rad) of the vector (x, y).
pub(crate) fn atan2(y: &Value, x: &Value) -> NumberResult {
    let to = |v: &Value| to_f64(v).ok_or_else(|| crate::lisp::value::number::error::not_real(v));
    let angle = libm::atan2(to(y)?, to(x)?);
    finite(angle, is_double(y) || is_double(x), known::ATAN, &[y, x])
}

/// The natural logarithm of a positive number, however large.
fn natural(value: &Value) -> Option<f64> {
    match value {
        Value::Big(n) => {
            // A shift leaves 64 significant bits, plenty for a double.
            let shift = n.bits().saturating_sub(64);
            let top = n.as_ref() >> shift;
            Some(libm::log(top.to_f64()?) + shift as f64 * LN_2)
        }
        Value::Ratio(r) => {
            let as_double = to_f64(value)?;
            if as_double.is_normal() {
                return Some(libm::log(as_double));
            }
            let of = |n: &num_bigint::BigInt| {
                natural(&crate::lisp::value::number::convert::from_big(n.clone()))
            };
            Some(of(&r.numerator)? - of(&r.denominator)?)
        }
        other => to_f64(other).map(libm::log),
    }
}

/// `(log x)`; complex for a negative number; zero has none.
pub(crate) fn log(value: &Value) -> NumberResult {
    if is_zero(value)? {
        return Err(division_by_zero(known::LOG, &[value]));
    }
    if complex::is_complex(value) || is_minus(value)? {
        return complex::logarithm(value);
    }
    let x = natural(value).ok_or_else(|| not_a_number(value))?;
    finite(x, is_double(value), known::LOG, &[value])
}

/// `(log x base)`.
pub(crate) fn log_base(value: &Value, base: &Value) -> NumberResult {
    if let (Value::Int(x), Value::Int(b)) = (value, base)
        && *x > 0
        && *b > 1
    {
        let result = libm::log2(*x as f64) / libm::log2(*b as f64);
        return Ok(Value::Single(result as f32));
    }
    if is_double(value) != is_double(base) && !complex::is_complex(value) {
        let x = natural_checked(value)?;
        let b = natural_checked(base)?;
        return div(&Value::Double(x), &Value::Double(b));
    }
    div(&log(value)?, &log(base)?)
}

fn natural_checked(value: &Value) -> Result<f64, Box<crate::lisp::value::raise::Raise>> {
    log(value)?;
    natural(value).ok_or_else(|| not_a_number(value))
}

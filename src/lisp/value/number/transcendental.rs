//! Logarithms, exponentials, trigonometric and hyperbolic functions.
//!
//! All go through `libm`, so that results have the same bits on every platform. A single
//! float is computed as a double and rounded.

use std::f64::consts::LN_2;

use num_traits::ToPrimitive;

use super::arithmetic::div;
use super::compare::{is_minus, is_zero};
use super::complex;
use super::complex_trigonometry;
use super::convert::to_f64;
use super::error::{NumberResult, division_by_zero, not_a_number};
use super::exponential;
use super::power::finite;
use crate::value::Value;
use crate::value::known;
use crate::value::symbol::Sym;

fn is_double(value: &Value) -> bool {
    matches!(value, Value::Double(_))
}

fn apply(
    value: &Value,
    operation: Sym,
    function: fn(f64) -> f64,
    of_complex: complex_trigonometry::Function,
) -> NumberResult {
    if complex::is_complex(value) {
        return complex_trigonometry::apply(value, of_complex);
    }
    let x = to_f64(value).ok_or_else(|| not_a_number(value))?;
    finite(function(x), is_double(value), operation, &[value])
}

macro_rules! functions {
    ($($(#[$doc:meta])* $name:ident = $sym:ident;)*) => {
        $($(#[$doc])*
        pub(crate) fn $name(value: &Value) -> NumberResult {
            apply(value, known::$sym, libm::$name, complex_trigonometry::$name)
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
    let x = to_f64(value).ok_or_else(|| not_a_number(value))?;
    finite(exponential::exp(x), is_double(value), known::EXP, &[value])
}

/// A function that is real only within bounds. Beyond them, reals lie on a branch cut: above the bounds,
/// on its side where imaginary parts have the sign of `above`; below them, of `below`.
struct Bounded {
    operation: Sym,
    function: fn(f64) -> f64,
    of_complex: complex_trigonometry::Function,
    least: f64,
    most: f64,
    above: f64,
    below: f64,
}

impl Bounded {
    fn apply(&self, value: &Value) -> NumberResult {
        if complex::is_complex(value) {
            return complex_trigonometry::apply(value, self.of_complex);
        }
        let x = to_f64(value).ok_or_else(|| not_a_number(value))?;
        let side = match x {
            _ if x > self.most => self.above,
            _ if x < self.least => self.below,
            _ => {
                return finite(
                    (self.function)(x),
                    is_double(value),
                    self.operation,
                    &[value],
                );
            }
        };
        complex_trigonometry::apply_beside_cut(value, side, self.of_complex)
    }
}

/// `(asin x)`, in rad.
pub fn asin(value: &Value) -> NumberResult {
    let bounded = Bounded {
        operation: known::ASIN,
        function: libm::asin,
        of_complex: complex_trigonometry::asin,
        least: -1.0,
        most: 1.0,
        above: -0.0,
        below: 0.0,
    };
    bounded.apply(value)
}

/// `(acos x)`, in rad.
pub fn acos(value: &Value) -> NumberResult {
    let bounded = Bounded {
        operation: known::ACOS,
        function: libm::acos,
        of_complex: complex_trigonometry::acos,
        least: -1.0,
        most: 1.0,
        above: -0.0,
        below: 0.0,
    };
    bounded.apply(value)
}

/// `(acosh x)`.
pub(crate) fn acosh(value: &Value) -> NumberResult {
    let bounded = Bounded {
        operation: known::ACOSH,
        function: libm::acosh,
        of_complex: complex_trigonometry::acosh,
        least: 1.0,
        most: f64::INFINITY,
        above: 0.0,
        below: 0.0,
    };
    bounded.apply(value)
}

/// `(atanh x)`.
pub(crate) fn atanh(value: &Value) -> NumberResult {
    let bounded = Bounded {
        operation: known::ATANH,
        function: libm::atanh,
        of_complex: complex_trigonometry::atanh,
        least: -1.0,
        most: 1.0,
        above: 0.0,
        below: -0.0,
    };
    bounded.apply(value)
}

/// `(atan y x)`: the angle (rad) of the vector (x, y).
pub fn atan2(y: &Value, x: &Value) -> NumberResult {
    let to = |v: &Value| to_f64(v).ok_or_else(|| crate::value::number::error::not_real(v));
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
                natural(&crate::value::number::convert::from_big(n.clone()))
            };
            Some(of(&r.numerator)? - of(&r.denominator)?)
        }
        other => to_f64(other).map(libm::log),
    }
}

/// `(log x)`; complex for a negative number; zero has none.
pub fn log(value: &Value) -> NumberResult {
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

fn natural_checked(value: &Value) -> Result<f64, Box<crate::value::raise::Raise>> {
    log(value)?;
    natural(value).ok_or_else(|| not_a_number(value))
}

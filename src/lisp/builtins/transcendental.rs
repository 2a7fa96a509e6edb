//! Powers, roots, logarithms, trigonometric and hyperbolic functions.

use crate::builtin::Builtin;
use crate::typed::{self, builtin, builtins};
use crate::value::raise::Raise;
use crate::value::{Value, number};

/// The base to the power.
///
/// `(expt 2 10)` => `1024`
/// `(expt 2 0.5)` => `1.4142135`
/// `(expt 2 -1)` => `1/2`
#[builtin]
fn expt(base: &Value, power: &Value) -> Result<Value, Box<Raise>> {
    number::expt(base, power)
}

/// The square root; that of a negative number is complex.
///
/// `(sqrt 2d0)` => `1.4142135623730951d0`
/// `(sqrt -1)` => `#C(0.0 1.0)`
#[builtin]
fn sqrt(number: &Value) -> Result<Value, Box<Raise>> {
    number::sqrt(number)
}

/// e to the power of the number.
///
/// `(exp 0)` => `1.0`
#[builtin]
fn exp(number: &Value) -> Result<Value, Box<Raise>> {
    number::exp(number)
}

/// The natural logarithm, or that to a base.
///
/// `(log 8 2)` => `3.0`
/// `(log 10d0)` => `2.302585092994046d0`
#[builtin(_, "number &optional base")]
fn log(number: &Value, base_value: Option<&Value>) -> Result<Value, Box<Raise>> {
    match base_value {
        Some(base) => number::log_base(number, base),
        None => number::log(number),
    }
}

/// The sine of an angle in rad.
///
/// `(sin 0)` => `0.0`
/// `(sin (/ pi 6))` => `0.49999999999999994d0`
#[builtin]
fn sin(radians: &Value) -> Result<Value, Box<Raise>> {
    number::sin(radians)
}

/// The cosine of an angle in rad.
///
/// `(cos pi)` => `-1.0d0`
#[builtin]
fn cos(radians: &Value) -> Result<Value, Box<Raise>> {
    number::cos(radians)
}

/// The tangent of an angle in rad.
///
/// `(tan 0)` => `0.0`
#[builtin]
fn tan(radians: &Value) -> Result<Value, Box<Raise>> {
    number::tan(radians)
}

/// The angle in rad whose sine is the number.
///
/// `(asin 1)` => `1.5707964`
#[builtin]
fn asin(number: &Value) -> Result<Value, Box<Raise>> {
    number::asin(number)
}

/// The angle in rad whose cosine is the number.
///
/// `(acos 1.0)` => `0.0`
#[builtin]
fn acos(number: &Value) -> Result<Value, Box<Raise>> {
    number::acos(number)
}

/// The angle in rad whose tangent is y, or that of the vector (x, y).
///
/// `(atan 1)` => `0.7853982`
/// `(atan -1 -1)` => `-2.3561945`
#[builtin(_, "y &optional x")]
fn atan(y: &Value, x_value: Option<&Value>) -> Result<Value, Box<Raise>> {
    match x_value {
        Some(x) => number::atan2(y, x),
        None => number::atan(y),
    }
}

/// The hyperbolic sine.
///
/// `(sinh 1d0)` => `1.1752011936438014d0`
#[builtin]
fn sinh(number: &Value) -> Result<Value, Box<Raise>> {
    number::sinh(number)
}

/// The hyperbolic cosine.
///
/// `(cosh 0)` => `1.0`
#[builtin]
fn cosh(number: &Value) -> Result<Value, Box<Raise>> {
    number::cosh(number)
}

/// The hyperbolic tangent.
///
/// `(tanh 0)` => `0.0`
#[builtin]
fn tanh(number: &Value) -> Result<Value, Box<Raise>> {
    number::tanh(number)
}

/// The inverse of the hyperbolic sine.
///
/// `(asinh 0)` => `0.0`
#[builtin]
fn asinh(number: &Value) -> Result<Value, Box<Raise>> {
    number::asinh(number)
}

/// The inverse of the hyperbolic cosine.
///
/// `(acosh 1)` => `0.0`
#[builtin]
fn acosh(number: &Value) -> Result<Value, Box<Raise>> {
    number::acosh(number)
}

/// The inverse of the hyperbolic tangent.
///
/// `(atanh 0)` => `0.0`
#[builtin]
fn atanh(number: &Value) -> Result<Value, Box<Raise>> {
    number::atanh(number)
}

/// The complex number with these parts.
///
/// `(complex 1 2)` => `#C(1 2)`
/// `(complex 1 0)` => `1`
#[builtin]
fn complex(realpart: &Value, imagpart: Option<&Value>) -> Result<Value, Box<Raise>> {
    match imagpart {
        Some(imaginary) => number::complex(realpart, imaginary),
        None => number::complex(realpart, &Value::Int(0)),
    }
}

/// The real part.
///
/// `(realpart #c(1 2))` => `1`
#[builtin]
fn realpart(number: &Value) -> Result<Value, Box<Raise>> {
    number::real_part(number)
}

/// The imaginary part.
///
/// `(imagpart #c(1 2))` => `2`
/// `(imagpart 5)` => `0`
#[builtin]
fn imagpart(number: &Value) -> Result<Value, Box<Raise>> {
    number::imaginary_part(number)
}

/// The complex conjugate.
///
/// `(conjugate #c(1 2))` => `#C(1 -2)`
#[builtin]
fn conjugate(number: &Value) -> Result<Value, Box<Raise>> {
    number::conjugate(number)
}

/// The angle in rad of the number in the plane.
///
/// `(phase -1)` => `3.1415927`
#[builtin]
fn phase(number: &Value) -> Result<Value, Box<Raise>> {
    number::phase(number)
}

/// The complex number of magnitude one at an angle in rad.
///
/// `(cis 0)` => `#C(1.0 0.0)`
#[builtin]
fn cis(radians: &Value) -> Result<Value, Box<Raise>> {
    number::cis(radians)
}

/// Builtins of package `COMMON-LISP`.
pub(crate) static TABLE: &[Builtin] = builtins![
    expt, sqrt, exp, log, sin, cos, tan, asin, acos, atan, sinh, cosh, tanh, asinh, acosh, atanh,
    complex, realpart, imagpart, conjugate, phase, cis,
];

//! Powers, roots, logarithms, trigonometric and hyperbolic functions.

use crate::lisp::builtin::Builtin;
use crate::lisp::value::raise::Raise;
use crate::lisp::value::{Value, number};
use crate::lisp::{builtin, builtins};

/// The base to the power.
///
/// `(expt 2 10)` => `1024`
/// `(expt 2 0.5)` => `1.4142135`
/// `(expt 2 -1)` => `1/2`
#[builtin(_, "base power")]
fn expt(args: &[Value]) -> Result<Value, Box<Raise>> {
    number::expt(&args[0], &args[1])
}

/// The square root; that of a negative number is complex.
///
/// `(sqrt 2d0)` => `1.4142135623730951d0`
/// `(sqrt -1)` => `#C(0.0 1.0)`
#[builtin(_, "number")]
fn sqrt(args: &[Value]) -> Result<Value, Box<Raise>> {
    number::sqrt(&args[0])
}

/// e to the power of the number.
///
/// `(exp 0)` => `1.0`
#[builtin(_, "number")]
fn exp(args: &[Value]) -> Result<Value, Box<Raise>> {
    number::exp(&args[0])
}

/// The natural logarithm, or that to a base.
///
/// `(log 8 2)` => `3.0`
/// `(log 10d0)` => `2.302585092994046d0`
#[builtin(_, "number &optional base")]
fn log(args: &[Value]) -> Result<Value, Box<Raise>> {
    match args.get(1) {
        Some(base) => number::log_base(&args[0], base),
        None => number::log(&args[0]),
    }
}

/// The sine of an angle in rad.
///
/// `(sin 0)` => `0.0`
/// `(sin (/ pi 6))` => `0.49999999999999994d0`
#[builtin(_, "radians")]
fn sin(args: &[Value]) -> Result<Value, Box<Raise>> {
    number::sin(&args[0])
}

/// The cosine of an angle in rad.
///
/// `(cos pi)` => `-1.0d0`
#[builtin(_, "radians")]
fn cos(args: &[Value]) -> Result<Value, Box<Raise>> {
    number::cos(&args[0])
}

/// The tangent of an angle in rad.
///
/// `(tan 0)` => `0.0`
#[builtin(_, "radians")]
fn tan(args: &[Value]) -> Result<Value, Box<Raise>> {
    number::tan(&args[0])
}

/// The angle in rad whose sine is the number.
///
/// `(asin 1)` => `1.5707964`
#[builtin(_, "number")]
fn asin(args: &[Value]) -> Result<Value, Box<Raise>> {
    number::asin(&args[0])
}

/// The angle in rad whose cosine is the number.
///
/// `(acos 1.0)` => `0.0`
#[builtin(_, "number")]
fn acos(args: &[Value]) -> Result<Value, Box<Raise>> {
    number::acos(&args[0])
}

/// The angle in rad whose tangent is y, or that of the vector (x, y).
///
/// `(atan 1)` => `0.7853982`
/// `(atan -1 -1)` => `-2.3561945`
#[builtin(_, "y &optional x")]
fn atan(args: &[Value]) -> Result<Value, Box<Raise>> {
    match args.get(1) {
        Some(x) => number::atan2(&args[0], x),
        None => number::atan(&args[0]),
    }
}

/// The hyperbolic sine.
///
/// `(sinh 1d0)` => `1.1752011936438014d0`
#[builtin(_, "number")]
fn sinh(args: &[Value]) -> Result<Value, Box<Raise>> {
    number::sinh(&args[0])
}

/// The hyperbolic cosine.
///
/// `(cosh 0)` => `1.0`
#[builtin(_, "number")]
fn cosh(args: &[Value]) -> Result<Value, Box<Raise>> {
    number::cosh(&args[0])
}

/// The hyperbolic tangent.
///
/// `(tanh 0)` => `0.0`
#[builtin(_, "number")]
fn tanh(args: &[Value]) -> Result<Value, Box<Raise>> {
    number::tanh(&args[0])
}

/// The inverse of the hyperbolic sine.
///
/// `(asinh 0)` => `0.0`
#[builtin(_, "number")]
fn asinh(args: &[Value]) -> Result<Value, Box<Raise>> {
    number::asinh(&args[0])
}

/// The inverse of the hyperbolic cosine.
///
/// `(acosh 1)` => `0.0`
#[builtin(_, "number")]
fn acosh(args: &[Value]) -> Result<Value, Box<Raise>> {
    number::acosh(&args[0])
}

/// The inverse of the hyperbolic tangent.
///
/// `(atanh 0)` => `0.0`
#[builtin(_, "number")]
fn atanh(args: &[Value]) -> Result<Value, Box<Raise>> {
    number::atanh(&args[0])
}

/// The complex number with these parts.
///
/// `(complex 1 2)` => `#C(1 2)`
/// `(complex 1 0)` => `1`
#[builtin(_, "realpart &optional imagpart")]
fn complex(args: &[Value]) -> Result<Value, Box<Raise>> {
    match args.get(1) {
        Some(imaginary) => number::complex(&args[0], imaginary),
        None => number::complex(&args[0], &Value::Int(0)),
    }
}

/// The real part.
///
/// `(realpart #c(1 2))` => `1`
#[builtin(_, "number")]
fn realpart(args: &[Value]) -> Result<Value, Box<Raise>> {
    number::real_part(&args[0])
}

/// The imaginary part.
///
/// `(imagpart #c(1 2))` => `2`
/// `(imagpart 5)` => `0`
#[builtin(_, "number")]
fn imagpart(args: &[Value]) -> Result<Value, Box<Raise>> {
    number::imaginary_part(&args[0])
}

/// The complex conjugate.
///
/// `(conjugate #c(1 2))` => `#C(1 -2)`
#[builtin(_, "number")]
fn conjugate(args: &[Value]) -> Result<Value, Box<Raise>> {
    number::conjugate(&args[0])
}

/// The angle in rad of the number in the plane.
///
/// `(phase -1)` => `3.1415927`
#[builtin(_, "number")]
fn phase(args: &[Value]) -> Result<Value, Box<Raise>> {
    number::phase(&args[0])
}

/// The complex number of magnitude one at an angle in rad.
///
/// `(cis 0)` => `#C(1.0 0.0)`
#[builtin(_, "radians")]
fn cis(args: &[Value]) -> Result<Value, Box<Raise>> {
    number::cis(&args[0])
}

/// Builtins of package `COMMON-LISP`.
pub(crate) static TABLE: &[Builtin] = builtins![
    expt, sqrt, exp, log, sin, cos, tan, asin, acos, atan, sinh, cosh, tanh, asinh, acosh, atanh,
    complex, realpart, imagpart, conjugate, phase, cis,
];

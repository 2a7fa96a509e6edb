//! Trigonometric and hyperbolic functions of complex numbers, and their inverses.
//!
//! Computed in doubles, by formulas in square roots that lose no digits near the branch cuts (W. Kahan).
//! The sign of a zero imaginary part tells on which side of a cut a number is.

use std::f64::consts::PI;

use super::complex::{as_doubles, float};
use super::error::NumberResult;
use crate::value::Value;

/// Real and imaginary part.
type Pair = (f64, f64);

/// A function of a complex number.
pub(super) type Function = fn(Pair) -> Pair;

/// The value of a function for a number.
pub(super) fn apply(value: &Value, function: Function) -> NumberResult {
    let (re, im, is_double) = as_doubles(value)?;
    let (re, im) = function((re, im));
    float(re, im, is_double)
}

/// The value of a function for a real number, on that side of the branch cut that the sign of `zero` tells.
pub(super) fn apply_beside_cut(value: &Value, zero: f64, function: Function) -> NumberResult {
    let (re, _, is_double) = as_doubles(value)?;
    let (re, im) = function((re, zero));
    float(re, im, is_double)
}

/// The square root with a real part that is not negative.
fn root((x, y): Pair) -> Pair {
    let magnitude = libm::hypot(x, y);
    if magnitude == 0.0 {
        return (0.0, y);
    }
    let larger = libm::sqrt((magnitude + x.abs()) / 2.0);
    let smaller = y.abs() / (2.0 * larger);
    let (re, im) = if x >= 0.0 {
        (larger, smaller)
    } else {
        (smaller, larger)
    };
    (re, im.copysign(y))
}

/// The natural logarithm.
fn logarithm((x, y): Pair) -> Pair {
    (libm::log(libm::hypot(x, y)), libm::atan2(y, x))
}

/// The number times `i`.
fn turned((x, y): Pair) -> Pair {
    (-y, x)
}

/// The number divided by `i`.
fn turned_back((x, y): Pair) -> Pair {
    (y, -x)
}

pub(super) fn sinh((x, y): Pair) -> Pair {
    let (sine, cosine) = libm::sincos(y);
    (libm::sinh(x) * cosine, libm::cosh(x) * sine)
}

pub(super) fn cosh((x, y): Pair) -> Pair {
    let (sine, cosine) = libm::sincos(y);
    (libm::cosh(x) * cosine, libm::sinh(x) * sine)
}

/// Beyond this, the hyperbolic tangent of a real number is one.
const FAR: f64 = 20.0;

pub(super) fn tanh((x, y): Pair) -> Pair {
    let (sine, cosine) = libm::sincos(y);
    if x.abs() > FAR {
        let im = 4.0 * sine * cosine * libm::exp(-2.0 * x.abs());
        return (1.0_f64.copysign(x), im);
    }
    let below = libm::cosh(2.0 * x) + libm::cos(2.0 * y);
    (libm::sinh(2.0 * x) / below, 2.0 * sine * cosine / below)
}

pub(super) fn sin(z: Pair) -> Pair {
    turned_back(sinh(turned(z)))
}

pub(super) fn cos(z: Pair) -> Pair {
    cosh(turned(z))
}

pub(super) fn tan(z: Pair) -> Pair {
    turned_back(tanh(turned(z)))
}

pub(super) fn asin((x, y): Pair) -> Pair {
    let (minus, plus) = (root((1.0 - x, -y)), root((1.0 + x, y)));
    let re = libm::atan2(x, minus.0 * plus.0 - minus.1 * plus.1);
    (re, libm::asinh(minus.0 * plus.1 - minus.1 * plus.0))
}

pub(super) fn acos((x, y): Pair) -> Pair {
    let (minus, plus) = (root((1.0 - x, -y)), root((1.0 + x, y)));
    let im = libm::asinh(plus.0 * minus.1 - plus.1 * minus.0);
    (2.0 * libm::atan2(minus.0, plus.0), im)
}

pub(super) fn acosh((x, y): Pair) -> Pair {
    let (minus, plus) = (root((x - 1.0, y)), root((x + 1.0, y)));
    let re = libm::asinh(minus.0 * plus.0 + minus.1 * plus.1);
    (re, 2.0 * libm::atan2(minus.1, plus.0))
}

pub(super) fn asinh(z: Pair) -> Pair {
    turned_back(asin(turned(z)))
}

pub(super) fn atanh((x, y): Pair) -> Pair {
    let (plus, minus) = (logarithm((1.0 + x, y)), logarithm((1.0 - x, -y)));
    let im = plus.1 - minus.1;
    // The difference of two angles has rounding errors, which must not lead beyond a right angle.
    ((plus.0 - minus.0) / 2.0, im.clamp(-PI, PI) / 2.0)
}

pub(super) fn atan(z: Pair) -> Pair {
    turned_back(atanh(turned(z)))
}

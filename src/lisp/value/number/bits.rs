//! Integers as sequences of bits in two's complement.

use num_bigint::BigInt;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::convert::{from_big, to_big};
use super::error::{NumberResult, not_an_integer};
use super::power::{MAX_BITS, too_large};
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;

/// `(byte size position)`: a run of bits.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct ByteSpecifier {
    /// Number of bits.
    pub size: u32,
    /// Number of bits below.
    pub position: u32,
}

fn big(value: &Value) -> Result<BigInt, Box<Raise>> {
    to_big(value).ok_or_else(|| not_an_integer(value))
}

macro_rules! bitwise {
    ($($(#[$doc:meta])* $name:ident = $operator:tt;)*) => {
        $($(#[$doc])*
        pub(crate) fn $name(a: &Value, b: &Value) -> NumberResult {
            match (a, b) {
                (Value::Int(x), Value::Int(y)) => Ok(Value::Int(x $operator y)),
                _ => Ok(from_big(big(a)? $operator big(b)?)),
            }
        })*
    };
}

bitwise! {
    /// `(logand a b)`.
    and = &;
    /// `(logior a b)`.
    or = |;
    /// `(logxor a b)`.
    xor = ^;
}

/// `(lognot a)`.
pub fn not(a: &Value) -> NumberResult {
    match a {
        Value::Int(x) => Ok(Value::Int(!x)),
        other => Ok(from_big(!big(other)?)),
    }
}

/// `(ash a count)`: shifted to the left, or to the right if negative.
pub(crate) fn ash(a: &Value, count: &Value) -> NumberResult {
    let n = big(a)?;
    let count = match count {
        Value::Int(count) => *count,
        Value::Big(count) if count.is_negative() => i64::MIN,
        Value::Big(_) => i64::MAX,
        other => return Err(not_an_integer(other)),
    };
    if n.is_zero() || count == 0 {
        return Ok(a.clone());
    }
    let distance = count.unsigned_abs();
    if count > 0 {
        if distance.saturating_add(n.bits()) > MAX_BITS {
            return Err(too_large("ASH"));
        }
        return Ok(from_big(n << distance));
    }
    if distance > n.bits() {
        return Ok(Value::Int(if n.is_negative() { -1 } else { 0 }));
    }
    Ok(from_big(n >> distance))
}

/// `(integer-length a)`.
pub(crate) fn bit_length(a: &Value) -> NumberResult {
    let n = big(a)?;
    let n = if n.is_negative() { !n } else { n };
    Ok(Value::Int(i64::try_from(n.bits()).unwrap_or(i64::MAX)))
}

/// `(logcount a)`: the bits that differ from the sign.
pub(crate) fn bit_count(a: &Value) -> NumberResult {
    let n = big(a)?;
    let n = if n.is_negative() { !n } else { n };
    Ok(Value::Int(
        i64::try_from(n.magnitude().count_ones()).unwrap_or(i64::MAX),
    ))
}

/// `(logbitp index a)`.
pub(crate) fn is_bit_set(index: &Value, a: &Value) -> Result<bool, Box<Raise>> {
    let n = big(a)?;
    match index {
        Value::Int(i) if *i >= 0 => Ok(n.bit(i.unsigned_abs())),
        Value::Big(i) if i.is_positive() => Ok(n.is_negative()),
        other => Err(Raise::type_error(other, known::UNSIGNED_BYTE)),
    }
}

fn mask(size: u32) -> BigInt {
    (BigInt::one() << size) - 1
}

/// `(ldb byte a)`.
pub(crate) fn extract(byte: ByteSpecifier, a: &Value) -> NumberResult {
    let n = big(a)?;
    if let (Some(small), true) = (n.to_i64(), byte.size < 63) {
        let shifted = small >> byte.position.min(63);
        return Ok(Value::Int(shifted & ((1 << byte.size) - 1)));
    }
    if u64::from(byte.size) > MAX_BITS {
        return Err(too_large("LDB"));
    }
    Ok(from_big((n >> byte.position) & mask(byte.size)))
}

/// `(dpb new byte a)`.
pub(crate) fn deposit(new: &Value, byte: ByteSpecifier, a: &Value) -> NumberResult {
    let (new, n) = (big(new)?, big(a)?);
    if u64::from(byte.size) + u64::from(byte.position) > MAX_BITS {
        return Err(too_large("DPB"));
    }
    let mask = mask(byte.size);
    let cleared = n & !(&mask << byte.position);
    Ok(from_big(cleared | ((new & mask) << byte.position)))
}

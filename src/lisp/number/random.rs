//! Pseudo-random numbers from the image's generator.

use num_bigint::BigInt;
use num_traits::Signed;
use rand_pcg::Pcg64;
use rand_pcg::rand_core::Rng;

use super::super::known;
use super::super::raise::Raise;
use super::super::value::Value;
use super::convert::from_big;
use super::error::NumberResult;

/// `(random limit)`: an integer or float from zero up to, but not including, the limit.
pub fn random(generator: &mut Pcg64, limit: &Value) -> NumberResult {
    match limit {
        Value::Int(n) if *n > 0 => {
            // The high word of the product: no modulo, and no bias that could be seen.
            let product = u128::from(generator.next_u64()) * u128::from(n.unsigned_abs());
            Ok(Value::Int(i64::try_from(product >> 64).unwrap_or(0)))
        }
        Value::Big(n) if n.is_positive() => {
            let words = n.bits().div_ceil(64) + 1;
            let mut drawn = BigInt::from(0);
            for _ in 0..words {
                drawn = (drawn << 64) + generator.next_u64();
            }
            Ok(from_big((drawn * n.as_ref()) >> (words * 64)))
        }
        Value::Single(x) if *x > 0.0 => {
            let unit = (generator.next_u64() >> 40) as f32 / (1_u32 << 24) as f32;
            let drawn = unit * x;
            Ok(Value::Single(if drawn < *x { drawn } else { 0.0 }))
        }
        Value::Double(x) if *x > 0.0 => {
            let unit = (generator.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
            let drawn = unit * x;
            Ok(Value::Double(if drawn < *x { drawn } else { 0.0 }))
        }
        other => Err(Raise::type_error(
            other,
            Value::list([
                known::OR.into(),
                Value::list([known::INTEGER.into(), Value::list([Value::Int(0)])]),
                Value::list([known::FLOAT.into(), Value::list([Value::Int(0)])]),
            ]),
        )),
    }
}

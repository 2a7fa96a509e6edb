//! Pseudo-random numbers from the image's generator.

use std::cell::RefCell;

use num_bigint::{BigInt, Sign};
use num_traits::Signed;
use rand_pcg::Pcg64;
use rand_pcg::rand_core::Rng;

use super::convert::from_big;
use super::error::NumberResult;
use super::large;
use crate::value::Value;
use crate::value::copy::Copier;
use crate::value::foreign::{Foreign, ForeignCopy, PrintContext};
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;

/// A generator of its own, or the image's: the value of `*random-state*`.
pub(crate) struct RandomState {
    /// None for the image's generator.
    pub generator: Option<RefCell<Pcg64>>,
}

impl Foreign for RandomState {
    fn copied(&self, _: &mut Copier) -> ForeignCopy {
        ForeignCopy::New(Box::new(RandomState {
            generator: self.generator.clone(),
        }))
    }

    fn type_symbol(&self) -> Sym {
        known::RANDOM_STATE
    }

    fn print(&self, _: &dyn PrintContext, _: bool) -> String {
        "#<RANDOM-STATE>".to_owned()
    }
}

/// `(make-random-state state)`: a generator that continues as another one would (for `NIL`, the
/// image's) or, for `T`, unlike any other.
pub(crate) fn make_random_state(default: &mut Pcg64, state: &Value) -> NumberResult {
    let copy = match (state, state.as_foreign::<RandomState>()) {
        (Value::Symbol(known::NIL, ..), _) => default.clone(),
        (Value::Symbol(known::T, ..), _) => {
            let (seed, stream) = (default.next_u64(), default.next_u64());
            Pcg64::new(seed.into(), stream.into())
        }
        (_, Some(RandomState { generator })) => match generator {
            Some(generator) => generator.borrow().clone(),
            None => default.clone(),
        },
        _ => return Err(Raise::type_error(state, known::RANDOM_STATE)),
    };
    Ok(Value::foreign(RandomState {
        generator: Some(RefCell::new(copy)),
    }))
}

/// `(random limit state)`
pub(crate) fn random_from(default: &mut Pcg64, limit: &Value, state: &Value) -> NumberResult {
    match state.as_foreign::<RandomState>() {
        Some(RandomState {
            generator: Some(generator),
        }) => random(&mut generator.borrow_mut(), limit),
        Some(RandomState { generator: None }) => random(default, limit),
        None => Err(Raise::type_error(state, known::RANDOM_STATE)),
    }
}

/// `(random limit)`: an integer or float from zero up to, but not including, the limit.
pub(crate) fn random(generator: &mut Pcg64, limit: &Value) -> NumberResult {
    match limit {
        Value::Int(n) if *n > 0 => {
            // The high word of the product: no modulo, and no bias that could be seen.
            let product = u128::from(generator.next_u64()) * u128::from(n.unsigned_abs());
            Ok(Value::Int(i64::try_from(product >> 64).unwrap_or(0)))
        }
        Value::Big(n) if n.is_positive() => {
            let words = n.bits().div_ceil(64) + 1;
            // The word drawn first is the highest.
            let drawn: Vec<u8> = (0..words)
                .flat_map(|_| generator.next_u64().to_be_bytes())
                .collect();
            let drawn = BigInt::from_bytes_be(Sign::Plus, &drawn);
            Ok(from_big(large::multiply(&drawn, n) >> (words * 64)))
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

//! Numbers: integers of any size, ratios, single and double floats, complex numbers.
//!
//! Integers are immediate while they fit 64 bits, and every result is brought back to its
//! simplest form. Mixed operands follow Lisp's contagion: a double makes the result
//! double, else a single makes it single (computed in single precision), else it is exact.
//! Comparisons between exact numbers and floats are exact. Results that no float can hold
//! are errors, never infinities.

mod arithmetic;
mod bits;
mod compare;
mod complex;
mod complex_trigonometry;
mod convert;
mod division;
pub mod error;
mod exponential;
mod float_parts;
pub mod large;
mod power;
mod random;
mod ratio;
mod transcendental;

pub use arithmetic::{abs, add, div, sub};
pub(crate) use arithmetic::{decrement, increment, mul, negate, signum};
pub use bits::not;
pub(crate) use bits::{
    ByteSpecifier, ash, bit_count, bit_length, deposit, extract, is_bit_set, xor,
};
pub(crate) use bits::{and, or};
pub use compare::{
    compare, greater, greater_equal, is_zero, less, less_equal, maximum, number_equal,
};
pub(crate) use compare::{compare_like, equal_by_value, is_even, is_minus, is_plus, minimum};
pub(crate) use complex::{cis, complex, conjugate, imaginary_part, is_complex, phase, real_part};
pub(crate) use convert::{
    denominator, from_big, is_integer, is_rational, numerator, rational, rationalize, to_big,
    to_double, to_float_like, to_single,
};
pub use convert::{is_number, is_real, ratio, to_f64};
pub(crate) use division::{Rounding, divide, divide_to_float, modulo, remainder};
#[cfg(test)]
pub use division::{ceiling, floor, round, truncate};
pub use float_parts::{decode, digits, scale};
pub(crate) use float_parts::{integer_decode, precision, sign_of};
pub(crate) use power::lcm;
pub use power::{expt, gcd, isqrt, sqrt};
#[cfg(test)]
pub(crate) use random::random;
pub(crate) use random::{RandomState, make_random_state, random_from};
pub use ratio::Ratio;
pub use transcendental::{acos, asin, atan2, log};
pub(crate) use transcendental::{acosh, asinh, atan, atanh, cosh, exp, log_base, sinh, tan, tanh};
pub(crate) use transcendental::{cos, sin};

/// The largest fixnum: `most-positive-fixnum`.
pub(crate) const MOST_POSITIVE_FIXNUM: i64 = (1 << 62) - 1;
/// The smallest fixnum: `most-negative-fixnum`.
pub(crate) const MOST_NEGATIVE_FIXNUM: i64 = -(1 << 62);

#[cfg(test)]
mod tests;

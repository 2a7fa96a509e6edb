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

pub use arithmetic::{abs, add, decrement, div, increment, mul, negate, signum, sub};
pub use bits::{
    ByteSpecifier, and, ash, bit_count, bit_length, deposit, extract, is_bit_set, not, or, xor,
};
pub use compare::{
    compare, compare_like, equal_by_value, greater, greater_equal, is_even, is_minus, is_plus,
    is_zero, less, less_equal, maximum, minimum, number_equal,
};
pub use complex::{cis, complex, conjugate, imaginary_part, is_complex, phase, real_part};
pub use convert::{
    denominator, from_big, is_integer, is_number, is_rational, is_real, numerator, ratio, rational,
    rationalize, to_big, to_double, to_f64, to_float_like, to_single,
};
pub use division::{Rounding, divide, divide_to_float, modulo, remainder};
#[cfg(test)]
pub use division::{ceiling, floor, round, truncate};
pub use float_parts::{decode, digits, integer_decode, precision, scale, sign_of};
pub use power::{expt, gcd, isqrt, lcm, sqrt};
#[cfg(test)]
pub use random::random;
pub use random::{RandomState, make_random_state, random_from};
pub use ratio::Ratio;
pub use transcendental::{
    acos, acosh, asin, asinh, atan, atan2, atanh, cos, cosh, exp, log, log_base, sin, sinh, tan,
    tanh,
};

/// The largest fixnum: `most-positive-fixnum`.
pub const MOST_POSITIVE_FIXNUM: i64 = (1 << 62) - 1;
/// The smallest fixnum: `most-negative-fixnum`.
pub const MOST_NEGATIVE_FIXNUM: i64 = -(1 << 62);

#[cfg(test)]
mod tests;

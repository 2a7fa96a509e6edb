//! Exact fractions.

use num_bigint::BigInt;

/// A fraction in lowest terms; the denominator is greater than one.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Ratio {
    /// Numerator, with the sign.
    pub numerator: BigInt,
    /// Denominator, greater than one.
    pub denominator: BigInt,
}

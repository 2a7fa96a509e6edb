//! `exp`, correctly rounded in all but the rarest cases: computed with about 100 bits, as the sum of
//! two doubles, and rounded once. `libm::exp` may be off by one unit in the last place.
//!
//! Sums and products without error: T. J. Dekker, A floating-point technique for extending the
//! available precision, Numerische Mathematik 18 (1971).

/// ln 2 as a sum: the first part has so few bits that its product with an exponent is exact.
const LN_2: [f64; 3] = [
    0.693_147_180_369_123_8,
    1.908_214_929_270_587_7e-10,
    1.161_222_722_936_253_2e-26,
];

/// Terms of the Taylor series: for |x| ≤ ln 2 / 2 the next one is below 2⁻¹¹⁰.
const TERMS: u32 = 26;

/// Beyond these, results are infinite, or have fewer bits than other numbers.
const RANGE: std::ops::Range<f64> = -708.0..709.0;

/// A number as an unevaluated sum of a double and one that is below half a unit in its last place.
#[derive(Clone, Copy)]
struct Pair(f64, f64);

/// The exact sum of two doubles.
fn sum(a: f64, b: f64) -> Pair {
    let total = a + b;
    let of_b = total - a;
    Pair(total, (a - (total - of_b)) + (b - of_b))
}

/// A double as the sum of two that have half of its bits each.
fn halves(a: f64) -> Pair {
    let scaled = 134_217_729.0 * a;
    let high = scaled - (scaled - a);
    Pair(high, a - high)
}

/// The exact product of two doubles.
fn product(a: f64, b: f64) -> Pair {
    let value = a * b;
    let (Pair(a1, a2), Pair(b1, b2)) = (halves(a), halves(b));
    Pair(value, ((a1 * b1 - value) + a1 * b2 + a2 * b1) + a2 * b2)
}

impl Pair {
    fn plus(self, other: Pair) -> Pair {
        let Pair(high, low) = sum(self.0, other.0);
        let Pair(rest, lowest) = sum(self.1, other.1);
        let Pair(high, low) = sum(high, low + rest);
        sum(high, low + lowest)
    }

    fn times(self, other: Pair) -> Pair {
        let Pair(high, low) = product(self.0, other.0);
        sum(high, low + (self.0 * other.1 + self.1 * other.0))
    }

    fn divided_by(self, divisor: f64) -> Pair {
        let quotient = self.0 / divisor;
        let Pair(high, low) = product(quotient, divisor);
        sum(quotient, ((self.0 - high) - low + self.1) / divisor)
    }
}

/// `exp(x)`.
pub(super) fn exp(x: f64) -> f64 {
    if x == 0.0 || !RANGE.contains(&x) {
        return libm::exp(x);
    }
    // exp(x) = 2^n exp(rest), |rest| ≤ ln 2 / 2
    let n = libm::round(x * std::f64::consts::LOG2_E);
    let rest = sum(x - n * LN_2[0], 0.0);
    let rest = rest.plus({
        let Pair(high, low) = product(-n, LN_2[1]);
        sum(high, low - n * LN_2[2])
    });
    // Horner's scheme: 1 + x (1 + x/2 (1 + x/3 (…)))
    let one = Pair(1.0, 0.0);
    let mut series = one;
    for k in (1..=TERMS).rev() {
        series = series.times(rest).divided_by(f64::from(k)).plus(one);
    }
    #[allow(
        clippy::cast_possible_truncation,
        reason = "an integer of at most four digits"
    )]
    let exponent = n as i32;
    libm::ldexp(series.0 + series.1, exponent)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_are_rounded_correctly() {
        // From computations with 60 digits.
        for (x, expected) in [
            (1.0, std::f64::consts::E),
            (2.0, 7.389_056_098_930_65),
            (-1.0, 0.367_879_441_171_442_33),
            (0.5, 1.648_721_270_700_128_2),
            (10.0, 22_026.465_794_806_718),
            (-3.25, 0.038_774_207_831_722_01),
            (100.0, 2.688_117_141_816_135_6e43),
            (1e-9, 1.000_000_001),
            (700.5, 1.672_185_962_067_498_4e304),
        ] {
            assert_eq!(exp(x), expected, "exp({x})");
        }
        assert_eq!(exp(f64::INFINITY), f64::INFINITY);
        assert_eq!(exp(-800.0), 0.0);
    }
}

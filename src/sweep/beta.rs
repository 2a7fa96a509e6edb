//! The incomplete beta function, and so the binomial distribution.

/// Maximum number of terms of the continued fraction: it needs about the root of the larger parameter.
const MAX_TERMS: u32 = 5_000;
/// A ratio this close to 1 ends it.
const CLOSE: f64 = 1e-15;
/// Stands in for zero in a denominator.
const TINY: f64 = 1e-300;

/// The regularised incomplete beta function I_x(a, b), by the continued fraction of DLMF 8.17.22,
/// evaluated by Lentz's method. `a` and `b` are positive, `x` from 0 to 1.
pub(super) fn incomplete_beta(x: f64, a: f64, b: f64) -> f64 {
    if x <= 0.0 {
        return 0.0;
    }
    if x >= 1.0 {
        return 1.0;
    }
    // The fraction converges fast only below the mean.
    if x > (a + 1.0) / (a + b + 2.0) {
        return 1.0 - incomplete_beta(1.0 - x, b, a);
    }
    let front = libm::exp(
        a * libm::log(x) + b * libm::log1p(-x) + libm::lgamma(a + b)
            - libm::lgamma(a)
            - libm::lgamma(b),
    ) / a;
    let mut c = 1.0;
    let mut d = nonzero(1.0 - (a + b) * x / (a + 1.0)).recip();
    let mut fraction = d;
    for m in 1..MAX_TERMS {
        let m = f64::from(m);
        let even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        d = nonzero(1.0 + even * d).recip();
        c = nonzero(1.0 + even / c);
        fraction *= d * c;
        let odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        d = nonzero(1.0 + odd * d).recip();
        c = nonzero(1.0 + odd / c);
        let step = d * c;
        fraction *= step;
        if (step - 1.0).abs() < CLOSE {
            break;
        }
    }
    front * fraction
}

fn nonzero(number: f64) -> f64 {
    if number.abs() < TINY { TINY } else { number }
}

/// The `x` at which I_x(a, b) is `p`, by bisection.
pub(super) fn beta_quantile(p: f64, a: f64, b: f64) -> f64 {
    let (mut low, mut high) = (0.0_f64, 1.0_f64);
    // Each step halves the interval: after these it is at the resolution of a double.
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if incomplete_beta(middle, a, b) < p {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_values() {
        // I_x(1, b) = 1 - (1 - x)^b, I_x(a, 1) = x^a, I_½(a, a) = ½.
        assert!((incomplete_beta(0.3, 1.0, 4.0) - 0.759_9).abs() < 1e-14);
        assert!((incomplete_beta(0.3, 4.0, 1.0) - 0.008_1).abs() < 1e-15);
        assert!((incomplete_beta(0.5, 700.0, 700.0) - 0.5).abs() < 1e-12);
        // P(X ≥ 3) for X binomial (10, 0.4) is I_0.4(3, 8).
        assert!((incomplete_beta(0.4, 3.0, 8.0) - 0.832_710_246_4).abs() < 1e-10);
    }
}

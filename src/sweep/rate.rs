//! Rates and how certain they are.

use super::beta::beta_quantile;
use super::normal::normal_quantile;

/// An interval of rates.
pub type Interval = [f64; 2];

/// The interval in which the true rate lies with that confidence, if `hits` of `count` worlds are
/// hits: Wilson's (1927), which also does for rates near 0 and 1.
pub fn wilson(hits: usize, count: usize, confidence: f64) -> Interval {
    if count == 0 {
        return [0.0, 1.0];
    }
    let n = count as f64;
    let p = hits as f64 / n;
    let z = normal_quantile(0.5 + 0.5 * confidence);
    let scale = 1.0 + z * z / n;
    let centre = (p + z * z / (2.0 * n)) / scale;
    let half = z / scale * (p * (1.0 - p) / n + z * z / (4.0 * n * n)).sqrt();
    let low = if hits == 0 {
        0.0
    } else {
        (centre - half).max(0.0)
    };
    let high = if hits == count {
        1.0
    } else {
        (centre + half).min(1.0)
    };
    [low, high]
}

/// The rate that the true one exceeds with that confidence: Clopper and Pearson's (1934), which errs
/// at most as often as it says, for claims of the form "at least".
pub(crate) fn at_least(hits: usize, count: usize, confidence: f64) -> f64 {
    if hits == 0 {
        return 0.0;
    }
    let (hits, count) = (hits as f64, count as f64);
    beta_quantile(1.0 - confidence, hits, count - hits + 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::Draws;

    /// Values of SciPy's `binomtest(…).proportion_ci(method="wilson")`.
    #[test]
    fn wilson_intervals_are_those_of_others() {
        let close =
            |[a, b]: Interval, [c, d]: Interval| (a - c).abs() < 1e-4 && (b - d).abs() < 1e-4;
        assert!(close(wilson(81, 263, 0.95), [0.2553, 0.3662]));
        assert!(close(wilson(15, 148, 0.95), [0.0624, 0.1605]));
        assert!(close(wilson(0, 20, 0.95), [0.0, 0.1611]));
        assert!(close(wilson(1, 29, 0.95), [0.0061, 0.1718]));
        assert_eq!(wilson(0, 0, 0.95), [0.0, 1.0]);
    }

    #[test]
    fn what_all_worlds_do_is_likely_at_least() {
        // 0.05^(1/300) and 0.025^(1/300).
        assert!((at_least(300, 300, 0.95) - 0.990_064).abs() < 1e-6);
        assert!((at_least(300, 300, 0.975) - 0.987_779).abs() < 1e-6);
        assert_eq!(at_least(0, 10, 0.95), 0.0);
    }

    #[test]
    fn wilson_intervals_cover_as_often_as_they_say() {
        let mut draws = Draws::new(7, 0, "coverage");
        let (mut covered, count) = (0, 10_000);
        for _ in 0..count {
            let rate = 0.02 + 0.96 * draws.unit();
            let hits = (0..200).filter(|_| draws.unit() < rate).count();
            let [low, high] = wilson(hits, 200, 0.95);
            covered += usize::from((low..=high).contains(&rate));
        }
        let share = covered as f64 / f64::from(count);
        assert!((share - 0.95).abs() < 0.01, "{share}");
    }
}

//! Real roots of polynomials up to degree four within an interval.

/// Roots of a polynomial, ascending; at most four.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Roots {
    values: [f64; 4],
    count: usize,
}

impl Roots {
    pub(super) fn as_slice(&self) -> &[f64] {
        &self.values[..self.count]
    }

    fn push(&mut self, root: f64) {
        // A polynomial of degree n has at most n sign changes between its extremes.
        if self.count < self.values.len() {
            self.values[self.count] = root;
            self.count += 1;
        }
    }
}

/// Roots in `lo..=hi` of `c[0] + c[1] t + … + c[4] t⁴` where the polynomial changes sign.
///
/// Works upwards from the third derivative: between two neighbouring extremes a
/// polynomial is monotonic, so each sign change encloses exactly one root.
pub(super) fn quartic_roots(c: &[f64; 5], lo: f64, hi: f64) -> Roots {
    let mut extremes = Roots::default();
    for derivative in (0..4).rev() {
        let p = differentiate(c, derivative);
        let mut roots = Roots::default();
        let mut left = (lo, value(&p, lo));
        let ends = extremes.as_slice().iter().copied().chain([hi]);
        for end in ends {
            let right = (end, value(&p, end));
            if (left.1 < 0.0) != (right.1 < 0.0) {
                roots.push(root_between(&p, left, right));
            }
            left = right;
        }
        extremes = roots;
    }
    extremes
}

/// Coefficients of the n-th derivative.
fn differentiate(c: &[f64; 5], n: usize) -> [f64; 5] {
    let mut d = *c;
    for _ in 0..n {
        for i in 0..4 {
            d[i] = d[i + 1] * (i + 1) as f64;
        }
        d[4] = 0.0;
    }
    d
}

fn value(c: &[f64; 5], t: f64) -> f64 {
    (((c[4] * t + c[3]) * t + c[2]) * t + c[1]) * t + c[0]
}

fn slope(c: &[f64; 5], t: f64) -> f64 {
    ((4.0 * c[4] * t + 3.0 * c[3]) * t + 2.0 * c[2]) * t + c[1]
}

/// The root between two points (t, value) of opposite sign: Newton's method, with
/// bisection whenever a step would leave the interval.
fn root_between(c: &[f64; 5], a: (f64, f64), b: (f64, f64)) -> f64 {
    let rising = a.1 < 0.0;
    let (mut lo, mut hi) = (a.0, b.0);
    let mut t = 0.5 * (lo + hi);
    for _ in 0..60 {
        let v = value(c, t);
        if (v < 0.0) == rising {
            lo = t;
        } else {
            hi = t;
        }
        let newton = t - v / slope(c, t);
        let next = if newton > lo && newton < hi {
            newton
        } else {
            0.5 * (lo + hi)
        };
        if (next - t).abs() <= 1e-15 * t.abs().max(1e-3) {
            return next;
        }
        t = next;
    }
    t
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_all_four_roots() {
        // (t + 0.5)(t - 0.1)(t - 0.2)(t - 0.9), multiplied out.
        let mut c = [1.0, 0.0, 0.0, 0.0, 0.0];
        for root in [-0.5, 0.1, 0.2, 0.9] {
            let mut next = [0.0; 5];
            for i in 0..4 {
                next[i + 1] += c[i];
                next[i] -= root * c[i];
            }
            c = next;
        }
        let roots = quartic_roots(&c, -1.0, 1.0);
        let expected = [-0.5, 0.1, 0.2, 0.9];
        assert_eq!(roots.as_slice().len(), 4);
        for (root, expected) in roots.as_slice().iter().zip(expected) {
            assert!((root - expected).abs() < 1e-12, "{root} is not {expected}");
        }
    }

    #[test]
    fn leaves_out_roots_beyond_the_interval() {
        let c = [-1.0, 0.0, 1.0, 0.0, 0.0];
        let roots = quartic_roots(&c, 0.0, 2.0);
        assert!(matches!(roots.as_slice(), [root] if (root - 1.0).abs() < 1e-14));
        assert!(quartic_roots(&c, -0.5, 0.5).as_slice().is_empty());
    }
}

//! Random numbers of one location: the same seed gives the same numbers.

use rand_pcg::Pcg64;
use rand_pcg::rand_core::Rng;

/// The stream of the generator: any constant will do.
const STREAM: u128 = 0x6c6f_6361_7469_6f6e;

/// A source of random numbers.
#[derive(Clone, Debug)]
pub(super) struct Draw(Pcg64);

impl Draw {
    /// A source with a seed.
    pub(super) fn new(seed: u64) -> Self {
        Self(Pcg64::new(u128::from(seed), STREAM))
    }

    /// A number in 0..1.
    pub(super) fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// The indices of the positive weights in random order, as if drawn one after another, without
    /// replacement, with a probability proportional to the weight (Efraimidis and Spirakis, 2006).
    pub(super) fn order(&mut self, weights: impl Iterator<Item = f64>) -> Vec<usize> {
        let mut keys: Vec<(f64, usize)> = weights
            .enumerate()
            .filter(|(_, weight)| *weight > 0.0)
            .map(|(i, weight)| (-libm::log(1.0 - self.unit()) / weight, i))
            .collect();
        keys.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        keys.into_iter().map(|(_, i)| i).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heavier_things_come_first_more_often() {
        let mut draw = Draw::new(1);
        let weights = [1.0, 0.0, 3.0];
        let mut first = [0; 3];
        for _ in 0..4000 {
            let order = draw.order(weights.into_iter());
            assert_eq!(order.len(), 2);
            first[order[0]] += 1;
        }
        assert!((2900..3100).contains(&first[2]), "{first:?}");
    }
}

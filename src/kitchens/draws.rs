//! The numbers of a kitchen, each by its name: a parameter that is drawn otherwise changes no other.

use sweep::Draws;

/// The numbers of one attempt to make a kitchen.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Numbers {
    seed: u64,
    attempt: u64,
}

impl Numbers {
    /// Those of an attempt for a seed.
    pub(crate) fn new(seed: u64, attempt: u64) -> Self {
        Self { seed, attempt }
    }

    /// A number from 0 to 1.
    pub(crate) fn unit(&self, name: &str) -> f64 {
        Draws::new(self.seed, self.attempt, name).unit()
    }

    /// A number between two others, to the millimetre.
    pub(crate) fn between(&self, name: &str, low: f64, high: f64) -> f64 {
        rounded(low + (high - low) * self.unit(name))
    }

    /// One of some values, each as likely as its weight says.
    pub(crate) fn choice<T: Copy>(&self, name: &str, options: &[(f64, T)]) -> Option<T> {
        let all: f64 = options.iter().map(|(weight, _)| weight).sum();
        let mut left = self.unit(name) * all;
        for (weight, value) in options {
            left -= weight;
            if left < 0.0 {
                return Some(*value);
            }
        }
        options.last().map(|(_, value)| *value)
    }

    /// True with a probability.
    pub(crate) fn flag(&self, name: &str, probability: f64) -> bool {
        self.unit(name) < probability
    }

    /// A whole number below another one.
    pub(crate) fn below(&self, name: &str, count: usize) -> usize {
        // The cast rounds down.
        ((self.unit(name) * count as f64) as usize).min(count.saturating_sub(1))
    }
}

/// A length to the millimetre.
pub(crate) fn rounded(length: f64) -> f64 {
    (length * 1e3).round() / 1e3
}

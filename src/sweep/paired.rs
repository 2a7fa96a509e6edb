//! Two plans in the same worlds: which one is better?

use std::fmt::{self, Display};

use super::beta::incomplete_beta;
use super::plural::plural;
use super::rate::{Interval, wilson};
use super::record::Record;

/// How two plans did in the same worlds.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Names of the two plans.
    names: [String; 2],
    /// Worlds that both could try.
    count: usize,
    /// Worlds in which both worked.
    both: usize,
    /// Worlds in which only one of them worked.
    only: [Vec<u64>; 2],
}

/// Whether looks at two plans have decided which one is better.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Decision {
    /// No look has.
    Open,
    /// The last one has.
    At {
        /// The error that this look was allowed.
        error: f64,
    },
}

/// Confidence of the interval of the difference.
const CONFIDENCE: f64 = 0.95;
/// Maximum number of worlds that are listed.
const MAX_WORLDS: usize = 20;

impl Comparison {
    /// Compares records of the same worlds. Worlds that one of the two could not try do not count.
    pub fn new(names: [String; 2], first: &[Record], second: &[Record]) -> Self {
        let mut comparison = Self {
            names,
            count: 0,
            both: 0,
            only: [Vec::new(), Vec::new()],
        };
        for (a, b) in first.iter().zip(second) {
            if !a.outcome.counts() || !b.outcome.counts() {
                continue;
            }
            comparison.count += 1;
            match (a.is_success(), b.is_success()) {
                (true, true) => comparison.both += 1,
                (true, false) => comparison.only[0].push(a.world),
                (false, true) => comparison.only[1].push(a.world),
                (false, false) => {}
            }
        }
        comparison
    }

    fn discordant(&self) -> [usize; 2] {
        [self.only[0].len(), self.only[1].len()]
    }

    /// The probability that plans that are equally good differ so much: McNemar's test (1947), exact
    /// and two-sided.
    pub fn p_value(&self) -> f64 {
        mcnemar(self.discordant())
    }

    /// The interval of the difference of the rates, the second plan's less the first one's: Newcombe's
    /// method 10 (1998).
    pub fn difference(&self) -> Interval {
        let [a, b] = self.discordant();
        let neither = self.count - self.both - a - b;
        newcombe([self.both, b, a, neither], CONFIDENCE)
    }

    /// What the looks say about which plan is better, in words.
    pub fn verdict(&self, decision: Decision) -> String {
        let [a, b] = &self.names;
        let [only_a, only_b] = self.discordant();
        let better = if only_b > only_a { b } else { a };
        let worlds = plural(self.count, "world");
        match decision {
            Decision::At { error } => {
                format!(
                    "decided after {worlds}: {better} is better (p < {error:.4}, the error that this look may have)"
                )
            }
            Decision::Open => format!("not decided after {worlds}"),
        }
    }
}

/// The two-sided p of a fair coin that has fallen on its sides so often.
fn mcnemar([a, b]: [usize; 2]) -> f64 {
    let (few, all) = (a.min(b), a + b);
    if all == 0 {
        return 1.0;
    }
    // P(X ≤ few) = I_½(all − few, few + 1).
    let tail = incomplete_beta(0.5, (all - few) as f64, few as f64 + 1.0);
    (2.0 * tail).min(1.0)
}

/// The interval of p₁ − p₂ for paired rates: both, only the first, only the second, neither.
fn newcombe([both, first, second, neither]: [usize; 4], confidence: f64) -> Interval {
    let count = both + first + second + neither;
    if count == 0 {
        return [-1.0, 1.0];
    }
    let n = count as f64;
    let [e, f, g, h] = [both, first, second, neither].map(|x| x as f64);
    let [p1, p2] = [(e + f) / n, (e + g) / n];
    let [l1, u1] = wilson(both + first, count, confidence);
    let [l2, u2] = wilson(both + second, count, confidence);
    let product = (e + f) * (g + h) * (e + g) * (f + h);
    let phi = if product == 0.0 {
        0.0
    } else {
        let cross = e * h - f * g;
        let corrected = if cross > n / 2.0 {
            cross - n / 2.0
        } else {
            cross.min(0.0)
        };
        corrected / product.sqrt()
    };
    let width = |d1: f64, d2: f64| (d1 * d1 - 2.0 * phi * d1 * d2 + d2 * d2).max(0.0).sqrt();
    [
        p1 - p2 - width(p1 - l1, u2 - p2),
        p1 - p2 + width(u1 - p1, p2 - l2),
    ]
}

/// The error that a look after so many worlds may have, if there are looks at 200, 400, 800 … worlds and
/// all of them together may err with a probability; `None` if there is no look.
pub fn error_at_look(count: u64, error: f64) -> Option<f64> {
    const FIRST: u64 = 200;
    if count == 0 || !count.is_multiple_of(FIRST) || !(count / FIRST).is_power_of_two() {
        return None;
    }
    let look = f64::from((count / FIRST).trailing_zeros() + 1);
    // The sum of 1/k² is π²/6.
    let share = 6.0 / (std::f64::consts::PI * std::f64::consts::PI * look * look);
    Some(error * share)
}

/// Whether one of two plans is better, after a look with that error at the worlds in which only the
/// first, and only the second one worked.
pub fn is_decided(only: [usize; 2], error: f64) -> bool {
    mcnemar(only) < error
}

/// Whether the interval of a rate is as narrow as wanted after a look with that error.
pub fn is_narrow(hits: usize, count: usize, error: f64, width: f64) -> bool {
    let [low, high] = wilson(hits, count, 1.0 - error);
    high - low <= width
}

impl Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let [a, b] = &self.names;
        let [only_a, only_b] = self.discordant();
        let rate = |only: usize| 100.0 * (self.both + only) as f64 / (self.count as f64).max(1.0);
        writeln!(
            f,
            "{} in both: {a} {:.1} %, {b} {:.1} %",
            plural(self.count, "world"),
            rate(only_a),
            rate(only_b)
        )?;
        let [low, high] = self.difference().map(|d| 100.0 * d);
        writeln!(
            f,
            "{a} only {only_a}, {b} only {only_b}, p = {}; difference {:+.1} points [{low:+.1}, {high:+.1}]",
            p_text(self.p_value()),
            rate(only_b) - rate(only_a)
        )?;
        if only_a > 0 {
            let mut worlds: Vec<String> = self.only[0]
                .iter()
                .take(MAX_WORLDS)
                .map(u64::to_string)
                .collect();
            if only_a > MAX_WORLDS {
                worlds.push("…".to_owned());
            }
            writeln!(f, "worse with {b}: --replay {}", worlds.join(" "))?;
        }
        Ok(())
    }
}

/// A probability with two digits that mean something.
fn p_text(p: f64) -> String {
    if p < 1e-6 {
        return format!("{p:.0e}");
    }
    let digits = (1.0 - libm::log10(p)).ceil().clamp(2.0, 8.0) as usize;
    format!("{p:.digits$}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Ending;
    use crate::draw::Draws;

    #[test]
    fn mcnemar_is_that_of_a_table() {
        // Binomial sums, worked out exactly.
        assert_eq!(mcnemar([0, 0]), 1.0);
        assert!((mcnemar([0, 5]) - 0.0625).abs() < 1e-12);
        assert!((mcnemar([1, 9]) - 22.0 / 1024.0).abs() < 1e-12);
        assert!(
            (mcnemar([12, 41]) - 8.165_6e-5).abs() < 2e-6,
            "{}",
            mcnemar([12, 41])
        );
        assert_eq!(mcnemar([7, 7]), 1.0);
    }

    /// An example of Newcombe (1998), table II, method 10; and how often such intervals are right.
    #[test]
    fn differences_are_those_of_newcombe() {
        let close = |cells, [low, high]: Interval| {
            let [l, h] = newcombe(cells, 0.95);
            assert!(
                (l - low).abs() < 2e-4 && (h - high).abs() < 2e-4,
                "{cells:?}: {l} {h}"
            );
        };
        close([36, 12, 2, 0], [0.056_9, 0.340_4]);
        let mut draws = Draws::new(5, 0, "differences");
        let (mut covered, count) = (0, 4_000);
        for _ in 0..count {
            let mut cells = [0; 4];
            for _ in 0..150 {
                let unit = draws.unit();
                cells[[0.5, 0.75, 0.85]
                    .iter()
                    .filter(|bound| unit >= **bound)
                    .count()] += 1;
            }
            let [low, high] = newcombe(cells, 0.95);
            covered += i32::from((low..=high).contains(&0.15));
        }
        let share = f64::from(covered) / f64::from(count);
        assert!((share - 0.95).abs() < 0.015, "{share}");
    }

    #[test]
    fn looking_often_errs_as_seldom_as_it_says() {
        let looks: Vec<u64> = (1..=6400)
            .filter(|n| error_at_look(*n, 0.05).is_some())
            .collect();
        assert_eq!(looks, [200, 400, 800, 1600, 3200, 6400]);
        // Plans that are equally good: how often is one of them called better?
        let mut draws = Draws::new(3, 0, "looks");
        let (mut wrong, count) = (0, 2_000);
        for _ in 0..count {
            let mut only = [0_usize; 2];
            let mut decided = false;
            for world in 1..=3200 {
                if draws.unit() < 0.2 {
                    only[usize::from(draws.unit() < 0.5)] += 1;
                }
                if let Some(error) = error_at_look(world, 0.05) {
                    decided |= is_decided(only, error);
                }
            }
            wrong += i32::from(decided);
        }
        assert!(
            f64::from(wrong) / f64::from(count) <= 0.05,
            "{wrong} of {count}"
        );
    }

    #[test]
    fn worlds_that_got_worse_are_listed() {
        let records = |failed: &[u64]| -> Vec<Record> {
            let ending = |world| match failed.contains(&world) {
                true => Ending::Failure,
                false => Ending::Success,
            };
            (0..20)
                .map(|world| Record::new(world, ending(world)))
                .collect()
        };
        let names = ["old".to_owned(), "new".to_owned()];
        let comparison = Comparison::new(names, &records(&[1, 2, 3, 4, 5, 6]), &records(&[6, 9]));
        let text = comparison.to_string();
        assert!(
            text.starts_with(
                "20 worlds in both: old 70.0 %, new 90.0 %\nold only 1, new only 5, p = 0.22; "
            ),
            "{text}"
        );
        assert!(text.ends_with("worse with new: --replay 9\n"), "{text}");
    }
}

//! Divisions of worlds in two, by the value of a draw: which one tells failures best from successes?

use super::feature::{Feature, Level};

/// Maximum number of values of a number that are looked at one by one.
const FEW: usize = 10;

/// A question about the value of a draw.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Test {
    Below(f64),
    AtLeast(f64),
    Is(Level),
}

/// How many worlds fail, and how many there are.
pub(super) type Count = [usize; 2];

/// The share of worlds that fail.
pub(super) fn rate([failed, all]: Count) -> f64 {
    failed as f64 / all.max(1) as f64
}

/// The divisions of some worlds by one draw. The values are sorted into bins; a division is about some
/// that follow each other.
pub(super) struct Divisions {
    /// The bin of each world.
    bins: Vec<usize>,
    count: usize,
    /// Tests, and the bins of the worlds in which they hold, as first and behind the last.
    tests: Vec<(Test, [usize; 2])>,
}

/// A division of some worlds.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Division {
    pub(super) test: Test,
    /// Whether the test holds in the worse part.
    pub(super) holds: bool,
    /// The worse part, where failures are more frequent.
    pub(super) worse: Count,
    pub(super) better: Count,
    /// Its gain in deviance.
    pub(super) gain: f64,
}

impl Divisions {
    /// The divisions of the worlds with those indices, at no more than so many bounds.
    pub(super) fn new(feature: &Feature, members: &[usize], most_bounds: usize) -> Self {
        let values = || members.iter().filter_map(|at| feature.values.get(*at));
        let mut numbers: Vec<f64> = values().filter_map(Level::number).collect();
        numbers.sort_by(f64::total_cmp);
        let mut different = numbers.clone();
        different.dedup();
        let bounds = bounds(&numbers, &different, most_bounds);
        let mut texts: Vec<&String> = Vec::new();
        for value in values() {
            if let Level::Text(text) = value {
                texts.push(text);
            }
        }
        texts.sort();
        texts.dedup();
        // Numbers come first, then texts, then what is absent.
        let first_text = if different.is_empty() {
            0
        } else {
            bounds.len() + 1
        };
        let absent = first_text + texts.len();
        let bin = |value: &Level| match value {
            Level::Number(number) => bounds.partition_point(|bound| bound <= number),
            Level::Text(text) => first_text + texts.partition_point(|known| *known < text),
            Level::Absent => absent,
        };
        let bins: Vec<usize> = values().map(bin).collect();
        let mut tests = Vec::new();
        for (at, bound) in bounds.iter().enumerate() {
            tests.push((Test::Below(*bound), [0, at + 1]));
            tests.push((Test::AtLeast(*bound), [at + 1, first_text]));
        }
        if different.len() <= FEW && bounds.len() + 1 == different.len() {
            for (at, number) in different.iter().enumerate() {
                tests.push((Test::Is(Level::Number(*number)), [at, at + 1]));
            }
        }
        for (at, text) in texts.into_iter().enumerate() {
            let bin = first_text + at;
            tests.push((Test::Is(Level::Text(text.clone())), [bin, bin + 1]));
        }
        Self {
            bins,
            count: absent + 1,
            tests,
        }
    }

    /// The division that tells failures best from successes, of those with so many worlds in the worse
    /// part, and in the better one. If `must_hold`, its test holds in the worse part.
    pub(super) fn best(
        &self,
        fails: &[bool],
        least: [usize; 2],
        must_hold: bool,
    ) -> Option<Division> {
        // How many fail, and how many there are, in all bins before each.
        let mut before = vec![[0, 0]; self.count + 1];
        for (bin, fails) in self.bins.iter().zip(fails) {
            before[bin + 1][0] += usize::from(*fails);
            before[bin + 1][1] += 1;
        }
        for at in 1..before.len() {
            for i in [0, 1] {
                before[at][i] += before[at - 1][i];
            }
        }
        let all = before[self.count];
        let mut best: Option<Division> = None;
        for (test, [first, end]) in &self.tests {
            let part = [0, 1].map(|i| before[*end][i] - before[*first][i]);
            let rest = [0, 1].map(|i| all[i] - part[i]);
            let holds = rate(part) > rate(rest);
            let [worse, better] = if holds { [part, rest] } else { [rest, part] };
            let is_small = worse[1] < least[0] || better[1] < least[1];
            if is_small || rate(worse) <= rate(better) || (must_hold && !holds) {
                continue;
            }
            let gain = deviance(&[worse, better]);
            // What is so is easier to understand than what is not so.
            let is_better = |best: &Division| (gain, holds) >= (best.gain, best.holds);
            if best.as_ref().is_none_or(is_better) {
                best = Some(Division {
                    test: test.clone(),
                    holds,
                    worse,
                    better,
                    gain,
                });
            }
        }
        best
    }
}

/// Numbers between different values, no more than so many, about as many values between any two.
fn bounds(numbers: &[f64], different: &[f64], most: usize) -> Vec<f64> {
    if different.len() <= most + 1 {
        return different
            .windows(2)
            .map(|pair| short_between(pair[0], pair[1]))
            .collect();
    }
    let mut bounds = Vec::new();
    for part in 1..=most {
        let at = numbers[part * numbers.len() / (most + 1)];
        let place = different.partition_point(|number| *number < at);
        if let Some(low) = place.checked_sub(1) {
            bounds.push(short_between(different[low], different[place]));
        }
    }
    bounds.dedup();
    bounds
}

impl Test {
    /// Whether it holds for a value.
    pub(super) fn holds(&self, value: &Level) -> bool {
        match self {
            Self::Below(bound) => value.number().is_some_and(|number| number < *bound),
            Self::AtLeast(bound) => value.number().is_some_and(|number| number >= *bound),
            Self::Is(wanted) => value == wanted,
        }
    }

    /// That it holds, or does not hold, for a draw.
    pub(super) fn words(&self, feature: &Feature, holds: bool) -> String {
        let name = &feature.name;
        let always = feature.is_number();
        match (self, holds) {
            (Self::Below(bound), true) => format!("{name} < {bound}"),
            (Self::Below(bound), false) if always => format!("{name} ≥ {bound}"),
            (Self::Below(bound), false) => format!("not {name} < {bound}"),
            (Self::AtLeast(bound), true) => format!("{name} ≥ {bound}"),
            (Self::AtLeast(bound), false) if always => format!("{name} < {bound}"),
            (Self::AtLeast(bound), false) => format!("not {name} ≥ {bound}"),
            (Self::Is(Level::Number(number)), true) => format!("{name} = {number}"),
            (Self::Is(Level::Number(number)), false) => format!("{name} ≠ {number}"),
            (Self::Is(Level::Text(text)), _) => match (text.as_str(), holds) {
                ("true", true) | ("false", false) => name.clone(),
                ("true", false) | ("false", true) => format!("not {name}"),
                (_, true) => format!("{name} = {}", text.to_lowercase()),
                (_, false) => format!("{name} ≠ {}", text.to_lowercase()),
            },
            (Self::Is(Level::Absent), true) => format!("no {name}"),
            (Self::Is(Level::Absent), false) => name.clone(),
        }
    }
}

/// Twice the gain in log-likelihood of one rate for each bin, [failed, all], over one for all.
pub(super) fn deviance(bins: &[[usize; 2]]) -> f64 {
    let term = |failed: usize, all: usize| {
        let part = |hits: usize| match hits {
            0 => 0.0,
            _ => hits as f64 * libm::log(hits as f64 / all as f64),
        };
        part(failed) + part(all - failed)
    };
    let sum = |i: usize| bins.iter().map(|bin| bin[i]).sum::<usize>();
    let each: f64 = bins
        .iter()
        .filter(|b| b[1] > 0)
        .map(|b| term(b[0], b[1]))
        .sum();
    2.0 * (each - term(sum(0), sum(1)))
}

/// A number between two others, the second included, with as few digits as possible.
fn short_between(low: f64, high: f64) -> f64 {
    for digits in 0..12 {
        let scale = libm::pow(10.0, f64::from(digits));
        let rounded = (high * scale).floor() / scale;
        if rounded > low {
            return rounded;
        }
    }
    high
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bound_is_not_stated_of_worlds_without_the_number() {
        // Worlds without the number fail most.
        let values = [Some(0.1), Some(0.4), Some(0.6), None, None, None];
        let feature = Feature {
            name: "x".to_owned(),
            values: values
                .iter()
                .map(|value| value.map_or(Level::Absent, Level::Number))
                .collect(),
        };
        let fails = [false, false, true, true, true, true];
        let divisions = Divisions::new(&feature, &[0, 1, 2, 3, 4, 5], 10);
        let words = |must_hold| {
            let division = divisions.best(&fails, [1, 1], must_hold).unwrap();
            (
                division.test.words(&feature, division.holds),
                division.worse,
                division.better,
            )
        };
        assert_eq!(words(false), ("not x < 0.6".to_owned(), [4, 4], [0, 2]));
        assert_eq!(words(true), ("x = 0.6".to_owned(), [1, 1], [3, 5]));
    }
}

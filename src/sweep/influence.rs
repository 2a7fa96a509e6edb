//! Which draws explain failures?
//!
//! The values of a draw are divided into bins. The deviance between the rates of the bins and the
//! overall rate is compared with what it is after the outcomes have been shuffled. Many draws are
//! looked at, so the probabilities are corrected by Holm's method (1979).

use std::collections::BTreeMap;
use std::fmt::{self, Display};

use super::division::{Count, Division, Divisions, deviance, rate};
use super::draw::Draws;
use super::feature::{Feature, Level, features};
use super::record::Record;
use super::tree::Tree;

/// Maximum number of bins of a number.
const BINS: usize = 10;
/// How often the outcomes are shuffled.
const SHUFFLES: usize = 999;
/// Corrected probability below which a draw has an effect.
pub const SIGNIFICANT: f64 = 0.05;
/// Minimum share of the worlds on either side of a bound.
const MIN_SHARE: f64 = 0.05;
/// Fewest failures, and fewest successes, about which anything can be said.
const FEWEST: usize = 5;
/// Maximum number of draws that are named as having no effect.
const MAX_NAMED: usize = 6;

/// What a draw has to do with failures.
#[derive(Clone, Debug, PartialEq)]
pub struct Effect {
    /// The path of the draw.
    pub name: String,
    /// The corrected probability that this is chance.
    pub p: f64,
    /// Where failures are most frequent.
    pub worst: Option<Part>,
}

/// A part of all worlds, and how many of them fail.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// What is so in them.
    pub condition: String,
    /// How many of them fail, and how many there are.
    failed: Count,
    /// The same of all others.
    others: Count,
}

/// Which draws explain failures, the most likely cause first.
pub struct Influence {
    effects: Vec<Effect>,
    /// Parts that several draws together tell apart.
    tree: Option<Tree>,
    tried: usize,
    failed: usize,
}

impl Influence {
    /// Looks at all draws of the records.
    pub fn of(records: &[Record]) -> Self {
        let tried: Vec<&Record> = records.iter().filter(|r| r.outcome.counts()).collect();
        let fails: Vec<bool> = tried.iter().map(|r| !r.is_success()).collect();
        let failed = fails.iter().filter(|fails| **fails).count();
        let (mut effects, mut tree) = (Vec::new(), None);
        if failed >= FEWEST && tried.len() - failed >= FEWEST {
            let features = features(&tried);
            let chances = shuffled(&features, &fails);
            for (feature, p) in features.iter().zip(holm(&chances)) {
                effects.push(Effect {
                    name: feature.name.clone(),
                    p,
                    worst: worst_part(feature, &fails),
                });
            }
            tree = Tree::of(&features, &fails);
            // Equal probabilities: the larger difference first.
            effects.sort_by(|a, b| a.p.total_cmp(&b.p).then(gain(b).total_cmp(&gain(a))));
        }
        Self {
            effects,
            tree,
            tried: tried.len(),
            failed,
        }
    }

    /// The draws that have an effect.
    pub fn significant(&self) -> impl Iterator<Item = &Effect> {
        self.effects.iter().filter(|effect| effect.p < SIGNIFICANT)
    }
}

/// The gain in deviance of the worst part.
fn gain(effect: &Effect) -> f64 {
    effect
        .worst
        .as_ref()
        .map_or(0.0, |part| deviance(&[part.failed, part.others]))
}

/// The bin of each world.
fn bins(values: &[Level]) -> Vec<usize> {
    let mut numbers: Vec<f64> = values.iter().filter_map(Level::number).collect();
    numbers.sort_by(f64::total_cmp);
    let mut different = numbers.clone();
    different.dedup();
    let bounds: Vec<f64> = if different.len() <= BINS {
        different
    } else {
        (1..=BINS)
            .filter_map(|bin| {
                numbers
                    .get((bin * numbers.len() / BINS).max(1) - 1)
                    .copied()
            })
            .collect()
    };
    let mut texts: BTreeMap<&str, usize> = BTreeMap::new();
    for value in values {
        if let Level::Text(text) = value {
            texts.insert(text, 0);
        }
    }
    for (at, place) in texts.values_mut().enumerate() {
        *place = BINS + 1 + at;
    }
    let bin = |value: &Level| match value {
        Level::Number(number) => bounds.partition_point(|bound| bound < number),
        Level::Text(text) => texts.get(text.as_str()).copied().unwrap_or(0),
        Level::Absent => BINS + 1 + texts.len(),
    };
    values.iter().map(bin).collect()
}

fn counts(bins: &[usize], fails: &[bool]) -> Vec<[usize; 2]> {
    let most = bins.iter().max().map_or(0, |bin| bin + 1);
    let mut counts = vec![[0, 0]; most];
    for (bin, fails) in bins.iter().zip(fails) {
        counts[*bin][0] += usize::from(*fails);
        counts[*bin][1] += 1;
    }
    counts
}

/// What a division of worlds into groups explains of their failures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Explained {
    /// The probability that this is chance, corrected for the number of divisions; `None` where there are too
    /// few failures, or successes, to say.
    pub p: Option<f64>,
    /// The gain in deviance over one rate for all.
    pub deviance: f64,
}

/// What each of several divisions explains: the group of each world, and whether it fails.
pub fn explained(divisions: &[Vec<usize>], fails: &[bool]) -> Vec<Explained> {
    let failed = fails.iter().filter(|fails| **fails).count();
    let is_known = failed >= FEWEST && fails.len() - failed >= FEWEST;
    let chances = match is_known {
        true => holm(&shuffled_bins(divisions, fails)),
        false => Vec::new(),
    };
    let divisions = divisions.iter().enumerate();
    divisions
        .map(|(at, groups)| Explained {
            p: chances.get(at).copied(),
            deviance: deviance(&counts(groups, fails)),
        })
        .collect()
}

/// The probability, for each feature, that shuffled outcomes give as large a deviance.
fn shuffled(features: &[Feature], fails: &[bool]) -> Vec<f64> {
    let bins: Vec<Vec<usize>> = features.iter().map(|f| bins(&f.values)).collect();
    shuffled_bins(&bins, fails)
}

/// The same for the bins of features.
fn shuffled_bins(bins: &[Vec<usize>], fails: &[bool]) -> Vec<f64> {
    let found: Vec<f64> = bins.iter().map(|b| deviance(&counts(b, fails))).collect();
    let mut as_large = vec![0_usize; bins.len()];
    let mut numbers = Draws::new(0, 0, "influence");
    let mut shuffled = fails.to_vec();
    for _ in 0..SHUFFLES {
        numbers.shuffle(&mut shuffled);
        for ((bins, found), as_large) in bins.iter().zip(&found).zip(&mut as_large) {
            *as_large += usize::from(deviance(&counts(bins, &shuffled)) >= found - 1e-9);
        }
    }
    let chance = |count: usize| (count + 1) as f64 / (SHUFFLES + 1) as f64;
    as_large.into_iter().map(chance).collect()
}

/// Probabilities of several tests, corrected so that all of them together err as seldom as each says.
fn holm(chances: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..chances.len()).collect();
    order.sort_by(|a, b| chances[*a].total_cmp(&chances[*b]));
    let mut corrected = vec![1.0; chances.len()];
    let mut least: f64 = 0.0;
    for (rank, at) in order.iter().enumerate() {
        least = least.max(chances[*at] * (chances.len() - rank) as f64);
        corrected[*at] = least.min(1.0);
    }
    corrected
}

/// The part, beyond a bound or with one value, that tells failures best from successes.
fn worst_part(feature: &Feature, fails: &[bool]) -> Option<Part> {
    let all: Vec<usize> = (0..fails.len()).collect();
    let least = (MIN_SHARE * fails.len() as f64).ceil() as usize;
    let Division {
        test,
        holds,
        worse,
        better,
        ..
    } = Divisions::new(feature, &all, fails.len()).best(fails, [least, 0], true)?;
    Some(Part {
        condition: test.words(feature, holds),
        failed: worse,
        others: better,
    })
}

impl Display for Influence {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        if self.effects.is_empty() {
            return Ok(());
        }
        let mut sentences = Vec::new();
        for effect in self.significant() {
            let Some(part) = &effect.worst else {
                sentences.push(format!("{}: p = {:.3}", effect.name, effect.p));
                continue;
            };
            let percent = |count: Count| 100.0 * rate(count);
            sentences.push(format!(
                "{}: {:.0} % fail of {} (else {:.0} %)",
                part.condition,
                percent(part.failed),
                part.failed[1],
                percent(part.others)
            ));
        }
        let without: Vec<&str> = self
            .effects
            .iter()
            .filter(|effect| effect.p >= SIGNIFICANT)
            .map(|effect| effect.name.as_str())
            .collect();
        if sentences.is_empty() {
            let (failed, tried) = (self.failed, self.tried);
            sentences.push(format!(
                "no draw explains the {failed} failures of {tried} worlds"
            ));
        } else if !without.is_empty() {
            let more = if without.len() > MAX_NAMED {
                ", …"
            } else {
                ""
            };
            let named: Vec<&str> = without.into_iter().take(MAX_NAMED).collect();
            sentences.push(format!("{}{more}: no effect seen", named.join(", ")));
        }
        writeln!(f, "what matters: {}", sentences.join(" · "))?;
        self.tree.iter().try_for_each(|tree| write!(f, "{tree}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Drawn, Ending};

    /// Worlds with ten numbers, which fail with a probability that the numbers decide.
    fn worlds(seed: u64, rate: impl Fn(&[f64]) -> f64) -> Vec<Record> {
        let world = |world| {
            let mut draws = Draws::new(seed, world, "test");
            let values: Vec<f64> = (0..10).map(|_| draws.unit()).collect();
            let ending = match draws.unit() < rate(&values) {
                true => Ending::Failure,
                false => Ending::Success,
            };
            let mut record = Record::new(world, ending);
            for (i, value) in values.iter().enumerate() {
                record.draws.set(&format!("v{i}"), Drawn::Number(*value));
            }
            record
        };
        (0..400).map(world).collect()
    }

    #[test]
    fn a_planted_cause_is_found() {
        let records = worlds(1, |v| if v[3] < 0.25 { 0.6 } else { 0.05 });
        let influence = Influence::of(&records);
        let first = influence.significant().next().map(|e| e.name.as_str());
        assert_eq!(first, Some("v3"));
        let text = influence.to_string();
        assert!(text.starts_with("what matters: v3 < 0.2"), "{text}");
        assert!(text.contains("no effect seen"), "{text}");
        // Failures at both ends, which no line through the values would show.
        let records = worlds(2, |v| {
            if (0.2..0.8).contains(&v[7]) {
                0.05
            } else {
                0.6
            }
        });
        let influence = Influence::of(&records);
        let first = influence.significant().next().map(|e| e.name.as_str());
        assert_eq!(first, Some("v7"));
    }

    #[test]
    fn where_nothing_matters_little_is_found() {
        let found = (0..40).filter(|seed| {
            let records = worlds(100 + seed, |_| 0.3);
            Influence::of(&records).significant().next().is_some()
        });
        // Two are expected; six or more happen in one of 60 such tests.
        let found = found.count();
        assert!(found < 6, "{found}");
    }

    #[test]
    fn kinds_of_things_in_groups_count() {
        let world = |world: u64| {
            let mut draws = Draws::new(9, world, "test");
            let kind = if draws.unit() < 0.4 { "BOWL" } else { "CUP" };
            let fails = kind == "BOWL" && draws.unit() < 0.8;
            let mut record = Record::new(
                world,
                if fails {
                    Ending::Failure
                } else {
                    Ending::Success
                },
            );
            record.draws.set("clutter", Drawn::Integer(1));
            record.draws.set("clutter.1", Drawn::Text(kind.to_owned()));
            record.draws.set("clutter.1.x", Drawn::Number(draws.unit()));
            record
        };
        let records: Vec<Record> = (0..200).map(world).collect();
        let text = Influence::of(&records).to_string();
        assert!(text.contains("clutter has bowl: "), "{text}");
    }
}

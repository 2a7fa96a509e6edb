//! A tree of divisions: which draws, together, tell failures from successes?
//!
//! Each division is the best one of its worlds. It stays only if no shuffle of their outcomes gives a
//! division as good as it: what is looked for among many draws is found by chance, too.

use std::fmt::{self, Display};

use super::division::{Count, Division, Divisions, Test, rate};
use super::draw::Draws;
use super::feature::Feature;

/// Maximum number of divisions above a leaf.
const DEPTH: usize = 3;
/// Minimum share of the worlds in a leaf.
const MIN_SHARE: f64 = 0.05;
/// Maximum number of bounds of a number that are tried.
const BOUNDS: usize = 40;
/// How often the outcomes are shuffled.
const SHUFFLES: usize = 199;

/// What is so, of one draw: its place in the list of all, a test, and whether that holds.
type Condition = (usize, Test, bool);

/// The leaves of a tree that has at least two divisions, the worst first.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tree {
    /// What is so in them, and how many fail.
    leaves: Vec<(String, Count)>,
}

/// A tree that grows.
struct Growing<'a> {
    features: &'a [Feature],
    fails: &'a [bool],
    /// Fewest worlds in a leaf.
    least: usize,
    numbers: Draws,
    leaves: Vec<(Vec<Condition>, Count)>,
}

impl Tree {
    /// The tree of all worlds; `None` unless it says more than one draw by itself does.
    pub(super) fn of(features: &[Feature], fails: &[bool]) -> Option<Self> {
        let mut growing = Growing {
            features,
            fails,
            least: (MIN_SHARE * fails.len() as f64).ceil() as usize,
            numbers: Draws::new(0, 0, "tree"),
            leaves: Vec::new(),
        };
        growing.grow(&(0..fails.len()).collect::<Vec<_>>(), &mut Vec::new());
        let mut leaves = growing.leaves;
        if leaves.len() < 3 {
            return None;
        }
        leaves.sort_by(|(_, a), (_, b)| rate(*b).total_cmp(&rate(*a)));
        let words = |conditions: Vec<Condition>| {
            let conditions = simplified(features, &conditions).into_iter();
            let words = conditions.map(|(at, test, holds)| test.words(&features[*at], *holds));
            words.collect::<Vec<String>>().join(" and ")
        };
        let leaves = leaves.into_iter().map(|(on, count)| (words(on), count));
        Some(Self {
            leaves: leaves.collect(),
        })
    }
}

impl Growing<'_> {
    /// Divides the worlds with those indices, in which the conditions hold, as long as that says
    /// something.
    fn grow(&mut self, members: &[usize], conditions: &mut Vec<Condition>) {
        let division = match conditions.len() < DEPTH {
            true => self.division(members),
            false => None,
        };
        let Some((at, division)) = division else {
            let failed = members.iter().filter(|world| self.fails[**world]).count();
            self.leaves
                .push((conditions.clone(), [failed, members.len()]));
            return;
        };
        for holds in [division.holds, !division.holds] {
            let values = &self.features[at].values;
            let has = |world: &&usize| division.test.holds(&values[**world]) == holds;
            let part: Vec<usize> = members.iter().filter(has).copied().collect();
            conditions.push((at, division.test.clone(), holds));
            self.grow(&part, conditions);
            conditions.pop();
        }
    }

    /// The best division of the worlds by any draw, if it is no chance.
    fn division(&mut self, members: &[usize]) -> Option<(usize, Division)> {
        if members.len() < 2 * self.least {
            return None;
        }
        let divisions: Vec<Divisions> = self
            .features
            .iter()
            .map(|feature| Divisions::new(feature, members, BOUNDS))
            .collect();
        let mut fails: Vec<bool> = members.iter().map(|world| self.fails[*world]).collect();
        let found = best(&divisions, &fails, self.least)?;
        for _ in 0..SHUFFLES {
            self.numbers.shuffle(&mut fails);
            let by_chance = best(&divisions, &fails, self.least);
            if by_chance.is_some_and(|(_, division)| division.gain >= found.1.gain) {
                return None;
            }
        }
        Some(found)
    }
}

/// The best division by any draw, and the place of that draw in the list.
fn best(divisions: &[Divisions], fails: &[bool], least: usize) -> Option<(usize, Division)> {
    let mut best: Option<(usize, Division)> = None;
    for (at, divisions) in divisions.iter().enumerate() {
        let Some(division) = divisions.best(fails, [least, least], false) else {
            continue;
        };
        if best.as_ref().is_none_or(|(_, b)| division.gain > b.gain) {
            best = Some((at, division));
        }
    }
    best
}

/// The conditions without those that a later one about the same number makes needless.
fn simplified<'c>(features: &[Feature], conditions: &'c [Condition]) -> Vec<&'c Condition> {
    // Whether it bounds a number from above; nothing if it does not bound a number.
    let is_below = |(at, test, holds): &Condition| match test {
        Test::Below(_) if features[*at].is_number() => Some(*holds),
        Test::AtLeast(_) if features[*at].is_number() => Some(!holds),
        _ => None,
    };
    let mut kept = Vec::new();
    for (place, condition) in conditions.iter().enumerate() {
        let narrows = |later: &Condition| {
            later.0 == condition.0
                && is_below(later).is_some()
                && is_below(later) == is_below(condition)
        };
        if !conditions[place + 1..].iter().any(narrows) {
            kept.push(condition);
        }
    }
    kept
}

impl Display for Tree {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(f, "together:")?;
        for (conditions, count) in &self.leaves {
            let percent = 100.0 * rate(*count);
            writeln!(f, "{percent:>5.0} % fail of {:<5} {conditions}", count[1])?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::feature::Level;

    /// Worlds with ten numbers, the first of which is missing in some, and a kind.
    fn features(seed: u64, count: u64) -> Vec<Feature> {
        let mut features: Vec<Feature> = (0..10)
            .map(|i| {
                let value = |world| Draws::new(seed, world, &format!("v{i}")).unit();
                let level = |world| match value(world) {
                    number if i == 0 && number < 0.2 => Level::Absent,
                    number => Level::Number(number),
                };
                Feature {
                    name: format!("v{i}"),
                    values: (0..count).map(level).collect(),
                }
            })
            .collect();
        let kind = |world| {
            let unit = Draws::new(seed, world, "kind").unit();
            Level::Text(["CUP", "BOWL", "MILK"][(unit * 3.0) as usize].to_owned())
        };
        features.push(Feature {
            name: "kind".to_owned(),
            values: (0..count).map(kind).collect(),
        });
        features
    }

    fn outcomes(seed: u64, features: &[Feature], rate: impl Fn(&[&Level]) -> f64) -> Vec<bool> {
        let worlds = 0..features[0].values.len();
        let fails = |world: usize| {
            let values: Vec<&Level> = features.iter().map(|f| &f.values[world]).collect();
            Draws::new(seed, world as u64, "outcome").unit() < rate(&values)
        };
        worlds.map(fails).collect()
    }

    #[test]
    fn draws_that_matter_only_together_are_found() {
        let features = features(1, 1000);
        let fails = outcomes(1, &features, |values| {
            let is_bowl = *values[10] == Level::Text("BOWL".to_owned());
            match values[3].number() {
                Some(number) if number < 0.3 && is_bowl => 0.9,
                _ => 0.02,
            }
        });
        let text = Tree::of(&features, &fails).unwrap().to_string();
        let worst = text.lines().nth(1).unwrap();
        assert!(
            worst.contains("v3 < 0.") && worst.contains("kind = bowl"),
            "{text}"
        );
        assert!(text.lines().count() <= 1 + 4, "{text}");
    }

    #[test]
    fn what_one_draw_explains_has_no_tree_and_chance_has_none() {
        let one = features(2, 600);
        let fails = outcomes(2, &one, |values| match values[5].number() {
            Some(number) if number < 0.4 => 0.7,
            _ => 0.1,
        });
        assert_eq!(Tree::of(&one, &fails), None);
        let found = (0..20).filter(|seed| {
            let features = features(100 + seed, 300);
            Tree::of(&features, &outcomes(*seed, &features, |_| 0.3)).is_some()
        });
        assert_eq!(found.count(), 0);
    }

    #[test]
    fn leaves_hold_every_world_once() {
        let features = features(3, 800);
        let fails = outcomes(3, &features, |values| {
            let unit = |at: usize| values[at].number().unwrap_or(0.0);
            if (unit(0) < 0.5) == (unit(1) < 0.3) {
                0.8
            } else {
                0.1
            }
        });
        let tree = Tree::of(&features, &fails).unwrap();
        let count = |i: usize| tree.leaves.iter().map(|(_, count)| count[i]).sum::<usize>();
        assert_eq!(count(1), 800);
        assert_eq!(count(0), fails.iter().filter(|fails| **fails).count());
        assert!(tree.leaves.len() <= 8);
        assert!(tree.leaves.iter().all(|(_, count)| count[1] >= 40));
    }
}

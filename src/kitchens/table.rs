//! A table of kitchens: what of them explains the failures of a sweep that draws them.

use std::collections::BTreeSet;
use std::fmt::{self, Display};

use sweep::influence::{Explained, SIGNIFICANT, explained};
use sweep::plural::plural;
use sweep::rate::{Interval, wilson};
use sweep::summary::CONFIDENCE;
use sweep::{Drawn, Record};

use crate::finding::{Finding, findings};
use crate::part::kind_of_part;

/// Bounds (m) of the classes of aisles, of heights of counters and of other surfaces, and of distances.
const AISLES: [f64; 2] = [1.0, 1.2];
const COUNTERS: [f64; 2] = [0.88, 0.92];
const HEIGHTS: [f64; 2] = [0.8, 0.95];
const DISTANCES: [f64; 2] = [1.5, 2.5];
/// Numbers of things about, and of drawers and doors that stand open, from which a class begins.
const THINGS: [f64; 2] = [1.0, 5.0];
const OPEN: [f64; 2] = [1.0, 3.0];
/// Maximum number of findings that are told.
const MAX_FINDINGS: usize = 12;

/// The worlds of a class, and how many of them fail.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The class.
    pub class: String,
    /// How many worlds of it fail.
    pub failed: usize,
    /// How many there are.
    pub tried: usize,
}

impl Row {
    /// The share of its worlds that fail.
    pub fn rate(&self) -> f64 {
        self.failed as f64 / self.tried.max(1) as f64
    }

    /// The interval of that share, for 95 %.
    pub fn interval(&self) -> Interval {
        wilson(self.failed, self.tried, CONFIDENCE)
    }
}

/// A division of all worlds into classes.
#[derive(Clone, Debug, PartialEq)]
pub struct Division {
    /// By what.
    pub name: String,
    /// What it explains.
    pub explained: Explained,
    /// The classes, those first that fail most.
    pub rows: Vec<Row>,
}

impl Division {
    /// Whether it explains failures, as far as can be known.
    pub fn explains(&self) -> bool {
        self.explained.p.is_some_and(|p| p < SIGNIFICANT)
    }

    /// How certain it is, in words.
    pub fn verdict(&self) -> String {
        match self.explained.p {
            None => String::new(),
            Some(p) if p < SIGNIFICANT => format!("explains failures (p = {p:.3})"),
            Some(_) => "no effect seen".to_owned(),
        }
    }
}

/// What the kitchens of a sweep have to do with its failures.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct KitchenTable {
    /// What divides worlds, that first which explains most.
    pub divisions: Vec<Division>,
    /// What fails, those first that occur most.
    pub findings: Vec<Finding>,
    /// The number of worlds in which the plan was tried.
    pub tried: usize,
    /// How many of them fail.
    pub failed: usize,
    /// The number of different kitchens.
    pub kitchens: usize,
    /// How many of them have a world that fails.
    pub failing_kitchens: usize,
}

/// A world in which the plan was tried, in a drawn kitchen.
pub(crate) struct World<'r> {
    pub(crate) record: &'r Record,
    /// The path of the kitchen.
    path: &'r str,
}

impl<'r> World<'r> {
    fn of(record: &'r Record) -> Option<Self> {
        let path = kitchen_path(record)?;
        record.outcome.counts().then_some(Self { record, path })
    }

    /// A fact of its kitchen.
    fn fact(&self, name: &str) -> Option<&'r Drawn> {
        self.record.draws.get(&format!("{}.{name}", self.path))
    }

    fn number(&self, name: &str) -> Option<f64> {
        self.fact(name).and_then(Drawn::number)
    }

    /// Which kitchen it is.
    pub(crate) fn kitchen(&self) -> String {
        let seed = self.record.draws.get(self.path);
        seed.map(Drawn::to_string).unwrap_or_default()
    }

    /// How its furniture is arranged.
    pub(crate) fn layout(&self) -> String {
        let layout = self.fact("arrangement").map(Drawn::to_string);
        layout.unwrap_or_default().to_lowercase()
    }

    /// The classes to which it belongs: by what, and which.
    fn classes(&self) -> Vec<(String, String)> {
        let mut classes = vec![("layout".to_owned(), self.layout())];
        let mut add = |name: &str, class: String| classes.push((name.to_owned(), class));
        let aisle = self.number("aisle");
        add(
            "aisle",
            aisle.map_or_else(|| "none".to_owned(), |aisle| class_of_length(AISLES, aisle)),
        );
        if let Some(height) = self.number("counter-height") {
            add("counter height", class_of_length(COUNTERS, height));
        }
        if let Some(count) = self.number("clutter") {
            add("things about", class_of_count(THINGS, count));
        }
        if let Some(count) = self.number("ajar") {
            add("drawers and doors open", class_of_count(OPEN, count));
        }
        let chair = self.fact("chair").is_some();
        add(
            "chair in the way",
            if chair { "yes" } else { "no" }.to_owned(),
        );
        for (path, drawn) in self.record.draws.iter() {
            let below = |name: &str| {
                let number = self.record.draws.get(&format!("{path}.{name}"));
                number.and_then(Drawn::number)
            };
            let (Drawn::Text(surface), Some(height), Some(distance)) =
                (drawn, below("height"), below("distance"))
            else {
                continue;
            };
            add(path, kind_of_part(surface));
            add(&format!("{path} height"), class_of_length(HEIGHTS, height));
            add(
                &format!("{path} distance"),
                class_of_length(DISTANCES, distance),
            );
        }
        classes
    }
}

/// The path of the kitchen that a world has drawn.
pub fn kitchen_path(record: &Record) -> Option<&str> {
    record.draws.iter().map(|(path, _)| path).find(|path| {
        let has = |fact: &str| record.draws.get(&format!("{path}.{fact}")).is_some();
        has("arrangement") && has("counter-height")
    })
}

fn class_of_length([low, high]: [f64; 2], length: f64) -> String {
    if length < low {
        format!("< {low:.2} m")
    } else if length <= high {
        format!("{low:.2}–{high:.2} m")
    } else {
        format!("> {high:.2} m")
    }
}

fn class_of_count([some, many]: [f64; 2], count: f64) -> String {
    if count < some {
        "none".to_owned()
    } else if count < many {
        format!("{some}–{}", many - 1.0)
    } else {
        format!("≥ {many}")
    }
}

impl KitchenTable {
    /// The table of all worlds that have drawn a kitchen; `None` if there is none.
    pub fn of(records: &[Record]) -> Option<Self> {
        let worlds: Vec<World<'_>> = records.iter().filter_map(World::of).collect();
        if worlds.is_empty() {
            return None;
        }
        let fails: Vec<bool> = worlds.iter().map(|w| !w.record.is_success()).collect();
        let failing = || worlds.iter().zip(&fails).filter(|(_, fails)| **fails);
        let kitchens: BTreeSet<String> = worlds.iter().map(World::kitchen).collect();
        let failing_kitchens: BTreeSet<String> =
            failing().map(|(world, _)| world.kitchen()).collect();
        Some(Self {
            divisions: divisions(&worlds, &fails),
            findings: findings(failing().map(|(world, _)| world)),
            tried: worlds.len(),
            failed: failing().count(),
            kitchens: kitchens.len(),
            failing_kitchens: failing_kitchens.len(),
        })
    }
}

fn divisions(worlds: &[World<'_>], fails: &[bool]) -> Vec<Division> {
    let classes: Vec<Vec<(String, String)>> = worlds.iter().map(World::classes).collect();
    let mut names: Vec<&str> = Vec::new();
    for (name, _) in classes.iter().flatten() {
        if !names.contains(&name.as_str()) {
            names.push(name);
        }
    }
    let class = |of: &[(String, String)], name: &str| {
        let found = of.iter().find(|(known, _)| known == name);
        found.map_or_else(|| "none".to_owned(), |(_, class)| class.clone())
    };
    // The number of each world's class, and the classes.
    let groups = names.into_iter().map(|name| {
        let of_worlds: Vec<String> = classes.iter().map(|of| class(of, name)).collect();
        let different: BTreeSet<&String> = of_worlds.iter().collect();
        let different: Vec<String> = different.into_iter().cloned().collect();
        let at = |class: &String| different.binary_search(class).unwrap_or(0);
        let numbers: Vec<usize> = of_worlds.iter().map(at).collect();
        (name.to_owned(), different, numbers)
    });
    let groups: Vec<_> = groups.filter(|(_, all, _)| all.len() > 1).collect();
    let numbers: Vec<Vec<usize>> = groups.iter().map(|(.., numbers)| numbers.clone()).collect();
    let explained = explained(&numbers, fails);
    let divisions = groups.into_iter().zip(explained);
    let mut divisions: Vec<Division> = divisions
        .map(|((name, classes, numbers), explained)| {
            let mut rows: Vec<Row> = classes
                .into_iter()
                .map(|class| Row {
                    class,
                    failed: 0,
                    tried: 0,
                })
                .collect();
            for (number, fails) in numbers.iter().zip(fails) {
                if let Some(row) = rows.get_mut(*number) {
                    row.failed += usize::from(*fails);
                    row.tried += 1;
                }
            }
            rows.sort_by(|a, b| b.rate().total_cmp(&a.rate()).then(b.tried.cmp(&a.tried)));
            Division {
                name,
                explained,
                rows,
            }
        })
        .collect();
    let p = |division: &Division| division.explained.p.unwrap_or(1.0);
    divisions.sort_by(|a, b| {
        let by_deviance = b.explained.deviance.total_cmp(&a.explained.deviance);
        p(a).total_cmp(&p(b)).then(by_deviance)
    });
    divisions
}

impl Display for KitchenTable {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(
            f,
            "kitchens: {} in {}, in {} of {}",
            plural(self.failed, "failure"),
            plural(self.tried, "world"),
            self.failing_kitchens,
            plural(self.kitchens, "kitchen")
        )?;
        if self.failed == 0 {
            return Ok(());
        }
        let rows = || self.divisions.iter().flat_map(|division| &division.rows);
        let width = rows().map(|row| row.class.chars().count()).max();
        let width = width.unwrap_or(0);
        for division in &self.divisions {
            writeln!(f, "  {}   {}", division.name, division.verdict())?;
            for row in &division.rows {
                let [low, high] = row.interval().map(|bound| 100.0 * bound);
                writeln!(
                    f,
                    "    {:width$}  {:>4} of {:<4}  {:>5.1} %  [{low:.1}, {high:.1}]",
                    row.class,
                    row.failed,
                    row.tried,
                    100.0 * row.rate()
                )?;
            }
        }
        for finding in self.findings.iter().take(MAX_FINDINGS) {
            writeln!(
                f,
                "  {}: {}  --replay {}",
                finding.where_it_is(),
                finding.words(),
                finding.examples()
            )?;
        }
        let rest = self.findings.iter().skip(MAX_FINDINGS);
        let (count, worlds) = rest.fold((0, 0), |(count, worlds), finding| {
            (count + 1, worlds + finding.worlds.len())
        });
        match count {
            0 => Ok(()),
            count => writeln!(
                f,
                "  {} of {}",
                plural(worlds, "world"),
                plural(count, "further kind")
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sweep::{Draws, Ending};

    /// Worlds in kitchens, which fail as a function of the aisle says.
    fn worlds(count: u64, fails: impl Fn(u64, f64) -> bool) -> Vec<Record> {
        let world = |world| {
            let mut numbers = Draws::new(5, world, "test");
            let aisle = (900.0 + 600.0 * numbers.unit()).round() / 1e3;
            let is_failure = fails(world, aisle);
            let mut record = Record::new(
                world,
                if is_failure {
                    Ending::Failure
                } else {
                    Ending::Success
                },
            );
            let row = world % 4 + 1;
            if is_failure {
                record.class = Some("MANIPULATION-POSE-UNREACHABLE".to_owned());
                record.bodies = vec![
                    "r_forearm_link".to_owned(),
                    format!("back_{row}_drawer_2_handle"),
                ];
            }
            let layouts = ["L", "U", "GALLEY"];
            let height = 0.85 + 0.1 * numbers.unit();
            let draws = &mut record.draws;
            draws.set(
                "home",
                Drawn::Integer(1000 + i64::try_from(world / 2).unwrap()),
            );
            draws.set(
                "home.arrangement",
                Drawn::Text(layouts[(world % 3) as usize].to_owned()),
            );
            draws.set("home.counter-height", Drawn::Number(height));
            if world % 3 != 0 {
                draws.set("home.aisle", Drawn::Number(aisle));
            }
            draws.set("from", Drawn::Text(format!("BACK-{row}-HANGING")));
            draws.set("from.height", Drawn::Number(height));
            draws.set("from.distance", Drawn::Number(1.0 + 2.0 * numbers.unit()));
            record
        };
        (0..count).map(world).collect()
    }

    #[test]
    fn a_planted_cause_comes_first_and_counts_add_up() {
        let mut records = worlds(300, |world, aisle| world % 3 != 0 && aisle < 1.0);
        records[7].outcome = Ending::Invalid;
        let table = KitchenTable::of(&records).unwrap();
        assert_eq!(table.divisions[0].name, "aisle");
        assert!(table.divisions[0].explains());
        assert_eq!(table.divisions[0].rows[0].class, "< 1.00 m");
        assert_eq!(table.divisions[0].rows[0].rate(), 1.0);
        assert_eq!((table.tried, table.kitchens), (299, 150));
        for division in &table.divisions {
            let sum = |count: fn(&Row) -> usize| division.rows.iter().map(count).sum::<usize>();
            assert_eq!(sum(|row| row.tried), table.tried, "{}", division.name);
            assert_eq!(sum(|row| row.failed), table.failed, "{}", division.name);
        }
        // The handle is another link in every kitchen, and one finding.
        assert_eq!(table.findings.len(), 1, "{:?}", table.findings);
        let finding = &table.findings[0];
        assert_eq!(finding.kind[2], "r_forearm_link/drawer handle");
        assert_eq!(finding.worlds.len(), table.failed);
        assert_eq!(finding.layouts.values().sum::<usize>(), table.failed);
        let text = table.to_string();
        assert!(text.starts_with("kitchens: "), "{text}");
        assert!(
            text.contains("  aisle   explains failures (p = 0.0"),
            "{text}"
        );
    }

    #[test]
    fn sweeps_without_kitchens_have_no_table_and_few_worlds_say_little() {
        let plain = Record::new(0, Ending::Failure);
        assert_eq!(KitchenTable::of(&[plain]), None);
        assert_eq!(KitchenTable::of(&[]), None);
        let one = KitchenTable::of(&worlds(1, |_, _| true)).unwrap();
        assert!(one.divisions.is_empty());
        assert!(
            one.to_string()
                .starts_with("kitchens: 1 failure in 1 world, in 1 of 1 kitchen\n"),
            "{one}"
        );
        let none = KitchenTable::of(&worlds(40, |_, _| false)).unwrap();
        assert_eq!(
            none.to_string(),
            "kitchens: 0 failures in 40 worlds, in 0 of 20 kitchens\n"
        );
        let all = KitchenTable::of(&worlds(40, |_, _| true)).unwrap();
        assert!(all.divisions.iter().all(|division| !division.explains()));
        assert_eq!(all.failed, 40);
        // One of twenty would be expected; four or more happen in one of 60 such tests.
        let found = (0..20).filter(|seed| {
            let fails = |world, _| Draws::new(*seed, world, "fails").unit() < 0.15;
            let table = KitchenTable::of(&worlds(200, fails)).unwrap();
            table.divisions.iter().any(Division::explains)
        });
        let found = found.count();
        assert!(found < 4, "{found}");
    }
}

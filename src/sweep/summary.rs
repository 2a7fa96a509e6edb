//! What all worlds of a sweep say together, as text.

use std::collections::BTreeMap;
use std::fmt::{self, Display};

use super::pairs::Pairs;
use super::plural::plural;
use super::rate::{at_least, wilson};
use super::record::Record;

/// Confidence of all intervals.
pub const CONFIDENCE: f64 = 0.95;
/// Maximum number of worlds that are named as examples of a kind of failure.
const MAX_EXAMPLES: usize = 3;
/// Maximum number of kinds of failures that are listed.
const MAX_KINDS: usize = 20;
/// Maximum number of failures that are named as never handled.
const MAX_UNHANDLED: usize = 10;
/// Share of invalid worlds from which on a variable is warned of.
const MANY_INVALID: f64 = 0.2;

/// What a sweep is called and wants.
#[derive(Clone, Debug, PartialEq)]
pub struct Title {
    /// Its name.
    pub name: String,
    /// The seed.
    pub seed: u64,
    /// The rate of success that is wanted, if any.
    pub goal: Option<f64>,
}

/// The worlds that ended in the same way.
#[derive(Clone, Debug, PartialEq)]
pub struct Kind {
    /// Class, cause and bodies.
    pub kind: [String; 3],
    /// The worlds, in order.
    pub worlds: Vec<u64>,
}

/// What all worlds of a sweep say together.
pub struct Summary<'r> {
    title: &'r Title,
    records: &'r [Record],
    /// Worlds in which the plan was tried.
    pub tried: usize,
    /// Worlds in which it worked.
    pub(crate) successes: usize,
}

impl<'r> Summary<'r> {
    /// A summary of records, which are in the order of their worlds.
    pub fn new(title: &'r Title, records: &'r [Record]) -> Self {
        let tried = records.iter().filter(|r| r.outcome.counts()).count();
        let successes = records.iter().filter(|r| r.is_success()).count();
        Self {
            title,
            records,
            tried,
            successes,
        }
    }

    /// The number of worlds.
    pub fn count(&self) -> u64 {
        self.records.len() as u64
    }

    /// The share of worlds in which the plan worked.
    pub fn rate(&self) -> f64 {
        self.successes as f64 / (self.tried as f64).max(1.0)
    }

    /// Whether the goal is met; true if there is none. A goal is met if the worlds that were
    /// tried, of which there must be one, worked as often as wanted.
    pub fn meets_goal(&self) -> bool {
        let Some(goal) = self.title.goal else {
            return true;
        };
        self.tried > 0 && self.rate() >= goal
    }

    /// The kinds of failures, the most frequent first.
    pub fn kinds(&self) -> Vec<Kind> {
        let failed = |r: &&Record| r.outcome.counts() && !r.is_success();
        kinds(self.records.iter().filter(failed))
    }

    /// The kinds of reasons for which worlds are invalid, the most frequent first.
    fn invalid(&self) -> Vec<Kind> {
        let invalid = |r: &&Record| !r.outcome.counts() && !r.outcome.is_defect();
        kinds(self.records.iter().filter(invalid))
    }

    /// The number of worlds that planwright could not run, so that nothing is known about them.
    pub fn defects(&self) -> usize {
        let records = self.records.iter();
        records.filter(|r| r.outcome.is_defect()).count()
    }

    fn heading(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let defects = self.defects();
        let invalid = self.records.len() - self.tried - defects;
        let Title { name, seed, .. } = self.title;
        write!(
            f,
            "{name}   seed {seed}   {}",
            plural(self.records.len(), "world")
        )?;
        let invalid = (invalid > 0).then(|| format!("{invalid} invalid"));
        let defects = (defects > 0).then(|| plural(defects, "defect"));
        let apart: Vec<String> = invalid.into_iter().chain(defects).collect();
        if !apart.is_empty() {
            write!(f, " ({})", apart.join(", "))?;
        }
        writeln!(f)
    }

    fn success(&self, f: &mut fmt::Formatter) -> fmt::Result {
        if self.tried == 0 {
            writeln!(f, "success  unknown: no world could be tried")?;
        } else {
            let [low, high] = wilson(self.successes, self.tried, CONFIDENCE);
            let (rate, low, high) = (percent(self.rate()), percent(low), percent(high));
            write!(f, "success  {rate} %  [{low}, {high}]")?;
            if self.successes == self.tried {
                let least = at_least(self.successes, self.tried, CONFIDENCE);
                write!(f, "  (at least {} %)", percent(least))?;
            }
        }
        if let Some(goal) = self.title.goal {
            let verdict = if self.meets_goal() { "met" } else { "NOT MET" };
            write!(f, "   goal {} %: {verdict}", percent_short(goal))?;
        }
        writeln!(f)
    }

    fn failures(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let kinds = self.kinds();
        let shown = kinds.iter().take(MAX_KINDS);
        let width = |part: usize| {
            let lengths = shown.clone().map(|k| k.kind[part].chars().count());
            lengths.max().unwrap_or(0)
        };
        let widths = [0, 1, 2].map(width);
        for Kind { kind, worlds } in shown.clone() {
            write!(f, "{:>4}", worlds.len())?;
            for (part, width) in kind.iter().zip(widths).filter(|(_, width)| *width > 0) {
                write!(f, "  {part:width$}")?;
            }
            writeln!(f, "  --replay {}", examples(worlds))?;
        }
        let rest: usize = kinds.iter().skip(MAX_KINDS).map(|k| k.worlds.len()).sum();
        if rest > 0 {
            writeln!(f, "{rest:>4}  of {} further kinds", kinds.len() - MAX_KINDS)?;
        }
        Ok(())
    }

    fn invalid_worlds(&self, f: &mut fmt::Formatter) -> fmt::Result {
        for Kind { kind, worlds } in self.invalid() {
            let [variable, cause, _] = kind;
            let many = worlds.len() as f64 > MANY_INVALID * self.records.len() as f64;
            let mark = if many { "warning: " } else { "" };
            let (count, examples) = (plural(worlds.len(), "world"), examples(&worlds));
            writeln!(
                f,
                "{mark}{count} invalid: {variable} {cause}  --replay {examples}"
            )?;
        }
        Ok(())
    }

    /// Why planwright could not run worlds.
    fn defective_worlds(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let defective = self.records.iter().filter(|r| r.outcome.is_defect());
        for Kind { kind, worlds } in kinds(defective) {
            let parts: Vec<&str> = kind.iter().map(String::as_str).collect();
            let cause = parts.join(" ");
            let (count, examples) = (plural(worlds.len(), "world"), examples(&worlds));
            writeln!(
                f,
                "{count} not counted: {}  --replay {examples}",
                cause.trim()
            )?;
        }
        Ok(())
    }

    fn effort(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let tried: Vec<&Record> = self.records.iter().filter(|r| r.outcome.counts()).collect();
        if tried.is_empty() {
            return Ok(());
        }
        let mut times: Vec<f64> = tried.iter().map(|r| r.time).collect();
        times.sort_by(f64::total_cmp);
        let [low, middle, high] = [0.05, 0.5, 0.95].map(|share| quantile(&times, share));
        let count = tried.len() as f64;
        let driven = tried.iter().map(|r| r.distance).sum::<f64>() / count;
        let failed: u64 = tried
            .iter()
            .flat_map(|r| r.failures.iter())
            .map(|(_, n)| n)
            .sum();
        writeln!(
            f,
            "simulated time median {middle:.1} s (5–95 %: {low:.1}–{high:.1}) · driven {driven:.1} m · \
             {:.1} failed motions",
            failed as f64 / count
        )?;
        self.measures(&tried, f)?;
        self.reach(&tried, f)
    }

    /// Which failures the handlers of the plan name, and have never handled.
    fn handlers(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let mut totals: Pairs<u64> = Pairs::default();
        for (name, count) in self
            .records
            .iter()
            .flat_map(|record| record.handlers.iter())
        {
            let before = totals.get(name).copied().unwrap_or(0);
            totals.set(name, before + count);
        }
        let all = totals.iter().count();
        if all == 0 {
            return Ok(());
        }
        let never: Vec<&str> = totals
            .iter()
            .filter(|(_, count)| **count == 0)
            .map(|(name, _)| name)
            .collect();
        write!(
            f,
            "handlers: {} of {all} failures handled",
            all - never.len()
        )?;
        if !never.is_empty() {
            let more = if never.len() > MAX_UNHANDLED {
                " · …"
            } else {
                ""
            };
            let named: Vec<&str> = never.into_iter().take(MAX_UNHANDLED).collect();
            write!(f, "; never {}{more}", named.join(" · "))?;
        }
        writeln!(f)
    }

    /// What was measured: median and spread.
    fn measures(&self, tried: &[&Record], f: &mut fmt::Formatter) -> fmt::Result {
        for (name, mut values) in columns(tried, |r| r.measures.iter()) {
            values.sort_by(f64::total_cmp);
            let [low, middle, high] = [0.05, 0.5, 0.95].map(|share| quantile(&values, share));
            writeln!(f, "{name} median {middle:.4} (5–95 %: {low:.4}–{high:.4})")?;
        }
        Ok(())
    }

    /// How far the draws have reached: easy worlds say nothing.
    fn reach(&self, tried: &[&Record], f: &mut fmt::Formatter) -> fmt::Result {
        let columns = columns(tried, |r| r.draws.iter());
        let ranges: Vec<String> = columns
            .into_iter()
            // What objects of a group draw is much of the same.
            .filter(|(name, _)| !name.split('.').any(|part| part.parse::<u32>().is_ok()))
            .filter_map(|(name, values)| {
                let low = values.iter().copied().fold(f64::INFINITY, f64::min);
                let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                (low < high).then(|| format!("{name} {low:.2} to {high:.2}"))
            })
            .collect();
        if ranges.is_empty() {
            return Ok(());
        }
        writeln!(f, "tried: {}", ranges.join(" · "))
    }
}

/// Numbers by name, in the order in which the names first occur.
fn columns<'r, I>(
    records: &[&'r Record],
    values: impl Fn(&'r Record) -> I,
) -> Vec<(&'r str, Vec<f64>)>
where
    I: Iterator<Item = (&'r str, &'r super::record::Drawn)>,
{
    let mut columns: Vec<(&str, Vec<f64>)> = Vec::new();
    for (name, value) in records.iter().flat_map(|record| values(record)) {
        let Some(number) = value.number() else {
            continue;
        };
        match columns.iter_mut().find(|(known, _)| *known == name) {
            Some((_, numbers)) => numbers.push(number),
            None => columns.push((name, vec![number])),
        }
    }
    columns
}

fn kinds<'r>(records: impl Iterator<Item = &'r Record>) -> Vec<Kind> {
    let mut by_kind: BTreeMap<[String; 3], Vec<u64>> = BTreeMap::new();
    for record in records {
        by_kind.entry(record.kind()).or_default().push(record.world);
    }
    let kinds = by_kind.into_iter();
    let mut kinds: Vec<Kind> = kinds.map(|(kind, worlds)| Kind { kind, worlds }).collect();
    kinds.sort_by_key(|kind| std::cmp::Reverse(kind.worlds.len()));
    kinds
}

fn examples(worlds: &[u64]) -> String {
    let mut shown: Vec<String> = worlds
        .iter()
        .take(MAX_EXAMPLES)
        .map(u64::to_string)
        .collect();
    if worlds.len() > MAX_EXAMPLES {
        shown.push("…".to_owned());
    }
    shown.join(" ")
}

/// The number below which that share of the sorted numbers lies; the nearest of them.
fn quantile(sorted: &[f64], share: f64) -> f64 {
    let at = (share * (sorted.len().saturating_sub(1)) as f64).round() as usize;
    sorted.get(at).copied().unwrap_or(f64::NAN)
}

fn percent(share: f64) -> String {
    format!("{:.1}", share * 100.0)
}

fn percent_short(share: f64) -> String {
    let text = percent(share);
    text.strip_suffix(".0").map_or(text.clone(), str::to_owned)
}

impl Display for Summary<'_> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        self.heading(f)?;
        self.success(f)?;
        self.failures(f)?;
        self.invalid_worlds(f)?;
        self.defective_worlds(f)?;
        self.effort(f)?;
        self.handlers(f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Drawn, Ending};

    #[test]
    fn worlds_are_told_apart_by_what_went_wrong() {
        let mut records: Vec<Record> = (0..20).map(|i| Record::new(i, Ending::Success)).collect();
        for i in [3, 5, 8, 13] {
            records[i].outcome = Ending::Failure;
            records[i].class = Some("NAVIGATION-POSE-UNREACHABLE".to_owned());
            records[i].cause = Some("GoalOccupied".to_owned());
        }
        records[7].outcome = Ending::Expectation;
        records[7].class = Some("upright".to_owned());
        records[9].outcome = Ending::Invalid;
        records[9].class = Some("clutter".to_owned());
        records[9].cause = Some("found no place".to_owned());
        for (i, record) in records.iter_mut().enumerate() {
            record
                .handlers
                .set("a.plan:3 GRASP-FAILED", u64::from(i == 3));
            record.handlers.set("a.plan:9 NOT-FOUND", 0);
            record.draws.set("x", Drawn::Number(i as f64 / 10.0));
        }
        let title = Title {
            name: "demo".to_owned(),
            seed: 42,
            goal: Some(0.9),
        };
        let summary = Summary::new(&title, &records);
        assert_eq!(
            summary.to_string(),
            "demo   seed 42   20 worlds (1 invalid)\n\
             success  73.7 %  [51.2, 88.2]   goal 90 %: NOT MET\n\
             \x20  4  NAVIGATION-POSE-UNREACHABLE  GoalOccupied  --replay 3 5 8 …\n\
             \x20  1  expectation upright                        --replay 7\n\
             1 world invalid: clutter found no place  --replay 9\n\
             simulated time median 0.0 s (5–95 %: 0.0–0.0) · driven 0.0 m · 0.0 failed motions\n\
             tried: x 0.00 to 1.90\n\
             handlers: 1 of 2 failures handled; never a.plan:9 NOT-FOUND\n"
        );
        assert!(!summary.meets_goal());
    }

    #[test]
    fn what_planwright_could_not_do_is_no_failure_of_the_plan() {
        let mut records: Vec<Record> = (0..6).map(|i| Record::new(i, Ending::Success)).collect();
        records[1].outcome = Ending::Defect;
        records[1].cause = Some("memory".to_owned());
        records[2].outcome = Ending::Crashed;
        records[3].outcome = Ending::Timeout;
        records[4].outcome = Ending::Invalid;
        let title = Title {
            name: "demo".to_owned(),
            seed: 0,
            goal: None,
        };
        let summary = Summary::new(&title, &records);
        assert_eq!((summary.tried, summary.defects()), (2, 3));
        let text = summary.to_string();
        assert!(
            text.starts_with("demo   seed 0   6 worlds (1 invalid, 3 defects)\nsuccess  100.0 %")
        );
        assert!(text.contains("1 world not counted: crashed  --replay 2\n"));
        assert!(text.contains("1 world not counted: defect memory  --replay 1\n"));
        assert!(text.contains("1 world not counted: timeout  --replay 3\n"));
    }
}

//! Two plans in the same worlds.

use std::io::{self, Write};

use super::interrupt;
use super::kept::Kept;
use super::pool;
use super::progress::Progress;
use super::worlds::Worlds;
use lisp::visible::visible;
use sweep::Record;
use sweep::paired::{Comparison, Decision, error_at_look, is_decided};
use sweep::summary::{CONFIDENCE, Summary, Title};

/// What a plan did, and what its sweep is called and wants.
pub(super) struct Side {
    /// The name of the plan's file.
    pub(super) file: String,
    pub(super) title: Title,
    pub(super) records: Vec<Record>,
}

/// Both plans, each in the same worlds.
pub(super) struct Compared {
    pub(super) sides: [Side; 2],
    /// What the looks have decided, if the worlds were to end with a decision.
    decision: Option<Decision>,
}

/// Runs both plans in one world after the other, until all are done, an interrupt comes, or, if that
/// is wanted, it is decided which plan is better.
pub(super) fn compare(
    plans: [(&Worlds, String, Title); 2],
    count: u64,
    threads: usize,
    until_decided: bool,
) -> Compared {
    let [(first, ..), (second, ..)] = &plans;
    let mut progress = Progress::new(&plans[1].2, count);
    let mut kept = Kept::default();
    let mut only = [0, 0];
    let mut decision = until_decided.then_some(Decision::Open);
    let records = pool::in_order(
        threads,
        0..count,
        || {
            let (mut first, mut second) = (first.runner(), second.runner());
            move |world| [first(world), second(world)]
        },
        |[a, b]| {
            if a.outcome.counts() && b.outcome.counts() && a.is_success() != b.is_success() {
                only[usize::from(b.is_success())] += 1;
            }
            let error = error_at_look(a.world + 1, 1.0 - CONFIDENCE);
            if let (Some(decision), Some(error)) = (&mut decision, error)
                && is_decided(only, error)
            {
                *decision = Decision::At { error };
            }
            let is_open = !matches!(decision, Some(Decision::At { .. }));
            progress.record(b);
            let has_room = kept.keep(a) && kept.keep(b);
            has_room && is_open && !interrupt::has_come()
        },
    );
    progress.end();
    kept.tell_if_full();
    let pairs = records.into_iter().map(|[a, b]| (a, b));
    let (a, b): (Vec<Record>, Vec<Record>) = pairs.unzip();
    let mut records = [a, b].into_iter();
    let sides = plans.map(|(_, file, title)| Side {
        file,
        title,
        records: records.next().unwrap_or_default(),
    });
    Compared { sides, decision }
}

impl Compared {
    /// How many worlds there should be: fewer than `count` if the decision came before.
    pub(super) fn wanted(&self, count: u64) -> u64 {
        match self.decision {
            Some(Decision::At { .. }) => self.sides[1].records.len() as u64,
            _ => count,
        }
    }

    /// Tells what both did, and which one is better.
    pub(super) fn tell(&self) -> io::Result<()> {
        let mut out = io::BufWriter::new(io::stdout());
        let mut text = String::new();
        for side in &self.sides {
            text.push_str(&Summary::new(&side.title, &side.records).to_string());
        }
        let [a, b] = &self.sides;
        let names = [a.file.clone(), b.file.clone()];
        let comparison = Comparison::new(names, &a.records, &b.records);
        text.push_str(&comparison.to_string());
        if let Some(decision) = self.decision {
            text.push_str(&comparison.verdict(decision));
            text.push('\n');
        }
        out.write_all(visible(&text).as_bytes())?;
        out.flush()
    }
}

//! The simplest world with the same failure: faults off, things out, draws at their simplest values,
//! numbers with few digits.

use std::io::{self, Write};

use super::pool;
use super::worlds::Worlds;
use crate::command::failure::CommandError;
use sweep::pairs::Pairs;
use sweep::{Drawn, Ending, Record};

/// Maximum number of worlds that are tried.
const MAX_RUNS: usize = 300;

/// A world that fails, with the draws that have been set in it.
struct World {
    set: Vec<(String, String)>,
    record: Record,
    /// The simplest values of its draws.
    simplest: Pairs<Drawn>,
}

/// A change: the draw and the value that it gets, as the language writes it.
type Change = (String, String);

/// Shrinks a world and writes what is left, as a form for the prompt.
pub(super) fn shrink(
    worlds: &Worlds,
    name: &str,
    seed: u64,
    number: u64,
    threads: usize,
) -> Result<(), CommandError> {
    let mut out = io::stdout();
    let Some(first) = tried(worlds, number, threads, &[Vec::new()]).pop() else {
        return Ok(());
    };
    if first.record.is_success()
        || matches!(first.record.outcome, Ending::Invalid | Ending::Mistake)
    {
        return Err(CommandError::Sweep(format!(
            "world {number} does not fail: its outcome is {}",
            first.record.outcome
        )));
    }
    let (world, runs) = simplified(worlds, number, threads, first);
    let kind = world.record.kind();
    let kind: Vec<&str> = kind
        .iter()
        .map(String::as_str)
        .filter(|part| !part.is_empty())
        .collect();
    writeln!(
        out,
        "world {number}, {}, after {runs} runs:",
        kind.join(" ")
    )?;
    for (path, value) in world.record.draws.iter() {
        writeln!(out, "  {path} {}", value.to_string().to_lowercase())?;
    }
    for fault in &world.record.faults {
        writeln!(out, "  {fault}")?;
    }
    // What belongs to things that have been taken out is not drawn any more.
    let set = world.set.iter();
    let set = set
        .filter(|(path, _)| path.starts_with("inject.") || world.record.draws.get(path).is_some());
    let set: Vec<String> = set
        .map(|(path, value)| format!("({path:?} {value})"))
        .collect();
    writeln!(
        out,
        "(sweep-world '{name} {number} :seed {seed}\n             :with '({}))",
        set.join("\n                     ")
    )?;
    Ok(())
}

/// The worlds with draws set in each of the ways.
fn tried(worlds: &Worlds, number: u64, threads: usize, ways: &[Vec<Change>]) -> Vec<World> {
    let runner = || {
        let mut sessions = worlds.in_sessions();
        move |set: &Vec<Change>| {
            let (record, simplest) = sessions.run(number, set);
            World {
                set: set.clone(),
                record,
                simplest,
            }
        }
    };
    pool::in_order(threads, ways, runner, |_| true)
}

/// Applies changes as long as the world fails in the same way; returns it with the number of runs.
fn simplified(worlds: &Worlds, number: u64, threads: usize, first: World) -> (World, usize) {
    let kind = first.record.kind();
    let outcome = first.record.outcome;
    let mut world = first;
    let mut runs = 1;
    loop {
        let before = world.set.clone();
        for changes in [faults_off, things_out, simplest, rounded] {
            let changes = changes(&world);
            let mut left = changes.as_slice();
            while !left.is_empty() && runs < MAX_RUNS {
                let batch = left.get(..threads.min(left.len())).unwrap_or(left);
                let ways: Vec<Vec<Change>> = batch
                    .iter()
                    .map(|change| with(&world.set, change))
                    .collect();
                // A value that a draw cannot have changes nothing.
                let same = |tried: &World| {
                    tried.record.outcome == outcome
                        && tried.record.kind() == kind
                        && tried.record.draws != world.record.draws
                };
                let results = tried(worlds, number, threads, &ways);
                // The first in order wins, so that the number of threads does not matter.
                match results
                    .into_iter()
                    .enumerate()
                    .find(|(_, world)| same(world))
                {
                    Some((at, simpler)) => {
                        world = simpler;
                        runs += at + 1;
                        left = left.get(at + 1..).unwrap_or_default();
                    }
                    None => {
                        runs += batch.len();
                        left = left.get(batch.len()..).unwrap_or_default();
                    }
                }
            }
        }
        if world.set == before || runs >= MAX_RUNS {
            return (world, runs);
        }
    }
}

fn with(set: &[Change], (path, value): &Change) -> Vec<Change> {
    let others = set.iter().filter(|(known, _)| known != path);
    let mut set: Vec<Change> = others.cloned().collect();
    set.push((path.clone(), value.clone()));
    set
}

/// Changes that switch off the faults that have struck.
fn faults_off(world: &World) -> Vec<Change> {
    let faults = world.record.faults.iter();
    faults
        .map(|fault| (fault.clone(), "nil".to_owned()))
        .collect()
}

/// Changes that take out members of groups, and what there is only sometimes.
fn things_out(world: &World) -> Vec<Change> {
    let mut changes = Vec::new();
    for (path, value) in world.record.draws.iter() {
        let is_member = path
            .rsplit('.')
            .next()
            .is_some_and(|last| last.parse::<u32>().is_ok());
        match value {
            Drawn::Text(kind) if is_member && kind != "NONE" => {
                changes.push((path.to_owned(), "\"none\"".to_owned()));
            }
            Drawn::Flag(true) => changes.push((path.to_owned(), "nil".to_owned())),
            _ => {}
        }
    }
    changes
}

/// Changes that give draws their simplest values.
fn simplest(world: &World) -> Vec<Change> {
    let mut changes = Vec::new();
    for (path, simplest) in world.simplest.iter() {
        let now = world.record.draws.get(path);
        if now.is_some_and(|now| now != simplest && now.to_string() != "NONE") {
            changes.push((path.to_owned(), written(simplest)));
        }
    }
    changes
}

/// Changes that round numbers, to few digits first.
fn rounded(world: &World) -> Vec<Change> {
    let mut changes = Vec::new();
    for (path, value) in world.record.draws.iter() {
        let Drawn::Number(number) = value else {
            continue;
        };
        for scale in [10.0, 100.0, 1000.0] {
            let rounded = (number * scale).round() / scale;
            if rounded == *number {
                break;
            }
            changes.push((path.to_owned(), written(&Drawn::Number(rounded))));
        }
    }
    changes
}

/// A value as the language reads it.
fn written(value: &Drawn) -> String {
    match value {
        Drawn::Flag(true) => "t".to_owned(),
        Drawn::Flag(false) => "nil".to_owned(),
        Drawn::Integer(number) => number.to_string(),
        // The exponent says that it is a double.
        Drawn::Number(number) => format!("{number}d0"),
        Drawn::Text(text) => format!("{text:?}"),
    }
}

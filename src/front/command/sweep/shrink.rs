//! The simplest world with the same failure: faults off, a simpler kitchen, things out, draws at their
//! simplest values, numbers with few digits.

use std::io::{self, Write};
use std::time::{Duration, Instant};

use super::pool;
use super::worlds::Worlds;
use crate::command::failure::CommandError;
use kitchens::{Kitchen, Settings, kind_of_failure, kitchen_path};
use session::sweeping::Simpler;
use sweep::{Drawn, Ending, Record};

/// Maximum number of worlds that are tried.
const MAX_RUNS: usize = 300;
/// Real time after which no more worlds are tried.
const MAX_TIME: Duration = Duration::from_secs(1800);

/// A world that fails, with the draws that have been set in it.
struct World {
    set: Vec<(String, String)>,
    record: Record,
    /// What could be simpler in it.
    simpler: Simpler,
}

impl World {
    /// The path of the kitchen that it has drawn.
    fn kitchen(&self) -> Option<&str> {
        kitchen_path(&self.record)
    }

    /// The seed of that kitchen.
    fn kitchen_seed(&self) -> Option<u64> {
        let seed = self.record.draws.get(self.kitchen()?)?;
        seed.to_string().parse().ok()
    }

    /// The parameter of that kitchen which a draw with a path is.
    fn parameter<'p>(&self, path: &'p str) -> Option<&'p str> {
        below(path, self.kitchen()?).filter(|name| kitchens::is_parameter(name))
    }

    /// Whether another world fails as it does: in other kitchens, furniture has other names.
    fn fails_like(&self, other: &World) -> bool {
        let kind = |world: &World| match world.kitchen() {
            Some(_) => kind_of_failure(&world.record),
            None => world.record.kind(),
        };
        self.record.outcome == other.record.outcome && kind(self) == kind(other)
    }

    /// What it draws from lists, but for its kitchen: names of surfaces and types, for example.
    fn names(&self) -> Vec<(&str, &str)> {
        let kitchen = self.kitchen();
        let names = self.record.draws.iter().filter_map(|(path, drawn)| {
            let is_of_kitchen =
                kitchen.is_some_and(|kitchen| path == kitchen || below(path, kitchen).is_some());
            match drawn {
                Drawn::Text(text) if !is_of_kitchen => Some((path, text.as_str())),
                _ => None,
            }
        });
        names.collect()
    }

    /// Whether the kitchen that is set could not be made of what was drawn.
    fn is_redrawn(&self) -> bool {
        self.kitchen().is_some_and(|path| {
            let redrawn = self.record.draws.get(&format!("{path}.redrawn"));
            redrawn == Some(&Drawn::Flag(true))
        })
    }
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
    let runner = || {
        let mut sessions = worlds.in_sessions();
        move |set: Vec<Change>| {
            let (record, simpler) = sessions.run(number, &set);
            World {
                set,
                record,
                simpler,
            }
        }
    };
    let shrunk = pool::with_workers(threads, runner, |tried| {
        let Some(first) = tried(vec![Vec::new()]).pop() else {
            return Ok(None);
        };
        check_failure(&first.record)?;
        Ok::<_, CommandError>(Some(simplified(threads, first, tried)))
    })?;
    let Some((world, runs, is_complete)) = shrunk else {
        return Ok(());
    };
    let settings = needed_settings(&world);
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
    // A parameter of the kitchen may be set in vain: that of something that has been taken out since.
    let is_in_vain = |path: &str| {
        let is_set = world.set.iter().any(|(known, _)| known == path);
        let name = world.parameter(path).filter(|_| is_set);
        name.is_some_and(|name| settings.iter().all(|(needed, _)| needed != name))
    };
    for (path, value) in world.record.draws.iter() {
        if !is_in_vain(path) {
            writeln!(out, "  {path} {}", value.to_string().to_lowercase())?;
        }
    }
    for fault in &world.record.faults {
        writeln!(out, "  {fault}")?;
    }
    // What belongs to things that have been taken out is not drawn any more.
    let set = world.set.iter().filter(|(path, _)| {
        let is_there = world.parameter(path).is_some()
            || path.starts_with("inject.")
            || world.record.draws.get(path).is_some();
        is_there && !is_in_vain(path)
    });
    let set: Vec<String> = set
        .map(|(path, value)| format!("({path:?} {value})"))
        .collect();
    writeln!(
        out,
        "(sweep-world '{name} {number} :seed {seed}\n             :with '({}))",
        set.join("\n                     ")
    )?;
    tell_kitchen(&mut out, &world, &settings)?;
    if !is_complete {
        writeln!(
            out,
            "not everything has been tried: {MAX_RUNS} runs, and {} minutes, are enough",
            MAX_TIME.as_secs() / 60
        )?;
    }
    Ok(())
}

/// The parameters without which the kitchen would be another one, and their values as `--world` has them.
fn needed_settings(world: &World) -> Settings {
    let mut settings = Settings::default();
    for (name, value) in &world.simpler.settings {
        // They have made a kitchen.
        let _ = settings.set_text(name, value);
    }
    match world.kitchen_seed() {
        Some(seed) => Kitchen::needed(seed, &settings),
        None => settings,
    }
}

/// Tells how the kitchen has become simpler, what the failure needs, and how to start it.
fn tell_kitchen(out: &mut impl Write, world: &World, settings: &Settings) -> io::Result<()> {
    let Some(seed) = world.kitchen_seed() else {
        return Ok(());
    };
    let settings = settings.iter();
    let settings: Vec<(&str, String)> = settings
        .map(|(name, setting)| (name, setting.to_string()))
        .collect();
    let is_simpler = |(name, _): &&(&str, String)| {
        let mut set = world.set.iter();
        set.any(|(path, _)| world.parameter(path) == Some(name))
    };
    let simpler: Vec<String> = settings
        .iter()
        .filter(is_simpler)
        .map(|(name, value)| format!("{name} {value}"))
        .collect();
    match simpler.is_empty() {
        true => writeln!(out, "kitchen {seed}, in which nothing could be simpler")?,
        false => writeln!(out, "kitchen {seed}, simpler: {}", simpler.join(" · "))?,
    }
    let mut needed: Vec<&str> = Vec::new();
    for (path, _) in &world.simpler.kitchen {
        if let Some(name) = world.parameter(path).filter(|name| !needed.contains(name)) {
            needed.push(name);
        }
    }
    if !needed.is_empty() {
        writeln!(
            out,
            "no simpler, since another value changes the failure, gives no kitchen, or changes nothing: {}",
            needed.join(" · ")
        )?;
    }
    let keys: String = settings
        .iter()
        .map(|(name, value)| match *name {
            "arrangement" => format!(" :{name} :{value}"),
            _ => format!(" :{name} {value}"),
        })
        .collect();
    writeln!(out, "(new-kitchen {seed}{keys})")?;
    let options = settings.iter();
    let options: String = options
        .map(|(name, value)| format!(",{name}={value}"))
        .collect();
    writeln!(out, "planwright --world generated:{seed}{options}")
}

/// An error unless the plan fails in a world.
pub(super) fn check_failure(record: &Record) -> Result<(), CommandError> {
    let outcome = record.outcome;
    match record.is_success() || matches!(outcome, Ending::Invalid | Ending::Mistake) {
        true => Err(CommandError::Sweep(format!(
            "world {} does not fail: its outcome is {outcome}",
            record.world
        ))),
        false => Ok(()),
    }
}

/// Applies changes as long as the world fails in the same way, so many at the same time; returns it with the number
/// of runs, and whether all changes have been tried. `tried` gives the worlds with draws set in each of some ways.
fn simplified(
    threads: usize,
    first: World,
    tried: &mut dyn FnMut(Vec<Vec<Change>>) -> Vec<World>,
) -> (World, usize, bool) {
    let begun = Instant::now();
    let mut world = first;
    let mut runs = 1;
    let is_late = |runs: usize| runs >= MAX_RUNS || begun.elapsed() > MAX_TIME;
    loop {
        let before = world.set.clone();
        for changes in [faults_off, simpler_kitchen, things_out, simplest, rounded] {
            let changes = changes(&world);
            let mut left = changes.as_slice();
            while !left.is_empty() && !is_late(runs) {
                let batch = left.get(..threads.min(left.len())).unwrap_or(left);
                let ways: Vec<Vec<Change>> =
                    batch.iter().map(|changes| with(&world, changes)).collect();
                // A value that a draw cannot have changes nothing.
                let same = |tried: &World| {
                    tried.fails_like(&world)
                        && tried.record.draws != world.record.draws
                        && is_no_other_kitchen(&world, tried)
                };
                let results = tried(ways);
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
        if world.set == before {
            return (world, runs, true);
        }
        if is_late(runs) {
            return (world, runs, false);
        }
    }
}

/// What is set in a world after a change. A change of the kitchen leaves the names that were drawn: there may be
/// fewer surfaces to draw one from.
fn with(world: &World, (path, value): &Change) -> Vec<Change> {
    let others = world.set.iter().filter(|(known, _)| known != path);
    let mut set: Vec<Change> = others.cloned().collect();
    let is_of_kitchen = world
        .kitchen()
        .is_some_and(|kitchen| below(path, kitchen).is_some());
    if is_of_kitchen {
        for (path, name) in world.names() {
            if !set.iter().any(|(known, _)| known == path) {
                set.push((path.to_owned(), format!("{name:?}")));
            }
        }
    }
    set.push((path.clone(), value.clone()));
    set
}

/// What of a path is below another one.
fn below<'p>(path: &'p str, above: &str) -> Option<&'p str> {
    path.strip_prefix(above)?.strip_prefix('.')
}

/// Whether a world with another kitchen differs from the one before in nothing but what was changed: it is made
/// of the same draws, and the plan is about the same surfaces and types.
fn is_no_other_kitchen(before: &World, tried: &World) -> bool {
    let Some(path) = before.kitchen() else {
        return true;
    };
    let kitchen = |world: &World| {
        let drawn = world.record.draws.iter();
        let drawn = drawn.filter(|(full, _)| below(full, path).is_some());
        drawn
            .map(|(full, drawn)| (full.to_owned(), drawn.clone()))
            .collect::<Vec<_>>()
    };
    if kitchen(before) == kitchen(tried) {
        return true;
    }
    // What changes nothing is no simplification.
    !tried.is_redrawn()
        && before.names() == tried.names()
        && before.record.hash != tried.record.hash
}

/// Changes that make the kitchen simpler, of parameters that are not simple yet.
fn simpler_kitchen(world: &World) -> Vec<Change> {
    let simpler = world.simpler.kitchen.iter();
    simpler
        .map(|(path, drawn)| (path.clone(), written(drawn)))
        .collect()
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
            Drawn::Flag(true) if !path.ends_with(".redrawn") => {
                changes.push((path.to_owned(), "nil".to_owned()));
            }
            _ => {}
        }
    }
    changes
}

/// Changes that give draws their simplest values.
fn simplest(world: &World) -> Vec<Change> {
    let mut changes = Vec::new();
    for (path, simplest) in world.simpler.simplest.iter() {
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

//! The worlds of a sweep, each in a session of its own.

use std::time::Duration;

use crate::Session;
use crate::sweeping::{MAX_POLLS, Simpler};
use sweep::{Ending, Record};

/// Runs worlds of a sweep, each in a session of its own. The file is loaded once, and every world gets a
/// copy of the session in which that was done. A file that leaves something of which there is no copy,
/// such as a task, is loaded for each world.
pub struct Worlds<M> {
    /// The sweep's name.
    name: String,
    seed: u64,
    /// Real time that each may take.
    time_limit: Option<Duration>,
    /// Makes a session in which the file has been loaded, and nothing else done.
    make: M,
    loaded: Loaded,
}

enum Loaded {
    NotYet,
    Copied(Box<Session>),
    ForEach,
}

impl<M: Fn() -> Result<Session, String>> Worlds<M> {
    /// Worlds of the sweep with a name and a seed, of which each may take so much real time. `make` makes
    /// a session in which the sweep's file has been loaded, and nothing else done.
    pub fn new(name: &str, seed: u64, time_limit: Option<Duration>, make: M) -> Worlds<M> {
        Worlds {
            name: name.to_owned(),
            seed,
            time_limit,
            make,
            loaded: Loaded::NotYet,
        }
    }

    /// Runs the plan in a world, in which draws are set as told, and returns what came of it, with
    /// what could be simpler. What a panic ends is a defect.
    pub fn run(&mut self, world: u64, set: &[(String, String)]) -> (Record, Simpler) {
        let run = || match self.next() {
            Ok(mut session) => {
                let (name, seed, limit) = (&self.name, self.seed, self.time_limit);
                let record = session.run_sweep_world(name, seed, world, set, MAX_POLLS, limit);
                (record, session.simpler_draws())
            }
            Err(report) => (defective(world, report), Simpler::default()),
        };
        defect::caught(run).unwrap_or_else(|defect| {
            // Who knows what it has left.
            self.loaded = Loaded::NotYet;
            (defective(world, defect.to_string()), Simpler::default())
        })
    }

    /// Runs the plan in a world and returns what came of it, and what was performed: the names of relations with
    /// their rows, as lines of JSON.
    pub fn run_told(&mut self, world: u64) -> (Record, Vec<(String, String)>) {
        let run = || match self.next() {
            Ok(mut session) => {
                let (name, seed, limit) = (&self.name, self.seed, self.time_limit);
                let record = session.run_sweep_world(name, seed, world, &[], MAX_POLLS, limit);
                (record, session.performed_in(world))
            }
            Err(report) => (defective(world, report), Vec::new()),
        };
        defect::caught(run).unwrap_or_else(|defect| {
            self.loaded = Loaded::NotYet;
            (defective(world, defect.to_string()), Vec::new())
        })
    }

    /// A session in which the file has been loaded, and nothing else done.
    fn next(&mut self) -> Result<Session, String> {
        if let Loaded::NotYet = self.loaded {
            let session = (self.make)()?;
            if session.copied().is_err() {
                self.loaded = Loaded::ForEach;
                return Ok(session);
            }
            self.loaded = Loaded::Copied(Box::new(session));
        }
        if let Loaded::Copied(session) = &self.loaded
            && let Ok(copy) = session.copied()
        {
            return Ok(copy);
        }
        (self.make)()
    }
}

/// What is wrong with the sweep itself, if a record says that.
pub fn mistake(records: &[Record]) -> Option<String> {
    let record = records.iter().find(|r| r.outcome == Ending::Mistake)?;
    Some(format!(
        "{} [in what the sweep varies or injects, world {}]",
        record.cause.clone().unwrap_or_default(),
        record.world
    ))
}

/// The record of a world that planwright could not run.
fn defective(world: u64, cause: String) -> Record {
    let mut record = Record::new(world, Ending::Defect);
    record.cause = Some(cause);
    record
}

//! The worlds of a sweep, each in a session of its own.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use super::file::SweepFile;
use crate::command::failure::CommandError;
use crate::command::open::{open_session, tell_remarks};
use crate::command::options::{LogLevel, Options};
use crate::command::stack::COMPILER_STACK;
use lisp::guard::set_stack_budget;
use robotics::world::Models;
use session::defect;
use session::sweeping::{Known, MAX_POLLS};
use session::{Session, SessionOptions};
use sweep::pairs::Pairs;
use sweep::{Drawn, Ending, Record};

/// The worlds of a sweep.
pub(super) struct Worlds {
    file: SweepFile,
    name: String,
    seed: u64,
    options: SessionOptions,
    /// Files that set each up, before the one with the sweep.
    setup: Vec<PathBuf>,
    /// Real time that each may take.
    time_limit: Option<Duration>,
    /// Shared by all sessions.
    models: Arc<Models>,
}

impl Worlds {
    /// The worlds of the sweep with that name, or of the last one, in a file.
    pub(super) fn open(
        options: &Options,
        file: SweepFile,
        name: Option<&str>,
    ) -> Result<(Self, Known), CommandError> {
        let quiet = Options {
            log_level: LogLevel::None,
            realtime: None,
            ..options.clone()
        };
        let mut session = open_session(&quiet)?;
        tell_remarks(&session, options)?;
        if let Some(abort) = file.load(&mut session) {
            let place = abort
                .main_place()
                .map_or_else(|| file.name.clone(), |place| place.to_string());
            let report = abort.report.trim_end();
            return Err(CommandError::Sweep(format!("{place}: {report}")));
        }
        let sweeps = session.known_sweeps();
        let named = |known: &&Known| name.is_none_or(|name| known.name.eq_ignore_ascii_case(name));
        let Some(known) = sweeps.iter().rfind(named).cloned() else {
            return Err(CommandError::Sweep(missing(&file.name, name, &sweeps)));
        };
        let worlds = Self {
            file,
            name: known.name.clone(),
            seed: options.seed,
            options: session.options().clone(),
            setup: options.setup.clone(),
            time_limit: None,
            models: Arc::clone(session.models()),
        };
        Ok((worlds, known))
    }

    /// The same, each of which may take so much real time (s).
    pub(super) fn within(mut self, seconds: Option<f64>) -> Self {
        self.time_limit = seconds.map(Duration::from_secs_f64);
        self
    }

    /// A function that runs worlds, in the thread that asks for it.
    pub(super) fn runner(&self) -> impl FnMut(u64) -> Record {
        let mut sessions = Sessions::of(self);
        move |world| sessions.run(world, &[]).0
    }

    /// A session in which the file has been loaded.
    fn session(&self) -> Result<Session, String> {
        set_stack_budget(COMPILER_STACK);
        let models = Arc::clone(&self.models);
        let mut session =
            Session::with_models(&self.options, models).map_err(|error| error.to_string())?;
        for file in &self.setup {
            let set_up = session.run_file(file);
            set_up.map_err(|failure| format!("{}: {failure}", file.display()))?;
        }
        session.end_set_up();
        match self.file.load(&mut session) {
            Some(abort) => Err(abort.report),
            None => Ok(session),
        }
    }

    /// Runs the plan in a world and records it in an MCAP file.
    pub(super) fn run_recorded(&self, world: u64, path: &Path) -> Result<(), CommandError> {
        let mut session = self.session().map_err(CommandError::Sweep)?;
        session.begin_recording(path)?;
        let (name, limit) = (&self.name, self.time_limit);
        session.run_sweep_world(name, self.seed, world, &[], MAX_POLLS, limit);
        session.end_recording()?;
        Ok(())
    }
}

/// The sessions of one thread's worlds. The file is loaded once, and every world gets a copy of the
/// session in which that was done. A file that leaves something of which there is no copy, such as a
/// task, is loaded for each world.
pub(super) struct Sessions<'a> {
    worlds: &'a Worlds,
    loaded: Loaded,
}

enum Loaded {
    NotYet,
    Copied(Box<Session>),
    ForEach,
}

impl<'a> Sessions<'a> {
    /// For worlds of a sweep.
    pub(super) fn of(worlds: &'a Worlds) -> Self {
        Self {
            worlds,
            loaded: Loaded::NotYet,
        }
    }

    /// Runs the plan in a world, in which draws are set as told, and returns what came of it, with
    /// the simplest values of the draws. What a panic ends is a defect.
    pub(super) fn run(&mut self, world: u64, set: &[(String, String)]) -> (Record, Pairs<Drawn>) {
        let Worlds { name, seed, .. } = self.worlds;
        let run = || match self.next() {
            Ok(mut session) => {
                let limit = self.worlds.time_limit;
                let record = session.run_sweep_world(name, *seed, world, set, MAX_POLLS, limit);
                (record, session.simplest_draws())
            }
            Err(report) => (defective(world, report), Pairs::default()),
        };
        defect::caught(run).unwrap_or_else(|defect| {
            // Who knows what it has left.
            self.loaded = Loaded::NotYet;
            (defective(world, defect.to_string()), Pairs::default())
        })
    }

    /// A session in which the file has been loaded, and nothing else done.
    fn next(&mut self) -> Result<Session, String> {
        if let Loaded::NotYet = self.loaded {
            let session = self.worlds.session()?;
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
        self.worlds.session()
    }
}

/// The records, unless one says that the sweep itself is wrong.
pub(super) fn sound(records: Vec<Record>) -> Result<Vec<Record>, CommandError> {
    match records.iter().find(|r| r.outcome == Ending::Mistake) {
        Some(record) => Err(CommandError::Sweep(format!(
            "{} [in what the sweep varies or injects, world {}]",
            record.cause.clone().unwrap_or_default(),
            record.world
        ))),
        None => Ok(records),
    }
}

/// The record of a world that planwright could not run.
fn defective(world: u64, cause: String) -> Record {
    let mut record = Record::new(world, Ending::Defect);
    record.cause = Some(cause);
    record
}

fn missing(file: &str, name: Option<&str>, sweeps: &[Known]) -> String {
    let names: Vec<&str> = sweeps.iter().map(|known| known.name.as_str()).collect();
    match (name, names.as_slice()) {
        (_, []) => format!("{file} defines no sweep: (defsweep NAME …) does"),
        (Some(name), _) => match closest_name::closest_name(name, names.iter().copied()) {
            Some(near) => format!("{file} defines no sweep {name}; did you mean {near}?"),
            None => format!(
                "{file} defines no sweep {name}; there are {}",
                names.join(", ")
            ),
        },
        (None, _) => format!("{file} defines no sweep"),
    }
}

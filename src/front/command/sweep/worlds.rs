//! The worlds of a sweep, each in a session of its own.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use crate::command::failure::CommandError;
use crate::command::open::{open_session, tell_remarks};
use crate::command::options::{LogLevel, Options};
use crate::command::stack::COMPILER_STACK;
use lisp::guard::set_stack_budget;
use robotics::world::Models;
use session::sweeping::{self, Known, MAX_POLLS, SweepFile, mistake};
use session::{Session, SessionOptions};
use sweep::Record;

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
        let known = file.find(&mut session, name).map_err(CommandError::Sweep)?;
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
        let mut worlds = self.in_sessions();
        move |world| worlds.run(world, &[]).0
    }

    /// The same, which also tells what was performed.
    pub(super) fn telling_runner(&self) -> impl FnMut(u64) -> (Record, Vec<(String, String)>) {
        let mut worlds = self.in_sessions();
        move |world| worlds.run_told(world)
    }

    /// The same, run in sessions of one thread.
    pub(super) fn in_sessions(&self) -> sweeping::Worlds<impl Fn() -> Result<Session, String>> {
        sweeping::Worlds::new(&self.name, self.seed, self.time_limit, || self.session())
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

/// The records, unless one says that the sweep itself is wrong.
pub(super) fn sound(records: Vec<Record>) -> Result<Vec<Record>, CommandError> {
    match mistake(&records) {
        Some(mistake) => Err(CommandError::Sweep(mistake)),
        None => Ok(records),
    }
}

//! A sweep of which a page runs some worlds: other workers run the others.

use serde_json::{Value, json};
use session::outside::Outside;
use session::sweeping::{SweepFile, Worlds, mistake};
use session::{LogLevel, Session, SessionOptions};
use sweep::Record;
use sweep::summary::{Summary, Title};

/// A sweep.
pub(crate) struct Sweep {
    title: Title,
    worlds: Worlds<Box<dyn Fn() -> Result<Session, String>>>,
}

impl Sweep {
    /// The sweep of a file, and what it says of itself.
    ///
    /// # Errors
    ///
    /// What is wrong with the file, or which sweeps it has.
    pub(crate) fn open(
        outside: &Outside,
        file: SweepFile,
        name: Option<&str>,
        seed: u64,
    ) -> Result<(Sweep, Value), String> {
        let options = SessionOptions {
            seed,
            log_level: LogLevel::None,
            outside: outside.clone(),
            ..SessionOptions::default()
        };
        let fresh = move || Session::new(&options).map_err(|error| error.to_string());
        let known = file.find(&mut fresh()?, name)?;
        let made = move || {
            let mut session = fresh()?;
            session.end_set_up();
            match file.load(&mut session) {
                Some(abort) => Err(abort.report),
                None => Ok(session),
            }
        };
        let sweep = Sweep {
            worlds: Worlds::new(&known.name, seed, None, Box::new(made)),
            title: Title {
                name: known.name.clone(),
                seed,
                goal: known.goal,
            },
        };
        Ok((sweep, json!({"name": known.name, "worlds": known.worlds})))
    }

    /// What comes of a world.
    pub(crate) fn run(&mut self, world: u64) -> Record {
        self.worlds.run(world, &[]).0
    }

    /// What records say together.
    ///
    /// # Errors
    ///
    /// What is wrong with the sweep itself, if a record says that; or with a text.
    pub(crate) fn summary(&self, lines: &[String]) -> Result<String, String> {
        let records = lines.iter().map(|line| serde_json::from_str(line));
        let records: Vec<Record> = records
            .collect::<Result<_, _>>()
            .map_err(|error| format!("a record is malformed: {error}"))?;
        match mistake(&records) {
            Some(mistake) => Err(mistake),
            None => Ok(Summary::new(&self.title, &records).to_string()),
        }
    }
}

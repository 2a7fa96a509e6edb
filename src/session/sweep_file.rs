//! The text that defines a sweep.

use crate::Session;
use crate::dialogue::{Abort, Evaluate, Event, Outcome};
use crate::sweeping::Known;
use closest_name::closest_name;

/// A file that defines a sweep.
#[derive(Clone, Debug)]
pub struct SweepFile {
    /// Its name in places.
    pub name: String,
    /// What it contains.
    pub text: String,
}

impl SweepFile {
    /// Evaluates it in a fresh session; its output is dropped. Returns the condition that ended it, if
    /// one did.
    pub fn load(&self, session: &mut Session) -> Option<Box<Abort>> {
        let mut abort = None;
        let outcome = session.evaluate(&self.name, &self.text, &mut |event| {
            if let Event::Aborted(aborted) = event {
                abort = Some(aborted);
            }
        });
        match outcome {
            Outcome::Aborted | Outcome::Stopped => Some(abort.unwrap_or_default()),
            Outcome::Finished | Outcome::Quit(_) => None,
        }
    }

    /// Loads it into a fresh session, and finds the sweep with that name, or the last one.
    ///
    /// # Errors
    ///
    /// What is wrong with the file, with its place; or which sweeps there are.
    pub fn find(&self, session: &mut Session, name: Option<&str>) -> Result<Known, String> {
        if let Some(abort) = self.load(session) {
            let place = abort
                .main_place()
                .map_or_else(|| self.name.clone(), |place| place.to_string());
            return Err(format!("{place}: {}", abort.report.trim_end()));
        }
        let sweeps = session.known_sweeps();
        let named = |known: &&Known| name.is_none_or(|name| known.name.eq_ignore_ascii_case(name));
        let found = sweeps.iter().rfind(named).cloned();
        found.ok_or_else(|| self.missing(name, &sweeps))
    }

    /// Why there is no sweep of a name.
    fn missing(&self, name: Option<&str>, sweeps: &[Known]) -> String {
        let file = &self.name;
        let names: Vec<&str> = sweeps.iter().map(|known| known.name.as_str()).collect();
        match (name, names.as_slice()) {
            (_, []) => format!("{file} defines no sweep: (defsweep NAME …) does"),
            (Some(name), _) => match closest_name(name, names.iter().copied()) {
                Some(near) => format!("{file} defines no sweep {name}; did you mean {near}?"),
                None => format!(
                    "{file} defines no sweep {name}; there are {}",
                    names.join(", ")
                ),
            },
            (None, _) => format!("{file} defines no sweep"),
        }
    }
}

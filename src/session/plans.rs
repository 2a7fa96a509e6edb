//! The plans that are built in: `plans/lib`, which every session loads, and the demos, which are
//! systems of their own.

use super::{Ended, Session, SessionError};
use crate::lisp::reader::Reader;
use crate::lisp::value::Value;
use crate::lisp::value::known;
use crate::lisp::value::package::PackageTable;

/// Name and text of files of `plans/lib`.
macro_rules! library {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!("../../plans/lib/", $name)))),*]
    };
}

/// The files, in the order in which they are loaded.
const LIBRARY: &[(&str, &str)] = library![
    "log.plan",
    "robot.plan",
    "events.plan",
    "occasions.plan",
    "retrying.plan",
    "locations.plan",
    "noise.plan",
    "sweep-draws.plan",
    "sweep-predicates.plan",
    "sweeps.plan",
    "going.plan",
    "perceiving.plan",
    "gripper.plan",
    "arms.plan",
    "picking-up.plan",
    "placing.plan",
    "containers.plan",
    "navigating.plan",
    "attempts.plan",
    "household.plan",
    "accessing.plan",
    "searching.plan",
    "fetching.plan",
    "delivering.plan",
    "transporting.plan",
    "tutorial-package.plan",
];

/// Name and text of the demos' files, of `plans/demos`.
const DEMOS: &[(&str, &str)] = &[
    (
        "plans/demos/pick-place-demo.plan",
        include_str!("../../plans/demos/pick-place-demo.plan"),
    ),
    (
        "plans/demos/household-demo.plan",
        include_str!("../../plans/demos/household-demo.plan"),
    ),
];

/// CRAM's systems with demos, and the names of the files that they consist of here.
pub(in crate::session) const DEMO_SYSTEMS: &[(&str, &[&str])] = &[
    ("cram_pr2_pick_place_demo", &[DEMOS[0].0, DEMOS[1].0]),
    ("cram_projection_demos", &[DEMOS[0].0, DEMOS[1].0]),
];

/// The text of one of the demos' files.
pub(in crate::session) fn demo_text(name: &str) -> Option<&'static str> {
    let (_, text) = DEMOS.iter().find(|(file, _)| *file == name)?;
    Some(text)
}

impl Session {
    /// Loads the built-in plans. The current package stays the same.
    pub(super) fn load_plans(&mut self) -> Result<(), SessionError> {
        for (name, text) in LIBRARY {
            let failed = |report: String| SessionError::Plan {
                name: (*name).to_owned(),
                report,
            };
            let source = self.image.sources.add(&format!("plans/lib/{name}"), text);
            let mut reader = Reader::new(&self.image, source);
            loop {
                let form = match reader.next_form(&mut self.image) {
                    Ok(Some((form, _))) => form,
                    Ok(None) => break,
                    Err(error) => return Err(failed(error.to_string())),
                };
                if let Ended::Aborted(abort) = self.evaluate_form(&form, &mut |_| {}) {
                    let place = abort.place.map(|p| format!("{p}: ")).unwrap_or_default();
                    return Err(failed(format!("{place}{}", abort.report)));
                }
            }
        }
        let user = Value::Package(PackageTable::USER);
        self.image.set_special(known::V_PACKAGE, user);
        Ok(())
    }
}

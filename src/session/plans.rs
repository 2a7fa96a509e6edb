//! The plans that are built in: `plans/lib`, which every session loads, and the demos, which are
//! systems of their own.

use plan_files::{DEMOS, LIBRARY};

use super::SessionError;
use super::console::{Ended, Evaluator};
use lisp::image::built_in_files::BuiltInFiles;
use lisp::reader::Reader;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::package::PackageTable;

/// CRAM's systems with demos, and the names of the files that they consist of here.
pub(crate) const DEMO_SYSTEMS: &[(&str, &[&str])] = &[
    ("cram_pr2_pick_place_demo", &[DEMOS[0].0, DEMOS[1].0]),
    ("cram_projection_demos", &[DEMOS[0].0, DEMOS[1].0]),
];

/// The text of one of the demos' files.
pub(crate) fn demo_text(name: &str) -> Option<&'static str> {
    let (_, text) = DEMOS.iter().find(|(file, _)| *file == name)?;
    Some(text)
}

/// Loads the built-in plans. The current package stays the same.
pub(super) fn load(evaluator: &mut Evaluator) -> Result<(), SessionError> {
    evaluator.image.extend(BuiltInFiles(plan_files::text_of));
    for (name, text) in LIBRARY {
        let failed = |report: String| SessionError::Plan {
            name: (*name).to_owned(),
            report,
        };
        let source = evaluator
            .image
            .sources
            .add(&format!("plans/lib/{name}"), text);
        let mut reader = Reader::new(&evaluator.image, source);
        loop {
            let form = match reader.next_form(&mut evaluator.image) {
                Ok(Some((form, _))) => form,
                Ok(None) => break,
                Err(error) => return Err(failed(error.to_string())),
            };
            if let Ended::Aborted(abort) = evaluator.evaluate_form(&form, &mut |_| {}) {
                let place = abort.place.map(|p| format!("{p}: ")).unwrap_or_default();
                return Err(failed(format!("{place}{}", abort.report)));
            }
        }
    }
    let user = Value::Package(PackageTable::USER);
    evaluator.image.set_special(known::V_PACKAGE, user);
    Ok(())
}

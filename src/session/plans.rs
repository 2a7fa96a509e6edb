//! The plans that are built in: `plans/lib`, which every session loads, and the demos, which are
//! systems of their own.

use std::rc::Rc;

use plan_files::{DEMOS, LIBRARY};

use super::SessionError;
use super::console::Evaluator;
use super::dialogue::Event;
use super::live_host::LiveHost;
use super::printing;
use cram::Evaluation;
use lisp::Raise;
use lisp::compile::Parts;
use lisp::guard::Stopped;
use lisp::image::Image;
use lisp::image::built_in_files::BuiltInFiles;
use lisp::image::precompiled::{Precompiler, Recording, Unit};
use lisp::reader::Reader;
use lisp::source::SourceId;
use lisp::value::Value;
use lisp::value::code::Code;
use lisp::value::function::Function;
use lisp::value::known;
use lisp::value::package::PackageTable;

/// CRAM's systems with demos, and the names of the files that they consist of here.
pub(crate) const DEMO_SYSTEMS: &[(&str, &[&str])] = &[
    ("cram_pr2_pick_place_demo", &[DEMOS[0].0, DEMOS[1].0]),
    ("cram_projection_demos", &[DEMOS[0].0, DEMOS[1].0]),
];

/// Packages that are there for programs to work in: what the built-in plans define there may be
/// redefined.
pub(crate) const OPEN_PACKAGES: &[&str] = &[
    "COMMON-LISP-USER",
    "CRAM-PICK-PLACE-TUTORIAL",
    "CRAM-BULLET-WORLD-TUTORIAL",
    "CRAM-BEGINNER-TUTORIAL",
    "CRAM-PR2-PICK-PLACE-DEMO",
    "CRAM-PROJECTION-DEMOS",
];

/// The text of one of the demos' files.
pub(crate) fn demo_text(name: &str) -> Option<&'static str> {
    let (_, text) = DEMOS.iter().find(|(file, _)| *file == name)?;
    Some(text)
}

/// Loads the built-in plans. The current package stays the same.
pub(super) fn load(evaluator: &mut Evaluator) -> Result<(), SessionError> {
    evaluator.image.extend(BuiltInFiles(plan_files::text_of));
    let first = evaluator.image.symbols.iter().count();
    for (name, text) in LIBRARY {
        let loaded = load_file(evaluator, &format!("plans/lib/{name}"), text);
        loaded.map_err(|raise| SessionError::Plan {
            name: (*name).to_owned(),
            report: reported(&mut evaluator.image, raise),
        })?;
    }
    match evaluator.image.library.precompiled {
        Some(precompiled) => evaluator.image.settle_precompiled(precompiled),
        None => Precompiler::settle(&mut evaluator.image, first),
    }
    let user = Value::Package(PackageTable::USER);
    evaluator.image.set_special(known::V_PACKAGE, user);
    Ok(())
}

/// Loads a file of built-in plans, from its code that has been made ahead, or from its text.
fn load_file(evaluator: &mut Evaluator, name: &str, text: &'static str) -> Result<(), Box<Raise>> {
    let source = evaluator.image.sources.add_built_in(name, text);
    let precompiled = evaluator.image.library.precompiled;
    let Some((precompiled, forms)) =
        precompiled.and_then(|precompiled| Some((precompiled, precompiled.file(name)?)))
    else {
        let mut reader = Reader::new(&evaluator.image, source);
        while load_form(evaluator, &mut reader, name, source)? {}
        return Ok(());
    };
    for form in forms {
        let Some(mut unit) = Unit::of(precompiled, form, Some(source)) else {
            let mut reader = Reader::new(&evaluator.image, source).at(form.start);
            load_form(evaluator, &mut reader, name, source)?;
            continue;
        };
        while let Some(code) = unit.next(&mut evaluator.image) {
            run(evaluator, code?)?;
        }
    }
    Ok(())
}

/// Reads a form of a file and evaluates it; false at the end of the file.
fn load_form(
    evaluator: &mut Evaluator,
    reader: &mut Reader,
    name: &str,
    source: SourceId,
) -> Result<bool, Box<Raise>> {
    let start = reader.position();
    let read = reader.next_form(&mut evaluator.image);
    let Some((form, _)) = read.map_err(|error| error.raise())? else {
        return Ok(false);
    };
    let mut recording = Recording::of_loaded(source);
    let mut parts = Parts::of(&form);
    while let Some(code) = parts.next(&mut evaluator.image)? {
        recording.add(&mut evaluator.image, &code);
        run(evaluator, code)?;
    }
    recording.finish(&mut evaluator.image, name, start);
    Ok(true)
}

/// What is wrong with a plan, and where.
fn reported(image: &mut Image, raise: Box<Raise>) -> String {
    let abort = printing::raised(image, raise);
    let place = abort.place.map(|p| format!("{p}: ")).unwrap_or_default();
    format!("{place}{}", abort.report)
}

/// Runs a part of a form at top level.
fn run(evaluator: &mut Evaluator, code: Rc<Code>) -> Result<(), Box<Raise>> {
    let function = Value::Function(Rc::new(Function::closure(code, Vec::new())));
    let mut nobody = |_: Event| {};
    let mut host = LiveHost::new(&mut evaluator.host, &mut nobody, false);
    let (image, scheduler) = (&mut evaluator.image, &mut evaluator.scheduler);
    let raise = match scheduler.apply(image, &mut host, function, Vec::new()) {
        Evaluation::Values(_) => return Ok(()),
        Evaluation::Unhandled(condition) => Raise::condition(condition),
        Evaluation::Interrupted => Stopped::Interrupted.into(),
    };
    scheduler.abort(image, &mut host);
    Err(raise)
}

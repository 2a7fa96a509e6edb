//! The plans that are built in: `plans/lib`, which every session loads, and the demos, which are
//! systems of their own.

use std::rc::Rc;

use plan_files::{DEMOS, LIBRARY};

use super::dialogue::Event;
use super::host::SimulationHost;
use super::live_host::LiveHost;
use super::{Session, SessionError};
use cram::{Evaluation, Scheduler};
use lisp::compile::evaluate_each;
use lisp::guard::Stopped;
use lisp::image::Image;
use lisp::image::precompiled::{Precompiler, Recording, Unit};
use lisp::reader::Reader;
use lisp::source::SourceId;
use lisp::value::Value;
use lisp::value::code::Code;
use lisp::value::function::Function;
use lisp::value::known;
use lisp::value::package::PackageTable;
use lisp::value::raise::Raise;

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

impl Session {
    /// Loads the built-in plans. The current package stays the same.
    pub(super) fn load_plans(&mut self) -> Result<(), SessionError> {
        let first = self.image.symbols.len();
        for (name, text) in LIBRARY {
            let loaded = self.load_plan(&format!("plans/lib/{name}"), text);
            loaded.map_err(|raise| SessionError::Plan {
                name: (*name).to_owned(),
                report: self.reported(raise),
            })?;
        }
        match self.image.library.precompiled {
            Some(precompiled) => self.image.settle_precompiled(precompiled),
            None => Precompiler::settle(&mut self.image, first),
        }
        let user = Value::Package(PackageTable::USER);
        self.image.set_special(known::V_PACKAGE, user);
        Ok(())
    }

    /// Loads a file of built-in plans, from its code that has been made ahead, or from its text.
    fn load_plan(&mut self, name: &str, text: &str) -> Result<(), Box<Raise>> {
        let source = self.image.sources.add(name, text);
        let precompiled = self.image.library.precompiled;
        let Some((precompiled, forms)) =
            precompiled.and_then(|precompiled| Some((precompiled, precompiled.file(name)?)))
        else {
            let mut reader = Reader::new(&self.image, source);
            while self.load_form(&mut reader, name, source)? {}
            return Ok(());
        };
        for form in forms {
            let Some(mut unit) = Unit::of(precompiled, form, Some(source)) else {
                let mut reader = Reader::new(&self.image, source).at(form.start);
                self.load_form(&mut reader, name, source)?;
                continue;
            };
            while let Some(code) = unit.next(&mut self.image) {
                run(&mut self.image, &mut self.scheduler, &mut self.host, code?)?;
            }
        }
        Ok(())
    }

    /// Reads a form of a file and evaluates it; false at the end of the file.
    fn load_form(
        &mut self,
        reader: &mut Reader,
        name: &str,
        source: SourceId,
    ) -> Result<bool, Box<Raise>> {
        let start = reader.position();
        let read = reader.next_form(&mut self.image);
        let Some((form, _)) = read.map_err(|error| error.raise())? else {
            return Ok(false);
        };
        let mut recording = Recording::of(Some(source));
        evaluate_each(&mut self.image, &form, &mut |image, code| {
            recording.add(image, &code);
            run(image, &mut self.scheduler, &mut self.host, code)
        })?;
        recording.finish(&mut self.image, name, start);
        Ok(true)
    }

    /// What is wrong with a plan, and where.
    fn reported(&mut self, raise: Box<Raise>) -> String {
        let abort = self.raised(raise);
        let place = abort.place.map(|p| format!("{p}: ")).unwrap_or_default();
        format!("{place}{}", abort.report)
    }
}

/// Runs a part of a form at top level.
fn run(
    image: &mut Image,
    scheduler: &mut Scheduler,
    host: &mut SimulationHost,
    code: Rc<Code>,
) -> Result<(), Box<Raise>> {
    let function = Value::Function(Rc::new(Function::closure(code, Vec::new())));
    let mut nobody = |_: Event| {};
    let mut host = LiveHost::new(host, &mut nobody, false);
    match scheduler.apply(image, &mut host, function, Vec::new()) {
        Evaluation::Values(_) => Ok(()),
        Evaluation::Unhandled(condition) => {
            scheduler.abort(image, &mut host);
            Err(Raise::condition(condition))
        }
        Evaluation::Interrupted => {
            scheduler.abort(image, &mut host);
            Err(Stopped::Interrupted.into())
        }
    }
}

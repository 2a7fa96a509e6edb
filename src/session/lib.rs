//! One session: an image, a world, and what happens when text is evaluated in them.
//!
//! A session takes text and reports events; it prints nothing itself.

mod assist;
mod audience;
mod check;
mod console;
mod converse;
mod copy;
pub mod defect;
pub mod dialogue;
mod face;
pub mod functions;
mod halting;
mod host;
mod illustrate;
mod live_host;
mod log_level;
mod objects;
mod options;
mod package_name;
mod person;
mod plans;
mod printing;
mod queries;
mod record;
mod recovery;
mod serving;
pub mod simulation;
pub mod sweeping;
mod tabulated;
mod text;

use std::path::Path;
use std::rc::Rc;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use crate::dialogue::{Abort, Evaluate, Event, Finding, Outcome};
use cram::{Evaluation, Scheduler};
use host::SimulationHost;
use host::call::HostCall;
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::release::FreesAll;
use live_host::LiveHost;
use package_name::prompt_name;
use robotics::world::Models;
use simulation::Simulation;
use view::picture::ViewError;
use view::picture::animation::Shot;
use view::watch::Cause;

pub use audience::{Audience, Filming, WatchError};
pub use face::{
    Datum, Failure, FramedPose, InterruptHandle, Limit, Limits, ObserverId, PlanEvent,
    PlanEventKind, RestoreError, Snapshot, TaskBegin, TaskEnd, TaskLog, TaskNode, Unhandled,
    Within,
};
pub use log_level::LogLevel;
pub use options::{SessionError, SessionOptions};

/// A session.
pub struct Session {
    /// What it began with.
    options: SessionOptions,
    image: Image,
    scheduler: Scheduler<HostCall>,
    host: SimulationHost,
    /// What the checked texts define.
    checked: check::KnownNames,
    /// Stopped evaluations, and what the user may do with them.
    console: console::Console,
    /// Where the texts define what.
    told_names: assist::ToldNames,
    /// What an editor refers to.
    objects: Rc<objects::Objects>,
    /// The condition that has ended the evaluation of a form last.
    failed_with: Option<Value>,
    /// The last to be dropped: what has been put off is freed.
    _rest: FreesAll,
}

/// How the evaluation of one form ended.
enum Ended {
    Values(Vec<Value>),
    Aborted(Box<Abort>),
    /// It has stopped; only in an interactive session.
    Stopped(Evaluation),
}

impl Session {
    /// A fresh session: the robot at the origin, no objects, package `COMMON-LISP-USER`.
    pub fn new(options: &SessionOptions) -> Result<Session, SessionError> {
        Session::with_models(options, Arc::new(options.models()?))
    }

    /// A fresh session in a kitchen whose descriptions have been read.
    pub fn with_models(
        options: &SessionOptions,
        models: Arc<Models>,
    ) -> Result<Session, SessionError> {
        let mut image = Image::new();
        image.seed(options.seed);
        cram::install(&mut image);
        cram::pose::install(&mut image);
        cram::designator::install(&mut image);
        functions::install(&mut image);
        functions::name_system_folders(&mut image, &options.systems);
        functions::install_topics(&mut image, Arc::clone(&models));
        let mut simulation = Simulation::new(models, options.log_level, options.seed)
            .map_err(|error| SessionError::Models(error.to_string()))?;
        simulation.set_noise(options.noise_levels()?);
        let objects = objects::Objects::of(&mut image);
        let mut session = Session {
            options: options.clone(),
            image,
            scheduler: Scheduler::new(),
            host: SimulationHost::new(
                simulation,
                Audience::new(options.realtime, options.view_port),
            ),
            checked: check::KnownNames::default(),
            console: console::Console::default(),
            told_names: assist::ToldNames::default(),
            objects,
            failed_with: None,
            _rest: FreesAll,
        };
        session.image.limits.heap.set_limit(options.heap);
        session.image.output.set_shown(true);
        session.load_plans()?;
        // Nobody takes the world back to before the built-in plans.
        session.host.person.snapshots = person::Snapshots::default();
        Ok(session)
    }

    /// The examples of everything in the tables, with their names, in order of installation.
    pub fn examples(&self) -> Vec<(String, &'static str)> {
        let image = &self.image;
        let entries = image.entries.iter();
        entries
            .flat_map(|(sym, entry)| {
                let examples = entry.examples().into_iter();
                examples.map(|example| (image.name(*sym).to_owned(), example))
            })
            .collect()
    }

    /// The tables of the language.
    pub fn image(&self) -> &Image {
        &self.image
    }

    /// The Lisp image.
    pub fn image_mut(&mut self) -> &mut Image {
        &mut self.image
    }

    /// What it began with.
    pub fn options(&self) -> &SessionOptions {
        &self.options
    }

    /// The descriptions of robot, kitchen and objects.
    pub fn models(&self) -> &Arc<Models> {
        &self.host.simulation.models
    }

    /// The robot in its world.
    pub fn simulation(&self) -> &Simulation {
        &self.host.simulation
    }

    /// Who answers questions about what is being typed.
    fn assistant(&self) -> assist::Assistant<'_> {
        assist::Assistant::new(&self.image, &self.host.simulation)
    }

    /// The outputs that show the session.
    pub fn audience(&self) -> &Audience {
        &self.host.audience
    }

    /// Sets a function to be called after every step of a motion.
    pub fn set_observer(&mut self, observer: audience::Observer) {
        self.host.audience.set_observer(observer);
    }

    /// Starts to film.
    pub fn start_film(&mut self, wanted: Filming) -> Result<(), ViewError> {
        self.host.audience.start_film(&self.host.simulation, wanted)
    }

    /// Ends the film and returns its shots; the last one shows the present state.
    pub fn end_film(&mut self) -> Vec<Shot> {
        self.host.audience.end_film(&self.host.simulation)
    }

    /// Opens the live view, unless it is open; returns the page's address.
    pub fn open_view(&mut self) -> Result<String, WatchError> {
        let host = &mut self.host;
        host.audience.open_view(&host.simulation, &self.image)
    }

    /// Starts to record the session into an MCAP file.
    pub fn begin_recording(&mut self, path: &Path) -> Result<(), WatchError> {
        let host = &mut self.host;
        host.audience
            .begin_recording(&host.simulation, &self.image, path)
    }

    /// Ends the recording, if there is one; fails if it could not be written.
    pub fn end_recording(&mut self) -> Result<(), WatchError> {
        self.host.audience.end_recording(&self.host.simulation)
    }

    /// Keeps what happens from now on, to be written into a file as a page.
    pub fn keep_run(&mut self, path: &Path) -> Result<(), WatchError> {
        let host = &mut self.host;
        host.audience.keep_run(&host.simulation, &self.image, path)
    }

    /// Writes the page of the run that was to be kept, if there is one.
    pub fn write_kept_run(&mut self) -> Result<(), WatchError> {
        self.host.audience.write_kept_run(&self.host.simulation)
    }

    /// Evaluates an input; a panic ends it, but not the session.
    fn evaluate_or_recover(
        &mut self,
        source_name: &str,
        text: &str,
        sink: &mut dyn FnMut(Event),
    ) -> Outcome {
        self.host
            .begin_bounds(&Limits::NONE, self.image.interrupt());
        let outcome = match defect::caught(|| self.evaluate_input(source_name, text, sink)) {
            Ok(outcome) => outcome,
            Err(defect) => self.recover(&defect, sink),
        };
        self.host.bounds.end();
        outcome
    }

    /// Evaluates an input: one for the inspector, for the debugger, or forms at the top level.
    fn evaluate_input(
        &mut self,
        source_name: &str,
        text: &str,
        sink: &mut dyn FnMut(Event),
    ) -> Outcome {
        if let Some(outcome) = self.inspector_input(text, sink) {
            return outcome;
        }
        if self.console.level() > 0 {
            return self.console_input(source_name, text, sink);
        }
        let asked = self.in_full(source_name, text);
        let text = asked.as_deref().unwrap_or(text);
        self.evaluate_text(source_name, text, sink)
    }

    /// Evaluates one form at top level.
    fn evaluate_form(&mut self, form: &Value, sink: &mut dyn FnMut(Event)) -> Ended {
        self.image.set_special(known::MINUS, form.clone());
        self.host
            .person
            .snapshots
            .begin_form(&self.host.simulation, form);
        let now = self.host.simulation.now();
        self.host.audience.tell_resumed(now);
        let tells_progress = self.console.is_interactive;
        let mut host = LiveHost::new(&mut self.host, sink, tells_progress);
        let evaluation = self.scheduler.evaluate(&mut self.image, &mut host, form);
        let ended = match evaluation {
            Evaluation::Values(values) => Ended::Values(values),
            stopped if self.console.is_interactive => {
                self.flush(sink);
                return Ended::Stopped(stopped);
            }
            Evaluation::Unhandled(condition) => {
                let abort = printing::describe(&mut self.image, &condition);
                self.failed_with = Some(condition);
                self.abort(sink);
                Ended::Aborted(Box::new(abort))
            }
            Evaluation::Interrupted => {
                self.abort(sink);
                Ended::Aborted(Box::new(interrupted()))
            }
        };
        self.flush(sink);
        if let Some(error) = self.host.audience.broken_recording() {
            sink(Event::Output(format!(
                "; The recording has ended: {error}.\n"
            )));
        }
        self.host.audience.show(&self.host.simulation, Cause::Rest);
        self.shift_forms(form);
        if let Ended::Values(values) = &ended {
            self.shift_values(values);
        }
        ended
    }

    /// Unwinds a stopped evaluation, running its cleanup forms.
    fn abort(&mut self, sink: &mut dyn FnMut(Event)) {
        let mut host = LiveHost::new(&mut self.host, sink, self.console.is_interactive);
        self.scheduler.abort(&mut self.image, &mut host);
    }

    /// Reports what was written to standard output.
    fn flush(&mut self, sink: &mut dyn FnMut(Event)) {
        live_host::flush(&mut self.image, &mut self.host, sink);
    }

    /// The name of the current package, or a nickname.
    fn package_name(&self) -> String {
        prompt_name(&self.image, self.image.current_package())
    }

    /// `+`, `++` and `+++`: the forms evaluated last.
    fn shift_forms(&mut self, form: &Value) {
        let image = &mut self.image;
        let (one, two) = (
            image.special(known::PLUS).clone(),
            image.special(known::V_PLUS2).clone(),
        );
        image.set_special(known::V_PLUS3, two);
        image.set_special(known::V_PLUS2, one);
        image.set_special(known::PLUS, form.clone());
    }

    /// `*`, `**`, `***` and `/`, `//`, `///`.
    fn shift_values(&mut self, values: &[Value]) {
        let image = &mut self.image;
        let first = values.first().cloned().unwrap_or(Value::NIL);
        for (names, newest) in [
            ([known::TIMES, known::V_STAR, known::V_STAR3], first),
            (
                [known::DIVIDE, known::V_SLASH2, known::V_SLASH3],
                Value::list(values.to_vec()),
            ),
        ] {
            let one = image.special(names[0]).clone();
            let two = image.special(names[1]).clone();
            image.set_special(names[2], two);
            image.set_special(names[1], one);
            image.set_special(names[0], newest);
        }
    }
}

fn interrupted() -> Abort {
    Abort {
        report: "Interrupted.".to_owned(),
        condition: dialogue::screen::INTERRUPT.to_owned(),
        ..Abort::default()
    }
}

impl Evaluate for Session {
    fn evaluate(&mut self, source_name: &str, text: &str, sink: &mut dyn FnMut(Event)) -> Outcome {
        self.image.polls().begin(self.console.interrupt_next.take());
        // A user who asked to leave and then continues has changed their mind.
        self.host.person.quit = None;
        let was_stopped = self.console.level() > 0;
        if text.trim().is_empty() {
            // It only shows a stopped evaluation again.
            let outcome = self.evaluate_or_recover(source_name, text, sink);
            self.tell_halt(was_stopped, None);
            return outcome;
        }
        let record = self.image.extension::<record::Record>();
        let record = record.unwrap_or_else(|| self.image.extend(record::Record::default()));
        record.begin(self.prompt(), source_name, text);
        let mut aborted = None;
        let outcome = self.evaluate_or_recover(source_name, text, &mut |event| {
            record.note(&event);
            aborted = halting::end_of(&event).or(aborted.take());
            sink(event);
        });
        self.tell_halt(was_stopped, aborted);
        record.end(outcome, self.image.polls().seen_at());
        outcome
    }

    fn check(&mut self, source_name: &str, text: &str) -> Vec<Finding> {
        check::check_text(&mut self.image, &mut self.checked, source_name, text)
    }

    fn prompt(&self) -> String {
        self.package_name() + &self.console.prompt_suffix()
    }

    fn interrupt_handle(&self) -> Arc<AtomicBool> {
        Arc::clone(self.image.interrupt())
    }
}

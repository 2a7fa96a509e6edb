//! Evaluating inputs.

use std::rc::Rc;
use std::time::Duration;

use super::halt;
use super::line_breaks;
use super::other_syntax;
use super::stopped::Console;
use crate::bounds::Limits;
use crate::dialogue::screen::INTERRUPT;
use crate::dialogue::{Abort, Event, Outcome};
use crate::facts;
use crate::host::SimulationHost;
use crate::host::call::HostCall;
use crate::live_host;
use crate::live_host::LiveHost;
use crate::objects::Objects;
use crate::package_name::prompt_name;
use crate::printing;
use crate::record;
use cram::{Evaluation, Scheduler};
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::known;
use view::watch::Cause;

/// Evaluates inputs in an image and a world, and keeps those evaluations that have stopped.
pub(crate) struct Evaluator {
    pub(crate) image: Image,
    pub(crate) scheduler: Scheduler<HostCall>,
    pub(crate) host: SimulationHost,
    /// Stopped evaluations, and what the user may do with them.
    pub(crate) console: Console,
    /// What an editor refers to.
    pub(crate) objects: Rc<Objects>,
    /// The condition that has ended the evaluation of a form last.
    pub(crate) failed_with: Option<Value>,
    /// When inputs have to have ended, by the session's clock.
    pub(crate) deadline: Option<Duration>,
}

/// How the evaluation of one form ended.
pub(crate) enum Ended {
    Values(Vec<Value>),
    Aborted(Box<Abort>),
    /// It has stopped; only in an interactive session.
    Stopped(Evaluation),
}

impl Evaluator {
    pub(crate) fn new(
        mut image: Image,
        scheduler: Scheduler<HostCall>,
        host: SimulationHost,
    ) -> Self {
        let objects = Objects::of(&mut image);
        Self {
            image,
            scheduler,
            host,
            console: Console::default(),
            objects,
            failed_with: None,
            deadline: None,
        }
    }

    /// Notes the source that is evaluated from now on: files that it names are beside it, if it is one.
    pub(crate) fn begin_source(&mut self, source_name: &str) {
        let is_file = self.image.files.facts(source_name).is_ok();
        self.host.simulation.meshes.source = match is_file {
            true => source_name.to_owned(),
            false => String::new(),
        };
    }

    /// Evaluates an input.
    pub(crate) fn evaluate(
        &mut self,
        source_name: &str,
        text: &str,
        sink: &mut dyn FnMut(Event),
    ) -> Outcome {
        self.image.polls().begin(self.console.interrupt_next.take());
        // A user who asked to leave and then continues has changed their mind.
        self.host.person.quit = None;
        self.begin_source(source_name);
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
        let mut class = String::new();
        let outcome = self.evaluate_or_recover(source_name, text, &mut |event| {
            record.note(&event);
            match &event {
                Event::Aborted(abort) => class.clone_from(&abort.class),
                Event::Stopped(stop) => class.clone_from(&stop.abort.class),
                _ => {}
            }
            aborted = halt::end_of(&event).or(aborted.take());
            sink(event);
        });
        self.tell_halt(was_stopped, aborted);
        let ended = (outcome == Outcome::Aborted).then_some(class.as_str());
        self.look_at_lesson(ended, &mut |event| {
            record.note(&event);
            sink(event);
        });
        record.end(outcome, self.image.polls().seen_at());
        let word = match outcome {
            Outcome::Finished => "finished",
            Outcome::Aborted => "aborted",
            Outcome::Stopped => "stopped",
            Outcome::Quit(_) => "left",
        };
        self.console.last_ending = format!("{word} {class}").trim_end().to_owned();
        outcome
    }

    /// What the prompt shows.
    pub(crate) fn prompt(&self) -> String {
        self.package_name() + &self.console.prompt_suffix()
    }

    /// Evaluates an input; a panic ends it, but not the session.
    fn evaluate_or_recover(
        &mut self,
        source_name: &str,
        text: &str,
        sink: &mut dyn FnMut(Event),
    ) -> Outcome {
        let clock = &self.host.audience.outside().clock;
        let left = |deadline: Duration| deadline.saturating_sub(clock.now());
        let limits = Limits {
            wall_clock: self.deadline.map(left),
            ..Limits::NONE
        };
        self.host.begin_bounds(&limits, self.image.interrupt());
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
        let mended = line_breaks::restored(source_name, text, sink);
        let text = mended.as_deref().unwrap_or(text);
        if self.console.level() > 0 {
            return self.console_input(source_name, text, sink);
        }
        let asked = self.in_full(source_name, text);
        if asked.is_none() {
            other_syntax::tell(source_name, text, sink);
        }
        let text = asked.as_deref().unwrap_or(text);
        self.evaluate_text(source_name, text, sink)
    }

    /// Evaluates one form at top level.
    pub(crate) fn evaluate_form(&mut self, form: &Value, sink: &mut dyn FnMut(Event)) -> Ended {
        self.image.set_special(known::MINUS, form.clone());
        facts::follow(&mut self.image, &self.host.simulation.models);
        self.host.person.begin_form(&self.host.simulation, form);
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
                let reached = self.host.bounds.reached();
                let place = self.place_of_program();
                self.abort(sink);
                let mut abort = Abort {
                    place,
                    ..interrupted()
                };
                if let Some(limit) = reached {
                    abort.report = format!("Interrupted: {limit} has been reached.");
                }
                Ended::Aborted(Box::new(abort))
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
    pub(crate) fn abort(&mut self, sink: &mut dyn FnMut(Event)) {
        let mut host = LiveHost::new(&mut self.host, sink, self.console.is_interactive);
        self.scheduler.abort(&mut self.image, &mut host);
    }

    /// Reports what was written to standard output.
    pub(super) fn flush(&mut self, sink: &mut dyn FnMut(Event)) {
        live_host::flush(&mut self.image, &mut self.host, sink);
    }

    /// The name of the current package, or a nickname.
    pub(crate) fn package_name(&self) -> String {
        prompt_name(&self.image, self.image.current_package())
    }

    /// `+`, `++` and `+++`: the forms evaluated last.
    pub(super) fn shift_forms(&mut self, form: &Value) {
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
    pub(super) fn shift_values(&mut self, values: &[Value]) {
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

/// What is shown for an interrupt.
pub(super) fn interrupted() -> Abort {
    Abort {
        report: "Interrupted.".to_owned(),
        condition: INTERRUPT.to_owned(),
        ..Abort::default()
    }
}

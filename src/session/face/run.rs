//! Evaluating texts, files and calls, with values as data.

use std::path::Path;

use super::{Datum, Failure, Unhandled, from_value, into_value, names};
use crate::Session;
use crate::bounds::{InterruptHandle, Limit, Limits};
use crate::console::{Ended, end_of, recovery};
use crate::dialogue::screen::INTERRUPT;
use crate::dialogue::{Abort, Event, Outcome};
use lisp::files::utf8;
use lisp::reader::Reader;
use lisp::value::Value;
use lisp::value::known;

/// Share of the looks after which cleaning up is ended, too.
const CLEANING: u64 = 10;

/// A session with limits for what it evaluates. See [`Session::within`].
pub struct Within<'s> {
    session: &'s mut Session,
    limits: Limits,
}

impl Within<'_> {
    /// As [`Session::run`].
    pub fn run(&mut self, source_name: &str, text: &str) -> Result<Vec<Datum>, Failure> {
        self.session.evaluate_within(&self.limits, |session, sink| {
            session.evaluate_forms(source_name, text, sink)
        })
    }

    /// As [`Session::run_file`].
    pub fn run_file(&mut self, path: impl AsRef<Path>) -> Result<Vec<Datum>, Failure> {
        let path = path.as_ref();
        let name = path.to_string_lossy();
        let bytes = self.session.options.outside.files.read_plan(&name);
        let text = bytes.and_then(utf8);
        let text = text.map_err(|error| Failure::Unreadable {
            path: path.to_owned(),
            reason: error.to_string(),
        })?;
        self.run(&name, &text)
    }

    /// As [`Session::call`].
    pub fn call(&mut self, function: &str, arguments: &[Datum]) -> Result<Vec<Datum>, Failure> {
        let session = &mut *self.session;
        let function = names::known_symbol(&session.evaluator.image, function)?;
        let mut form = vec![Value::from(function)];
        for argument in arguments {
            let value = session.value_of(argument)?;
            form.push(Value::list([known::QUOTE.into(), value]));
        }
        let form = Value::list(form);
        session.evaluate_within(&self.limits, |session, sink| {
            session.evaluate_one(&form, sink)
        })
    }
}

impl Session {
    /// The session with limits for what it evaluates next:
    /// `session.within(limits).run_file("submission.plan")`.
    pub fn within(&mut self, limits: Limits) -> Within<'_> {
        Within {
            session: self,
            limits,
        }
    }

    /// Evaluates all forms of a text; returns the values of the last one. `source_name` stands for
    /// the file in places.
    ///
    /// Unlike [`Evaluate::evaluate`](crate::dialogue::Evaluate::evaluate), it prints no values and
    /// keeps no transcript. What the program prints goes to the observers
    /// ([`Session::on_event`]).
    pub fn run(&mut self, source_name: &str, text: &str) -> Result<Vec<Datum>, Failure> {
        self.within(Limits::NONE).run(source_name, text)
    }

    /// Evaluates all forms of a file; returns the values of the last one.
    pub fn run_file(&mut self, path: impl AsRef<Path>) -> Result<Vec<Datum>, Failure> {
        self.within(Limits::NONE).run_file(path)
    }

    /// Calls a function, `package:name` or a name that the current package knows, in any case;
    /// returns its values. The arguments are data and are not evaluated. Nothing is read or printed.
    pub fn call(&mut self, function: &str, arguments: &[Datum]) -> Result<Vec<Datum>, Failure> {
        self.within(Limits::NONE).call(function, arguments)
    }

    /// The value of a variable, `package:name` or a name that the current package knows; `None` if it
    /// has none.
    pub fn get(&self, variable: &str) -> Option<Datum> {
        let sym = names::known_symbol(&self.evaluator.image, variable).ok()?;
        let value = self.evaluator.image.special(sym);
        (!value.is_unbound()).then(|| from_value::datum(&self.evaluator.image, value))
    }

    /// Sets the value of a variable, as `set` does: one that the program has not defined is a
    /// special variable from then on, a constant is an error.
    pub fn set(&mut self, variable: &str, value: &Datum) -> Result<(), Failure> {
        let sym = names::symbol(&mut self.evaluator.image, variable)?;
        let value = self.value_of(value)?;
        let [variable, value] =
            [sym.into(), value].map(|part| Value::list([known::QUOTE.into(), part]));
        let form = Value::list([known::SET.into(), variable, value]);
        self.evaluate_within(&Limits::NONE, |session, sink| {
            session.evaluate_one(&form, sink)
        })?;
        Ok(())
    }

    /// Interrupts what this session evaluates, from any thread.
    pub fn interrupter(&self) -> InterruptHandle {
        self.evaluator.host.bounds.handle()
    }

    fn value_of(&mut self, datum: &Datum) -> Result<Value, Failure> {
        into_value::value(
            &mut self.evaluator.image,
            &self.evaluator.host.simulation,
            datum,
        )
    }

    /// Evaluates something within limits.
    fn evaluate_within(
        &mut self,
        limits: &Limits,
        work: impl FnOnce(&mut Session, &mut dyn FnMut(Event)) -> (Outcome, Vec<Value>),
    ) -> Result<Vec<Datum>, Failure> {
        self.evaluator.host.person.quit = None;
        self.evaluator.failed_with = None;
        self.ended_at = None;
        let polls = self.evaluator.image.polls();
        polls.begin(limits.looks);
        polls.set_again(limits.looks.map(|looks| (looks / CLEANING).max(1)));
        let flag = self.evaluator.image.interrupt();
        self.evaluator.host.begin_bounds(limits, flag);
        let (mut aborted, mut halt) = (None, None);
        let mut sink = |event| {
            halt = end_of(&event).or(halt.take());
            if let Event::Aborted(abort) = event {
                aborted = Some(*abort);
            }
        };
        let (outcome, values) = match defect::caught(|| {
            let (outcome, values) = work(self, &mut sink);
            (outcome, from_value::data(&self.evaluator.image, &values))
        }) {
            Ok(done) => done,
            Err(defect) => (self.evaluator.recover(&defect, &mut sink), Vec::new()),
        };
        let reached = self.evaluator.host.bounds.end();
        let polls = self.evaluator.image.polls();
        let has_looked = limits.looks.is_some() && polls.seen_at() == limits.looks;
        let reached = reached.or(has_looked.then_some(Limit::Looks));
        polls.set_again(None);
        polls.begin(None);
        self.evaluator.tell_halt(false, halt);
        let condition = self.evaluator.failed_with.take();
        match (outcome, aborted) {
            (Outcome::Quit(status), _) => Err(Failure::Quit(status)),
            (Outcome::Finished, _) => Ok(values),
            (_, None) => Err(Failure::Interrupted),
            (_, Some(abort)) => Err(match abort.condition.as_str() {
                INTERRUPT => {
                    self.ended_at = abort.main_place().cloned();
                    reached.map_or(Failure::Interrupted, Failure::LimitReached)
                }
                recovery::CONDITION => Failure::Defect(abort.report),
                _ => Failure::Unhandled(Box::new(Unhandled::of(
                    &self.evaluator.image,
                    abort,
                    condition.as_ref(),
                ))),
            }),
        }
    }

    /// Evaluates all forms of a text; returns the values of the last one.
    fn evaluate_forms(
        &mut self,
        source_name: &str,
        text: &str,
        sink: &mut dyn FnMut(Event),
    ) -> (Outcome, Vec<Value>) {
        self.evaluator.begin_source(source_name);
        let source = self.evaluator.image.sources.add(source_name, text);
        let mut rest = Reader::new(&self.evaluator.image, source);
        let mut last = Vec::new();
        loop {
            match self.evaluator.read_placed(&mut rest) {
                Ok(Some((form, place))) => {
                    let place = self.evaluator.image.sources.locate(place);
                    // What has no place of its own is somewhere in the form.
                    let mut sink = |event| {
                        sink(match event {
                            Event::Aborted(abort) => Event::Aborted(Box::new(Abort {
                                place: abort.place.clone().or_else(|| place.clone()),
                                ..*abort
                            })),
                            event => event,
                        });
                    };
                    match self.evaluate_one(&form, &mut sink) {
                        (Outcome::Finished, values) => last = values,
                        ended => return ended,
                    }
                }
                Ok(None) => return (Outcome::Finished, last),
                Err(abort) => {
                    sink(Event::Aborted(abort));
                    return (Outcome::Aborted, Vec::new());
                }
            }
        }
    }

    /// Evaluates a form.
    fn evaluate_one(&mut self, form: &Value, sink: &mut dyn FnMut(Event)) -> (Outcome, Vec<Value>) {
        let values = match self.evaluator.evaluate_form(form, sink) {
            Ended::Values(values) => values,
            Ended::Aborted(abort) => {
                sink(Event::Aborted(abort));
                return (Outcome::Aborted, Vec::new());
            }
            // Only in a session with a prompt.
            Ended::Stopped(_) => {
                self.evaluator.abort(sink);
                return (Outcome::Stopped, Vec::new());
            }
        };
        match self.evaluator.host.person.quit {
            Some(status) => (Outcome::Quit(status), Vec::new()),
            None => (Outcome::Finished, values),
        }
    }
}

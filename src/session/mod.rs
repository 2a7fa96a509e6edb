//! One session: an image, and what happens when text is evaluated in it.
//!
//! A session takes text and tells events; it prints nothing itself.

mod printing;
mod text;

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use crate::dialogue::{Abort, Evaluate, Event, Finding, Outcome};
use crate::lisp::image::Image;
use crate::lisp::known;
use crate::lisp::package::PackageTable;
use crate::lisp::raise::Raise;
use crate::lisp::value::Value;
use crate::lisp::vm::fiber::Fiber;
use crate::lisp::vm::machine::{self, Machine};

/// A session.
pub struct Session {
    image: Image,
}

/// How the evaluation of one form ended.
enum Ended {
    Values(Vec<Value>),
    Aborted(Box<Abort>),
}

impl Session {
    /// A fresh session.
    pub fn new() -> Session {
        Session {
            image: Image::new(),
        }
    }

    /// Bytes of the Rust stack that the compiler may use: a thread with a large stack can
    /// compile forms that are nested more deeply.
    pub fn set_stack_budget(&mut self, bytes: usize) {
        self.image.stack_budget = bytes;
    }

    /// Evaluates one form at top level.
    fn evaluate_form(&mut self, form: &Value, sink: &mut dyn FnMut(Event)) -> Ended {
        self.image.set_special(known::MINUS, form.clone());
        let mut fiber = Fiber::default();
        let mut machine = Machine::new(&mut self.image, &mut fiber);
        let event = machine.start(known::EVAL.into(), vec![form.clone()]);
        let ended = match event {
            machine::Event::Done(value) => Ended::Values(value.into_values()),
            machine::Event::Unhandled(condition) => {
                let abort = self.describe(&condition);
                Machine::new(&mut self.image, &mut fiber).unwind_all();
                Ended::Aborted(Box::new(abort))
            }
            machine::Event::Interrupted => {
                machine.unwind_all();
                Ended::Aborted(Box::new(interrupted()))
            }
            machine::Event::Request(_) => {
                machine.unwind_all();
                Ended::Aborted(Box::new(
                    self.raised(Raise::control("Nothing to wait for.")),
                ))
            }
            machine::Event::Unwound => Ended::Values(Vec::new()),
        };
        self.flush(sink);
        self.shift_forms(form);
        if let Ended::Values(values) = &ended {
            self.shift_values(values);
        }
        ended
    }

    /// Tells what was written to standard output.
    fn flush(&mut self, sink: &mut dyn FnMut(Event)) {
        let text = self.image.output.take();
        if !text.is_empty() {
            sink(Event::Output(text));
        }
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

impl Default for Session {
    fn default() -> Session {
        Session::new()
    }
}

fn interrupted() -> Abort {
    Abort {
        report: "Interrupted.".to_owned(),
        condition: "#<INTERACTIVE-INTERRUPT>".to_owned(),
        place: None,
    }
}

impl Evaluate for Session {
    fn evaluate(&mut self, source_name: &str, text: &str, sink: &mut dyn FnMut(Event)) -> Outcome {
        self.evaluate_text(source_name, text, sink)
    }

    fn check(&mut self, _: &str, _: &str) -> Vec<Finding> {
        Vec::new()
    }

    fn prompt(&self) -> String {
        let package = self.image.current_package();
        if package == PackageTable::USER {
            return "CL-USER".to_owned();
        }
        let package = self.image.packages.get(package);
        std::iter::once(&package.name)
            .chain(&package.nicknames)
            .min_by_key(|name| name.chars().count())
            .map_or_else(String::new, |name| name.to_string())
    }

    fn interrupt_handle(&self) -> Arc<AtomicBool> {
        self.image.interrupt.clone()
    }
}

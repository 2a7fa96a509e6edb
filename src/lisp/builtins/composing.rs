//! Texts that depend on Lisp code: objects that a program prints itself, functions that
//! format calls. Such a text is composed purely as often as needed, until all calls that
//! it depends on have been made.

use std::collections::VecDeque;
use std::rc::Rc;

use crate::lisp::image::Image;
use crate::lisp::print::{Call, Calls};
use crate::lisp::stream::Stream;
use crate::lisp::value::Value;
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;
use crate::lisp::vm::fiber::Dynamic;
use crate::lisp::vm::machine::Machine;
use crate::lisp::vm::step::{Resume, Step};

/// Composes the text, taking the texts of calls and noting those that are missing.
pub(super) type Compose = Box<dyn Fn(&Image, &mut Calls) -> Result<String, Box<Raise>>>;

/// Does something with the text.
pub(super) type Finish = Box<dyn FnOnce(&mut Machine<'_>, String) -> Result<Step, Box<Raise>>>;

/// Composes a text and hands it on, after the calls that it needs.
pub(super) fn compose(
    machine: &mut Machine<'_>,
    name: &'static str,
    compose: impl Fn(&Image, &mut Calls) -> Result<String, Box<Raise>> + 'static,
    finish: impl FnOnce(&mut Machine<'_>, String) -> Result<Step, Box<Raise>> + 'static,
) -> Result<Step, Box<Raise>> {
    let mut calls = Calls::with_texts([]);
    let text = compose(machine.image, &mut calls)?;
    let needed = calls.into_needed();
    if needed.is_empty() {
        return finish(machine, text);
    }
    let composing = Composing {
        name,
        compose: Box::new(compose),
        finish: Box::new(finish),
        needed: needed.into(),
        texts: Vec::new(),
        stream: Rc::new(Stream::to_text()),
        is_escape_bound: false,
    };
    Box::new(composing).step(machine)
}

struct Composing {
    name: &'static str,
    compose: Compose,
    finish: Finish,
    /// Calls still to be made.
    needed: VecDeque<Call>,
    /// Texts of those made.
    texts: Vec<String>,
    /// Where the running call writes.
    stream: Rc<Stream>,
    is_escape_bound: bool,
}

impl Composing {
    fn step(mut self: Box<Self>, machine: &mut Machine<'_>) -> Result<Step, Box<Raise>> {
        loop {
            if let Some(call) = self.needed.pop_front() {
                self.stream = Rc::new(Stream::to_text());
                if let Some(escape) = call.escape {
                    bind_escape(machine, escape);
                    self.is_escape_bound = true;
                }
                let mut args = call.before;
                args.push(Value::Stream(self.stream.clone()));
                args.extend(call.after);
                return Ok(Step::Call {
                    function: call.function,
                    args,
                    then: self,
                });
            }
            let mut calls = Calls::with_texts(self.texts.iter().cloned());
            let text = (self.compose)(machine.image, &mut calls)?;
            // The calls may have changed what there is to print.
            self.needed = calls.into_needed().into();
            if self.needed.is_empty() {
                return (self.finish)(machine, text);
            }
        }
    }
}

impl Resume for Composing {
    fn resume(
        mut self: Box<Self>,
        machine: &mut Machine<'_>,
        _: Value,
    ) -> Result<Step, Box<Raise>> {
        if std::mem::take(&mut self.is_escape_bound) {
            unbind_escape(machine);
        }
        self.texts.push(self.stream.take_text().unwrap_or_default());
        self.step(machine)
    }

    fn name(&self) -> &'static str {
        self.name
    }
}

/// Binds `*print-escape*` until the call returns. If the call is left otherwise, the
/// machine undoes the binding.
fn bind_escape(machine: &mut Machine<'_>, escape: bool) {
    let place = &mut machine.image.symbols.get_mut(known::V_PRINT_ESCAPE).value;
    let outside = std::mem::replace(place, Value::bool(escape));
    let binding = Dynamic::Bind(known::V_PRINT_ESCAPE, outside);
    machine.fiber.dynamic.push(binding);
}

fn unbind_escape(machine: &mut Machine<'_>) {
    if let Some(Dynamic::Bind(sym, outside)) = machine.fiber.dynamic.pop() {
        machine.image.symbols.get_mut(sym).value = outside;
    }
}

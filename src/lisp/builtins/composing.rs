//! Texts that depend on Lisp code: objects that a program prints itself, functions that `format`
//! calls. Such a text is composed, purely, as often as needed until all calls that it depends on
//! have been made.

use std::rc::Rc;

use crate::image::Image;
use crate::print::{self, Call};
use crate::stream::Stream;
use crate::types::{TypeCheck, typep};
use crate::value::Value;
use crate::value::document::Document;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;
use crate::vm::calls::{Calls, run};
use crate::vm::fiber::Dynamic;
use crate::vm::machine::Machine;
use crate::vm::step::Step;

/// Composes a text, making the calls that it needs, and passes it on. `compose` receives the texts
/// of calls and records those that are missing.
pub(super) fn compose<Text: 'static>(
    machine: &mut Machine<'_>,
    name: &'static str,
    compose: impl Fn(&Image, &mut print::Calls) -> Result<Text, Box<Raise>> + 'static,
    finish: impl FnOnce(&mut Machine<'_>, Text) -> Result<Step, Box<Raise>> + 'static,
) -> Result<Step, Box<Raise>> {
    let mut texts = print::Calls::with_texts([], has_type);
    let text = compose(machine.image, &mut texts)?;
    texts.readable()?;
    let mut needed = texts.into_needed();
    if needed.is_empty() {
        return finish(machine, text);
    }
    run(machine, name, |calls| async move {
        let compose = Rc::new(compose);
        let mut texts = Vec::new();
        loop {
            for call in needed {
                texts.push(text_of(&calls, call).await);
            }
            let (compose, known) = (compose.clone(), texts.clone());
            let composed = calls.with(move |machine| {
                let mut texts = print::Calls::with_texts(known, has_type);
                let text = compose(machine.image, &mut texts)?;
                texts.readable()?;
                Ok::<_, Box<Raise>>((text, texts.into_needed()))
            });
            let text;
            (text, needed) = composed.await?;
            // The calls may have changed what there is to print.
            if needed.is_empty() {
                return calls.with(|machine| finish(machine, text)).await;
            }
        }
    })
}

/// Is the value of the type? What is no type does not match; none if a call decides.
fn has_type(image: &Image, value: &Value, specifier: &Value) -> Option<bool> {
    match typep(image, value, specifier) {
        Ok(TypeCheck::NeedsCall) => None,
        answer => Some(matches!(answer, Ok(TypeCheck::Yes))),
    }
}

/// Makes a call; returns the text that it writes.
async fn text_of(calls: &Calls, call: Call) -> Document {
    let stream = Rc::new(Stream::to_document(call.is_pretty, 0));
    let bound = call.bindings.len();
    let bindings = call.bindings;
    calls.with(move |machine| bind(machine, bindings)).await;
    let mut args = call.before;
    args.push(Value::Stream(stream.clone()));
    args.extend(call.after);
    calls.call_in_frame(&call.function, args).await;
    calls.with(move |machine| unbind(machine, bound)).await;
    stream
        .take_document()
        .unwrap_or_else(|| Document::new(false))
}

/// Binds variables until the call returns. If the call is left by a non-local exit, the machine
/// undoes the bindings.
fn bind(machine: &mut Machine<'_>, bindings: Vec<(Sym, Value)>) {
    for (sym, value) in bindings {
        let place = &mut machine.image.symbols.get_mut(sym).value;
        let outside = std::mem::replace(place, value);
        machine.fiber.dynamic.push(Dynamic::Bind(sym, outside));
    }
}

fn unbind(machine: &mut Machine<'_>, count: usize) {
    for _ in 0..count {
        if let Some(Dynamic::Bind(sym, outside)) = machine.fiber.dynamic.pop() {
            machine.image.symbols.get_mut(sym).value = outside;
        }
    }
}

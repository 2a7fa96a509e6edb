//! Texts that depend on Lisp code: objects that a program prints itself, functions that `format`
//! calls. Such a text is composed, purely, as often as needed until all calls that it depends on
//! have been made.

use std::rc::Rc;

use crate::lisp::image::Image;
use crate::lisp::print::{self, Call};
use crate::lisp::stream::Stream;
use crate::lisp::value::Value;
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;
use crate::lisp::vm::calls::{Calls, run};
use crate::lisp::vm::fiber::Dynamic;
use crate::lisp::vm::machine::Machine;
use crate::lisp::vm::step::Step;

/// Composes a text, making the calls that it needs, and passes it on. `compose` receives the texts
/// of calls and records those that are missing.
pub(super) fn compose(
    machine: &mut Machine<'_>,
    name: &'static str,
    compose: impl Fn(&Image, &mut print::Calls) -> Result<String, Box<Raise>> + 'static,
    finish: impl FnOnce(&mut Machine<'_>, String) -> Result<Step, Box<Raise>> + 'static,
) -> Result<Step, Box<Raise>> {
    let mut texts = print::Calls::with_texts([]);
    let text = compose(machine.image, &mut texts)?;
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
                let mut texts = print::Calls::with_texts(known);
                let text = compose(machine.image, &mut texts)?;
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

/// Makes a call; returns the text that it writes.
async fn text_of(calls: &Calls, call: Call) -> String {
    let stream = Rc::new(Stream::to_text());
    if let Some(escape) = call.escape {
        calls
            .with(move |machine| bind_escape(machine, escape))
            .await;
    }
    let mut args = call.before;
    args.push(Value::Stream(stream.clone()));
    args.extend(call.after);
    calls.call_in_frame(&call.function, args).await;
    if call.escape.is_some() {
        calls.with(unbind_escape).await;
    }
    stream.take_text().unwrap_or_default()
}

/// Binds `*print-escape*` until the call returns. If the call is left by a non-local exit, the
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

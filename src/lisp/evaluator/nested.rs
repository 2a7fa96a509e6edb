//! Calls outside any plan, such as those of macro functions, which run to completion and cannot
//! wait.

use crate::guard::Stopped;
use crate::image::Image;
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;
use crate::vm::fiber::Fiber;
use crate::vm::machine::{Event, Machine};

/// The deepest nesting of macro function runs.
const MAX_NESTED: usize = 64;

/// Calls a function and runs it to completion; returns the primary value.
pub fn call_nested(
    image: &mut Image,
    function: Value,
    args: Vec<Value>,
) -> Result<Value, Box<Raise>> {
    run_nested(image, function, args).map(Value::primary)
}

/// Like [`call_nested`], but returns all values.
pub(crate) fn call_nested_values(
    image: &mut Image,
    function: Value,
    args: Vec<Value>,
) -> Result<Vec<Value>, Box<Raise>> {
    run_nested(image, function, args).map(Value::into_values)
}

fn run_nested(image: &mut Image, function: Value, args: Vec<Value>) -> Result<Value, Box<Raise>> {
    if image.nesting >= MAX_NESTED {
        return Err(Raise::new(
            known::CONTROL_STACK_EXHAUSTED,
            "Macro expansion is nested too deeply. Does a macro expand into itself?",
        ));
    }
    // A macro that expands into itself makes many short calls.
    if let Some(reason) = image.limits.patient_reason() {
        return Err(reason.into());
    }
    image.nesting += 1;
    // What a macro function compiles is not part of the program that is noted.
    let notes = image.notes.take();
    // Nobody can show what is written before the call has ended.
    let was_shown = image.output.set_shown(false);
    let mut fiber = Fiber::default();
    let mut machine = Machine::new(image, &mut fiber);
    let mut event = machine.start(function, args);
    let result = loop {
        match event {
            Event::Done(value) => break Ok(value),
            Event::Unhandled(condition) => {
                machine.unwind_all();
                break Err(Raise::condition(condition));
            }
            Event::Request(_) => {
                event = machine.resume_with_error(Raise::control(
                    "A macro function cannot wait, move the robot or start tasks.",
                ));
            }
            Event::Interrupted if machine.image.limits.polls.put_off() => event = machine.run(),
            Event::Interrupted => {
                machine.unwind_all();
                break Err(Stopped::Interrupted.into());
            }
            Event::Output => event = machine.run(),
            Event::Unwound => break Ok(Value::NIL),
        }
    };
    image.nesting -= 1;
    image.notes = notes;
    image.output.set_shown(was_shown);
    result
}

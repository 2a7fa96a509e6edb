//! Calls what goes on beside the plans, while time passes.

use super::Scheduler;
use super::asked::Asked;
use crate::companion;
use crate::host::{Host, Reply};
use crate::state::Plan;
use crate::task::TaskId;
use lisp::image::Image;
use lisp::print;
use lisp::value::Value;
use lisp::value::raise::Raise;
use lisp::vm::fiber::Fiber;
use lisp::vm::machine::{Event, Machine};

impl<C: 'static> Scheduler<C> {
    /// Calls the companions whose time has come; were there any? One goes on while its function returns
    /// true, and after an interrupt.
    pub(super) fn call_companions(
        &mut self,
        image: &mut Image,
        host: &mut dyn Host<Call = C>,
    ) -> bool {
        let plan = Plan::of(image);
        let due = companion::take_due(&plan);
        let called = !due.is_empty();
        for companion in due {
            if goes_on::<C>(image, host, companion.function()) {
                plan.add_companion(companion.again(plan.now()));
            }
        }
        called
    }
}

/// Calls the function of a companion to its end. It may ask the host for what is answered at once.
fn goes_on<C: 'static>(image: &mut Image, host: &mut dyn Host<Call = C>, function: Value) -> bool {
    let mut fiber = Fiber::default();
    let mut event = Machine::new(image, &mut fiber).start(function, Vec::new());
    loop {
        event = match event {
            Event::Done(value) => return value.primary().is_true(),
            Event::Unwound => return false,
            Event::Unhandled(condition) => {
                Machine::new(image, &mut fiber).unwind_all();
                let report = print::to_string(image, &condition, false);
                image.output.fresh_line();
                image.output.write(&format!(
                    "WARNING: What goes on beside the plans has ended: {report}\n"
                ));
                return false;
            }
            Event::Interrupted => {
                Machine::new(image, &mut fiber).unwind_all();
                return true;
            }
            Event::Output => {
                host.show_output(image);
                Machine::new(image, &mut fiber).run()
            }
            Event::Request(request) => {
                let reply = match Asked::of(request) {
                    Some(Asked::Host(call)) => match host.call(image, TaskId(0), call) {
                        Reply::Now(outcome) => outcome,
                        Reply::Later(ticket) => {
                            host.cancel(image, ticket);
                            Err(cannot_wait())
                        }
                    },
                    _ => Err(cannot_wait()),
                };
                let mut machine = Machine::new(image, &mut fiber);
                match reply {
                    Ok(value) => machine.resume(value),
                    Err(raise) => machine.resume_with_error(raise),
                }
            }
        };
    }
}

fn cannot_wait() -> Box<Raise> {
    Raise::control("What goes on beside the plans cannot wait, move the robot or start tasks.")
}

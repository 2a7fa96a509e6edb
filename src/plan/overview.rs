//! `tasks`: shows what is running.

use super::request::Request;
use crate::lisp::value::Value;
use crate::lisp::value::raise::Raise;
use crate::lisp::vm::calls::run;
use crate::lisp::vm::machine::Machine;
use crate::lisp::vm::step::Step;

/// Requests the tree of tasks from the scheduler and prints it.
pub(crate) fn tell_overview(machine: &mut Machine<'_>) -> Result<Step, Box<Raise>> {
    run(machine, "TASKS", |calls| async move {
        let text = calls.request(Request::Overview).await;
        let text = text.as_text().unwrap_or_default();
        calls
            .with(move |machine| {
                let output = &mut machine.image.output;
                output.fresh_line();
                output.write(&text);
            })
            .await;
        Ok(Value::values(Vec::new()))
    })
}

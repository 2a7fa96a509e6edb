//! `tasks`: shows what is running.

use super::request::Request;
use lisp::value::Value;
use lisp::value::raise::Raise;
use lisp::vm::calls::run;
use lisp::vm::machine::Machine;
use lisp::vm::step::Step;

/// Requests the tree of tasks from the scheduler and prints it.
pub fn tell_overview(machine: &mut Machine<'_>) -> Result<Step, Box<Raise>> {
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

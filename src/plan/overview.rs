//! `tasks`: tells what runs.

use super::request::Request;
use super::step::request_then;
use crate::lisp::value::Value;
use crate::lisp::vm::step::Step;

/// Asks the scheduler for the tree of tasks and writes it.
pub(crate) fn overview_step() -> Step {
    request_then("TASKS", Request::Overview, |machine, text| {
        let output = &mut machine.image.output;
        output.fresh_line();
        output.write(&text.as_text().unwrap_or_default());
        Ok(Step::Return(Value::values(Vec::new())))
    })
}

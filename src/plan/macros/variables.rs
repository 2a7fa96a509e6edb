//! Variables of tasks and parameters of plans.

use super::{Expansion, macro_, option, plan, quoted};
use crate::lisp::builtin::Operator;
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::form::form;
use crate::lisp::value::known;

/// The macros.
pub(crate) static OPERATORS: &[Operator] = &[
    macro_(
        "DEF-CPL-PARAMETER",
        "name value &optional doc",
        "Defines a variable that all tasks share.",
        &["(cpl:def-cpl-parameter *speed* 10) => *SPEED*"],
        |_, form| Ok(form![known::DEFPARAMETER; form.cdr_or_nil()]),
    ),
    macro_(
        "DEFINE-TASK-VARIABLE",
        "name &optional value doc &key type init-function",
        "Defines a variable that each task binds anew: to the value in the task that starts it, or to what a function of the task, its parent and that value returns.",
        &[
            "(progn (cpl:define-task-variable *my-depth* 0) (cpl:top-level (setf *my-depth* 1)) *my-depth*) => 0",
        ],
        define_task_variable,
    ),
];

fn define_task_variable(image: &mut Image, form: &Value) -> Expansion {
    let names = plan(image).names;
    let parts = form.cdr_or_nil().list_to_vec().unwrap_or_default();
    let name = parts.first().cloned().unwrap_or(Value::NIL);
    let mut definition: Vec<Value> = vec![known::DEFVAR.into(), name.clone()];
    definition.extend(parts.iter().skip(1).take(2).cloned());
    let options = Value::list(parts.iter().skip(3).cloned().collect::<Vec<_>>());
    let init = option(&options, names.init_function).unwrap_or(Value::NIL);
    Ok(form![
        known::PROGN,
        Value::list(definition),
        form![names.sys_define_task_variable, quoted(name), init],
    ])
}

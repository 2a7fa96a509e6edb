//! What handlers tell of themselves.

use crate::handlers::Handlers;
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::raise::Raise;

/// The number of a clause of WITH-FAILURE-HANDLING in a program; NIL elsewhere.
///
/// `(plan-system:know-handler (list 'error))` => `NIL`
#[builtin]
fn know_handler(image: &mut Image, clause: &Value) -> Result<Value, Box<Raise>> {
    let number = Handlers::know(image, clause);
    let number = number.and_then(|number| i64::try_from(number).ok());
    Ok(number.map_or(Value::NIL, Value::Int))
}

/// Notes that the handler with that number begins to handle a condition.
///
/// `(plan-system:note-handled -1 nil)` => `NIL`
#[builtin(_, "number condition")]
fn note_handled(
    image: &mut Image,
    number_value: &Value,
    condition: &Value,
) -> Result<Value, Box<Raise>> {
    if let Value::Int(number) = number_value
        && let Ok(number) = usize::try_from(*number)
    {
        Handlers::note(image, number, condition);
    }
    Ok(Value::NIL)
}

/// Builtins of package `PLAN-SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![know_handler, note_handled,];

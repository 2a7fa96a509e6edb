//! What handlers tell of themselves.

use crate::handlers::Handlers;
use lisp::builtin::{Builtin, pure};
use lisp::value::Value;

/// Builtins of package `PLAN-SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = &[
    pure(
        "KNOW-HANDLER",
        "clause",
        "The number of a clause of WITH-FAILURE-HANDLING in a program; NIL elsewhere.",
        &["(plan-system:know-handler (list 'error)) => NIL"],
        |image, args| {
            let number = Handlers::know(image, &args[0]);
            let number = number.and_then(|number| i64::try_from(number).ok());
            Ok(number.map_or(Value::NIL, Value::Int))
        },
    ),
    pure(
        "NOTE-HANDLED",
        "number condition",
        "Notes that the handler with that number begins to handle a condition.",
        &["(plan-system:note-handled -1 nil) => NIL"],
        |image, args| {
            if let Value::Int(number) = &args[0]
                && let Ok(number) = usize::try_from(*number)
            {
                Handlers::note(image, number, &args[1]);
            }
            Ok(Value::NIL)
        },
    ),
];

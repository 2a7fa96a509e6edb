//! Serving the session to an editor.

use crate::person::Person;
use lisp::builtin::Builtin;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::raise::Raise;

/// Builtins of package `SWANK`.
pub(super) static TABLE: &[Builtin] = builtins![create_server];

/// The port by which SLIME connects unless told otherwise.
const USUAL_PORT: i64 = 4005;

/// At the prompt: serves the session to Emacs, which connects by M-x slime-connect, until Ctrl-C; the prompt
/// waits meanwhile. With port 0, any that is free. Returns the port that was asked for.
#[builtin(_, "&key (port 4005) dont-close style", edit)]
fn create_server(
    person: &mut Person,
    #[key] port: Option<&Value>,
    #[key] _dont_close: Option<&Value>,
    #[key] _style: Option<&Value>,
) -> Result<Value, Box<Raise>> {
    let given = port.cloned().unwrap_or(Value::Int(USUAL_PORT));
    let port = match &given {
        Value::Int(port) => u16::try_from(*port).ok(),
        _ => None,
    };
    let Some(port) = port else {
        return Err(Raise::simple(
            "A port is a number from 0 to 65535.".to_owned(),
        ));
    };
    if !person.can_serve {
        return Err(Raise::simple(
            "Only a session at the prompt of a terminal can be served so; `planwright swank` serves one \
             of its own."
                .to_owned(),
        ));
    }
    person.port = Some(port);
    Ok(given)
}

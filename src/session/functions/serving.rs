//! Serving the session to an editor.

use crate::host::call::{done, edit};
use crate::person::Person;
use cram::Reply;
use lisp::builtin::{Builtin, control};
use lisp::image::Image;
use lisp::typed::keywords;
use lisp::value::Value;
use lisp::value::raise::Raise;

/// Builtins of package `SWANK`.
pub(super) static TABLE: &[Builtin] = &[control(
    "CREATE-SERVER",
    "&key (port 4005) dont-close style",
    "At the prompt: serves the session to Emacs, which connects by M-x slime-connect, until Ctrl-C; the prompt waits meanwhile. With port 0, any that is free. Returns the port that was asked for.",
    &[],
    edit!(create_server),
)];

/// The port by which SLIME connects unless told otherwise.
const USUAL_PORT: i64 = 4005;

fn create_server(
    person: &mut Person,
    image: &mut Image,
    args: &[Value],
) -> Result<Reply, Box<Raise>> {
    let names = ["PORT", "DONT-CLOSE", "STYLE"].map(|name| image.keyword(name));
    let [given, _, _] = keywords::parse(image, args, names)?;
    let given = given.unwrap_or(Value::Int(USUAL_PORT));
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
    done(given)
}

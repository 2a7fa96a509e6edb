//! Exiting the shell.

use crate::person::Person;
use lisp::builtin::Builtin;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::number;

/// Builtins of package `PLANWRIGHT`.
pub(super) static TABLE: &[Builtin] = builtins![quit, exit];

/// Leaves the shell.
#[builtin]
fn exit(person: &mut Person, status: Option<&Value>) {
    quit(person, status);
}

/// Leaves the shell.
#[builtin]
fn quit(person: &mut Person, status: Option<&Value>) {
    let status = status.and_then(number::to_f64).unwrap_or(0.0);
    person.quit = Some(status.clamp(0.0, 255.0) as u8);
}

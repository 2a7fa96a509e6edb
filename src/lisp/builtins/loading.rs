//! Loading files of forms.

use std::path::{Component, Path, PathBuf};

use super::files::reason;
use crate::lisp::builtin::{Builtin, control};
use crate::lisp::reader::{Outcome, Reader};
use crate::lisp::value::Value;
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;
use crate::lisp::vm::calls::run;
use crate::lisp::vm::fiber::Dynamic;
use crate::lisp::vm::machine::Machine;
use crate::lisp::vm::step::Step;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `COMMON-LISP`.
pub(crate) static TABLE: &[Builtin] = &[control(
    "LOAD",
    "file &key verbose print if-does-not-exist external-format",
    "Evaluates all forms of a file; T. A file that another file loads is looked for beside that one first.",
    &[],
    load,
)];

/// Evaluates all forms of a text; places refer to the text as `name`.
pub(crate) fn load_text(machine: &mut Machine<'_>, name: &str, text: &str) -> Result<Step> {
    let source = machine.image.sources.add(name, text);
    let mut reader = Reader::new(machine.image, source);
    // The file may change the current package; the caller's is restored afterwards.
    let package = machine.image.special(known::V_PACKAGE).clone();
    machine
        .fiber
        .dynamic
        .push(Dynamic::Bind(known::V_PACKAGE, package));
    run(machine, "LOAD", |calls| async move {
        let eval = Value::from(known::EVAL);
        let mut supplied = None;
        loop {
            let outcome;
            (reader, outcome) = calls
                .with(move |machine| {
                    let outcome = match supplied {
                        Some(value) => reader.supply(machine.image, value),
                        None => reader.next(machine.image),
                    };
                    (reader, outcome)
                })
                .await;
            supplied = match outcome.map_err(|error| error.raise())? {
                Outcome::Form(form, _) => {
                    calls.call1(&eval, form).await;
                    None
                }
                Outcome::Evaluate(form) => Some(calls.call1(&eval, form).await),
                Outcome::End => {
                    calls.with(restore_package).await;
                    return Ok(Value::T);
                }
            };
        }
    })
}

/// Undoes the binding of `*package*` that loading made: the innermost dynamic entry.
fn restore_package(machine: &mut Machine<'_>) {
    if let Some(Dynamic::Bind(known::V_PACKAGE, _)) = machine.fiber.dynamic.last()
        && let Some(Dynamic::Bind(sym, outside)) = machine.fiber.dynamic.pop()
    {
        machine.image.set_special(sym, outside);
    }
}

fn load(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step> {
    let Some(path) = args[0].as_text() else {
        return Err(Raise::type_error(&args[0], known::STRING));
    };
    let path = beside(machine, &path).unwrap_or(path);
    let text = read_file(&path)?;
    load_text(machine, &path, &text)
}

/// The file of that name in the folder of the file whose form is being evaluated, if there
/// is one.
fn beside(machine: &Machine<'_>, path: &str) -> Option<String> {
    let loader = machine.image.sources.locate(machine.place())?;
    let neighbour = Path::new(&*loader.name).parent()?.join(path);
    (Path::new(path).is_relative() && neighbour.is_file())
        .then(|| without_detours(&neighbour))
        .filter(|plain| plain.is_file())
        .map(|plain| plain.to_string_lossy().into_owned())
}

/// The path without `folder/..`.
fn without_detours(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match (part, plain.components().next_back()) {
            (Component::ParentDir, Some(Component::Normal(_))) => {
                plain.pop();
            }
            (Component::CurDir, _) => {}
            _ => plain.push(part),
        }
    }
    plain
}

fn read_file(path: &str) -> Result<String> {
    std::fs::read_to_string(path).map_err(|error| {
        Raise::new(
            known::FILE_ERROR,
            format!("The file {path:?} cannot be read: {}.", reason(&error)),
        )
        .with(known::K_PATHNAME, path.into())
    })
}

//! Loading files of forms.

use std::path::{Component, Path, PathBuf};

use super::evaluation::signal_warnings;
use super::files::reason;
use crate::builtin::Builtin;
use crate::files::utf8;
use crate::image::Image;
use crate::image::built_in_files::BuiltInFiles;
use crate::reader::{Outcome, Reader};
use crate::source::SourceId;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::known;
use crate::value::pathname::{Pathname, file_name};
use crate::value::raise::Raise;
use crate::value::symbol::Sym;
use crate::vm::calls::{Args, run};
use crate::vm::fiber::Dynamic;
use crate::vm::machine::Machine;
use crate::vm::step::Step;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Evaluates all forms of a text; places refer to the text as `name`.
pub fn load_text(machine: &mut Machine<'_>, name: &str, text: &str) -> Result<Step> {
    let source = machine.image.sources.add(name, text);
    load_source(machine, name, source, false)
}

/// The same; the values of the forms are printed if wanted.
fn load_source(
    machine: &mut Machine<'_>,
    name: &str,
    source: SourceId,
    shows_values: bool,
) -> Result<Step> {
    let mut reader = Reader::new(machine.image, source);
    // The file may change these variables; the caller's values are restored afterwards.
    for variable in BOUND {
        let outside = machine.image.special(variable).clone();
        machine.fiber.dynamic.push(Dynamic::Bind(variable, outside));
    }
    // Files that this one loads are loaded as they are, unless that is said again.
    let is_next = |value: &Value| {
        value
            .as_symbol()
            .is_some_and(|sym| machine.image.name(sym) == "NEXT")
    };
    let as_compiled = is_next(machine.image.special(known::V_AS_COMPILED));
    machine
        .image
        .set_special(known::V_AS_COMPILED, Value::bool(as_compiled));
    // Those who have written a system have seen what there is to warn of.
    let is_judged = !as_compiled;
    let file = Value::foreign(Pathname::parse(name));
    machine.image.set_special(known::V_LOAD_PATHNAME, file);
    let absolute = machine.image.files.true_name(name).ok();
    let truename = absolute.map_or(Value::NIL, |path| Value::foreign(Pathname::parse(&path)));
    machine.image.set_special(known::V_LOAD_TRUENAME, truename);
    let outer_notes = machine.image.take_pending_notes();
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
                Outcome::Form(form, place) => {
                    calls
                        .with(move |machine| machine.image.begin_noted_form(place, is_judged))
                        .await;
                    let value = calls.call1(&eval, form).await;
                    if shows_values {
                        let arguments = vec![Value::T, Value::string("~&; ~s~%"), value];
                        let format = Value::from(known::FORMAT);
                        calls.call(&format, Args::Many(arguments)).await;
                    }
                    None
                }
                Outcome::Evaluate(form) => Some(calls.call1(&eval, form).await),
                Outcome::End => {
                    let warnings = calls
                        .with(|machine| {
                            let notes = machine.image.take_pending_notes();
                            machine.image.restore_pending_notes(outer_notes);
                            machine.image.judged(&notes)
                        })
                        .await;
                    signal_warnings(&calls, warnings).await;
                    calls.with(restore).await;
                    return Ok(Value::T);
                }
            };
        }
    })
}

/// The variables that loading a file binds.
const BOUND: [Sym; 5] = [
    known::V_AS_COMPILED,
    known::V_PACKAGE,
    known::V_READTABLE,
    known::V_LOAD_PATHNAME,
    known::V_LOAD_TRUENAME,
];

/// An error if a file is being loaded already, by files that it has loaded.
fn refuse_circle(machine: &Machine<'_>, path: &str) -> Result<()> {
    let files = &machine.image.files;
    let same = |name: &str| files.true_name(name).unwrap_or_else(|_| name.to_owned());
    let wanted = same(path);
    let mut chain = vec![path.to_owned()];
    // The innermost file is the value of the variable; each binding keeps the one around it.
    let outside = machine.fiber.dynamic.iter().rev();
    let outside = outside.filter_map(|entry| match entry {
        Dynamic::Bind(known::V_LOAD_PATHNAME, value) => Some(value),
        _ => None,
    });
    let current = machine.image.special(known::V_LOAD_PATHNAME);
    for value in std::iter::once(current).chain(outside) {
        let Some(name) = Some(value)
            .filter(|value| value.is_true())
            .and_then(file_name)
        else {
            continue;
        };
        let is_same = same(&name) == wanted;
        chain.push(name);
        if is_same {
            chain.reverse();
            return Err(Raise::new(
                known::FILE_ERROR,
                format!("A file loads itself: {}.", chain.join(", which loads ")),
            )
            .with(known::K_PATHNAME, Value::foreign(Pathname::parse(path))));
        }
    }
    Ok(())
}

/// Undoes the bindings that loading made: the innermost dynamic entries.
fn restore(machine: &mut Machine<'_>) {
    for variable in BOUND.into_iter().rev() {
        if let Some(Dynamic::Bind(bound, _)) = machine.fiber.dynamic.last()
            && *bound == variable
            && let Some(Dynamic::Bind(sym, outside)) = machine.fiber.dynamic.pop()
        {
            machine.image.set_special(sym, outside);
        }
    }
}

/// Evaluates all forms of a file; T. A file that another file loads is looked for beside that one
/// first; the tutorial's files, such as `plans/tutorial/skills.plan`, are built in.
#[builtin]
fn load(
    machine: &mut Machine<'_>,
    file: &Value,
    #[key] verbose: Option<&Value>,
    #[key] print: Option<&Value>,
    #[key] if_does_not_exist: Option<&Value>,
    #[key] _external_format: Option<&Value>,
) -> Result<Step> {
    if let Value::Stream(stream) = file {
        let name = stream.file.as_deref().unwrap_or("stream").to_owned();
        let (text, from) = crate::stream::rest(machine.image, file)?;
        let text = text.get(from..).unwrap_or_default();
        crate::stream::advance(machine.image, file, text.len())?;
        let shows_values = announce(machine, &name, verbose, print)?;
        let source = machine.image.sources.add(&name, text);
        return load_source(machine, &name, source, shows_values);
    }
    let Some(path) = file_name(file) else {
        return Err(Raise::type_error(file, known::STRING));
    };
    let path = beside(machine, &path).unwrap_or(path);
    if machine.image.files.facts(&path).is_err()
        && let Some((name, text)) = built_in(machine, &path)
    {
        refuse_circle(machine, &name)?;
        let shows_values = announce(machine, &name, verbose, print)?;
        let source = machine.image.sources.add(&name, text);
        return load_source(machine, &name, source, shows_values);
    }
    refuse_circle(machine, &path)?;
    let text = match read_file(machine.image, &path) {
        Err(_) if if_does_not_exist.is_some_and(Value::is_nil) => {
            return Ok(Step::Return(Value::NIL));
        }
        result => result?,
    };
    let shows_values = announce(machine, &path, verbose, print)?;
    let source = machine.image.sources.add(&path, &text);
    machine.image.sources.note_loaded(source);
    load_source(machine, &path, source, shows_values)
}

/// Says what is loaded, if that is wanted. Are the values of its forms wanted, too?
fn announce(
    machine: &mut Machine<'_>,
    name: &str,
    verbose: Option<&Value>,
    print: Option<&Value>,
) -> Result<bool> {
    let is_wanted = |given: Option<&Value>, variable: Sym| {
        let value = given.unwrap_or_else(|| machine.image.special(variable));
        // The variables have no values before somebody uses them.
        value.is_true() && !matches!(value, Value::Unbound)
    };
    let shows_name = is_wanted(verbose, known::V_LOAD_VERBOSE);
    let shows_values = is_wanted(print, known::V_LOAD_PRINT);
    if shows_name {
        let text = format!("; Loading {name}\n");
        crate::stream::write(machine.image, &Value::NIL, &text)?;
    }
    Ok(shows_values)
}

/// The file of that name in the folder of the file whose form is being evaluated, if there
/// is one.
fn beside(machine: &Machine<'_>, path: &str) -> Option<String> {
    let loader = machine.image.sources.locate(machine.place())?;
    let neighbour = Path::new(&*loader.name).parent()?.join(path);
    let is_file = |path: &Path| {
        let facts = path.to_str().map(|name| machine.image.files.facts(name));
        matches!(facts, Some(Ok(known)) if !known.is_folder)
    };
    (Path::new(path).is_relative() && is_file(&neighbour))
        .then(|| without_detours(&neighbour))
        .filter(|plain| is_file(plain))
        .map(|plain| plain.to_string_lossy().into_owned())
}

/// Name and text of the built-in file of that name, or of that name in the folder of the file whose
/// form is being evaluated.
fn built_in(machine: &Machine<'_>, path: &str) -> Option<(String, &'static str)> {
    let files = machine.image.extension::<BuiltInFiles>()?;
    let loader = machine.image.sources.locate(machine.place());
    let folder = loader.as_ref().and_then(|at| Path::new(&*at.name).parent());
    let neighbour = folder.map(|folder| folder.join(path));
    let candidates = [neighbour, Some(PathBuf::from(path))];
    candidates.into_iter().flatten().find_map(|path| {
        let name = without_detours(&path).to_string_lossy().into_owned();
        let text = (files.0)(&name)?;
        Some((name, text))
    })
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

fn read_file(image: &Image, path: &str) -> Result<String> {
    let text = image.files.read_plan(path).and_then(utf8);
    text.map_err(|error| {
        Raise::new(
            known::FILE_ERROR,
            format!("The file {path:?} cannot be read: {}.", reason(&error)),
        )
        .with(known::K_PATHNAME, Value::foreign(Pathname::parse(path)))
    })
}

/// Builtins of package `COMMON-LISP`.
pub(crate) static TABLE: &[Builtin] = builtins![load,];

//! The generators and validators of locations, and the functions that register them.

use crate::{Result, packages};
use lisp::builtin::{Builtin, control, pure};
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;
use lisp::value::symbol::Sym;
use lisp::vm::calls::run;

/// The variable with the generators: a list of `(priority function documentation enabled)`.
pub(super) const GENERATORS: &str = "*LOCATION-GENERATORS*";
/// The variable with the validators, in the same form.
pub(super) const VALIDATORS: &str = "*LOCATION-VALIDATION-FUNCTIONS*";
/// The variable with the number of rejections in a row that ends a search.
const MOST_RETRIES: &str = "*LOCATION-GENERATOR-MAX-RETRIES*";
/// Its initial value.
const RETRIES: i64 = 30;

/// The generator that every image has, and its priority.
const GROUNDING: &str = "LOCATION-GROUNDING-GENERATOR";
const GROUNDING_PRIORITY: i64 = 10;

/// Functions of package `SYSTEM`: what the macros that register generators and validators expand into.
pub(crate) static SYSTEM_TABLE: &[Builtin] = &[
    pure(
        "ADD-LOCATION-GENERATOR",
        "priority function &optional documentation",
        "Lets a function of a location designator resolve locations; low priorities come first. It returns a list of poses, or a function without arguments that returns the next pose each time, at last NIL or a text that says why there are no more.",
        &[],
        |image, args| register(image, GENERATORS, args),
    ),
    pure(
        "ADD-LOCATION-VALIDATOR",
        "priority function &optional documentation",
        "Lets a function of a location designator and a pose judge solutions: :ACCEPT, :MAYBE-REJECT, :UNKNOWN, or NIL or a text that says why to reject.",
        &[],
        |image, args| register(image, VALIDATORS, args),
    ),
];

/// Functions of package `CRAM-DESIGNATORS`.
pub(crate) static TABLE: &[Builtin] = &[
    pure(
        "DELETE-LOCATION-GENERATOR-FUNCTION",
        "function",
        "Forgets a generator.",
        &["(desig:delete-location-generator-function 'no-such) => NIL"],
        |image, args| change(image, GENERATORS, &args[0], Change::Delete),
    ),
    pure(
        "ENABLE-LOCATION-GENERATOR-FUNCTION",
        "function",
        "Uses a generator again.",
        &[],
        |image, args| change(image, GENERATORS, &args[0], Change::Enable),
    ),
    pure(
        "DISABLE-LOCATION-GENERATOR-FUNCTION",
        "function",
        "Does not use a generator for the time being.",
        &[],
        |image, args| change(image, GENERATORS, &args[0], Change::Disable),
    ),
    pure(
        "DELETE-LOCATION-VALIDATION-FUNCTION",
        "function",
        "Forgets a validator.",
        &[],
        |image, args| change(image, VALIDATORS, &args[0], Change::Delete),
    ),
    pure(
        "ENABLE-LOCATION-VALIDATION-FUNCTION",
        "function",
        "Uses a validator again.",
        &[],
        |image, args| change(image, VALIDATORS, &args[0], Change::Enable),
    ),
    pure(
        "DISABLE-LOCATION-VALIDATION-FUNCTION",
        "function",
        "Does not use a validator for the time being.",
        &[],
        |image, args| change(image, VALIDATORS, &args[0], Change::Disable),
    ),
    pure(
        "LIST-LOCATION-GENERATOR-FUNCTIONS",
        "",
        "All generators: (priority function documentation enabled).",
        &[],
        |image, _| {
            let list = variable(image, GENERATORS);
            Ok(image.special(list).clone())
        },
    ),
    pure(
        "RESET",
        "designator",
        "Forgets what a location was resolved to and the search for it, which begins anew; returns the location.",
        &["(let ((l (desig:a location (pose nil)))) (eq l (desig:reset l))) => T"],
        |image, args| {
            super::location::reset(image, &args[0])?;
            Ok(args[0].clone())
        },
    ),
];

/// Functions of package `CRAM-DESIGNATORS` that call rules.
pub(crate) static CONTROL_TABLE: &[Builtin] = &[control(
    GROUNDING,
    "designator",
    "The generator of the poses that a location lists, and of those that the rules LOCATION-GROUNDING give.",
    &["(desig:location-grounding-generator (desig:a location (poses (1 2)))) => (1 2)"],
    |machine, args| {
        run(machine, GROUNDING, |calls| async move {
            super::location::groundings(&calls, &args[0]).await
        })
    },
)];

enum Change {
    Delete,
    Enable,
    Disable,
}

/// Defines the variables.
pub(crate) fn define(image: &mut Image) {
    let list = variable(image, GENERATORS);
    let grounding = Value::list([
        GROUNDING_PRIORITY.into(),
        variable(image, GROUNDING).into(),
        "Poses that are listed, and rules.".into(),
        Value::T,
    ]);
    image.define_special(list, Value::list([grounding]));
    let list = variable(image, VALIDATORS);
    image.define_special(list, Value::NIL);
    let sym = variable(image, MOST_RETRIES);
    image.define_special(sym, Value::Int(RETRIES));
}

/// A symbol of `CRAM-DESIGNATORS`.
pub(super) fn variable(image: &mut Image, name: &str) -> Sym {
    packages::symbol(image, "CRAM-DESIGNATORS", name)
}

fn register(image: &mut Image, list: &str, args: &[Value]) -> Result<Value> {
    let Value::Int(priority) = args[0] else {
        return Err(Raise::type_error(&args[0], known::INTEGER));
    };
    let entry = Value::list([
        args[0].clone(),
        args[1].clone(),
        args.get(2).cloned().unwrap_or(Value::NIL),
        Value::T,
    ]);
    let list = variable(image, list);
    let mut entries: Vec<Value> = image
        .special(list)
        .iter_list()
        .filter(|e| !is_about(e, &args[1]))
        .collect();
    let place = entries
        .iter()
        .position(|e| matches!(e.car_or_nil(), Value::Int(p) if p > priority));
    entries.insert(place.unwrap_or(entries.len()), entry);
    image.set_special(list, Value::list(entries));
    Ok(args[1].clone())
}

fn is_about(entry: &Value, function: &Value) -> bool {
    entry.cdr_or_nil().car_or_nil().is_eql(function)
}

fn change(image: &mut Image, list: &str, function: &Value, change: Change) -> Result<Value> {
    let list = variable(image, list);
    let mut found = false;
    let mut entries = Vec::new();
    for entry in image.special(list).iter_list() {
        if !is_about(&entry, function) {
            entries.push(entry);
            continue;
        }
        found = true;
        let parts: Vec<Value> = entry.iter_list().take(3).collect();
        match change {
            Change::Delete => {}
            Change::Enable => entries.push(Value::list_with_tail(parts, Value::list([Value::T]))),
            Change::Disable => {
                entries.push(Value::list_with_tail(parts, Value::list([Value::NIL])));
            }
        }
    }
    image.set_special(list, Value::list(entries));
    Ok(Value::bool(found))
}

/// The enabled functions, in order of priority.
pub(super) fn enabled(image: &mut Image, list: &str) -> Vec<Value> {
    let list = variable(image, list);
    image
        .special(list)
        .iter_list()
        .filter_map(|entry| {
            let parts = entry.list_to_vec()?;
            match parts.as_slice() {
                [_, function, _, enabled] if enabled.is_true() => Some(function.clone()),
                _ => None,
            }
        })
        .collect()
}

/// The number of rejections in a row that ends a search.
pub(super) fn most_retries(image: &mut Image) -> i64 {
    let most = variable(image, MOST_RETRIES);
    match image.special(most) {
        Value::Int(most) => *most,
        _ => RETRIES,
    }
}

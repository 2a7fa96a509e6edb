//! The generators and validators of locations, and the functions that register them.

use crate::{Result, packages};
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;
use lisp::value::symbol::Sym;
use lisp::vm::calls::run;
use lisp::vm::machine::Machine;
use lisp::vm::step::Step;

/// The variable with the generators: a list of `(priority function documentation enabled)`.
pub(super) const GENERATORS: &str = "*LOCATION-GENERATORS*";
/// The variable with the validators, in the same form.
pub(super) const VALIDATORS: &str = "*LOCATION-VALIDATION-FUNCTIONS*";
/// The variable with the number of rejections in a row that ends a search.
const MAX_RETRIES: &str = "*LOCATION-GENERATOR-MAX-RETRIES*";
/// Its initial value.
const RETRIES: i64 = 30;

/// The generator that every image has, and its priority.
const GROUNDING: &str = "LOCATION-GROUNDING-GENERATOR";
const GROUNDING_PRIORITY: i64 = 10;

/// Lets a function of a location designator resolve locations; low priorities come first. It
/// returns a list of poses, or a function without arguments that returns the next pose each time,
/// at last NIL or a text that says why there are no more.
#[builtin]
fn add_location_generator(
    image: &mut Image,
    priority: &Value,
    function: &Value,
    documentation: Option<Value>,
) -> Result<Value> {
    register(image, GENERATORS, priority, function, documentation)
}

/// Lets a function of a location designator and a pose judge solutions: :ACCEPT, :MAYBE-REJECT,
/// :UNKNOWN, or NIL or a text that says why to reject.
#[builtin]
fn add_location_validator(
    image: &mut Image,
    priority: &Value,
    function: &Value,
    documentation: Option<Value>,
) -> Result<Value> {
    register(image, VALIDATORS, priority, function, documentation)
}

/// Forgets a generator.
///
/// `(desig:delete-location-generator-function 'no-such)` => `NIL`
#[builtin]
fn delete_location_generator_function(image: &mut Image, function: &Value) -> Result<Value> {
    change(image, GENERATORS, function, Change::Delete)
}

/// Uses a generator again.
#[builtin]
fn enable_location_generator_function(image: &mut Image, function: &Value) -> Result<Value> {
    change(image, GENERATORS, function, Change::Enable)
}

/// Does not use a generator for the time being.
#[builtin]
fn disable_location_generator_function(image: &mut Image, function: &Value) -> Result<Value> {
    change(image, GENERATORS, function, Change::Disable)
}

/// Forgets a validator.
#[builtin]
fn delete_location_validation_function(image: &mut Image, function: &Value) -> Result<Value> {
    change(image, VALIDATORS, function, Change::Delete)
}

/// Uses a validator again.
#[builtin]
fn enable_location_validation_function(image: &mut Image, function: &Value) -> Result<Value> {
    change(image, VALIDATORS, function, Change::Enable)
}

/// Does not use a validator for the time being.
#[builtin]
fn disable_location_validation_function(image: &mut Image, function: &Value) -> Result<Value> {
    change(image, VALIDATORS, function, Change::Disable)
}

/// All generators: (priority function documentation enabled).
#[builtin(_, "")]
fn list_location_generator_functions(image: &mut Image) -> Result<Value> {
    let list = variable(image, GENERATORS);
    Ok(image.special(list).clone())
}

/// Forgets what a location was resolved to and the search for it, which begins anew; returns the
/// location.
///
/// `(let ((l (desig:a location (pose nil)))) (eq l (desig:reset l)))` => `T`
#[builtin]
fn reset(image: &mut Image, designator: &Value) -> Result<Value> {
    super::location::reset(image, designator)?;
    Ok(designator.clone())
}

/// The generator of the poses that a location lists, and of those that the rules LOCATION-GROUNDING
/// give.
///
/// `(desig:location-grounding-generator (desig:a location (poses (1 2))))` => `(1 2)`
#[builtin]
fn location_grounding_generator(machine: &mut Machine<'_>, designator: Value) -> Result<Step> {
    run(machine, GROUNDING, |calls| async move {
        super::location::groundings(&calls, &designator).await
    })
}

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
    let sym = variable(image, MAX_RETRIES);
    image.define_special(sym, Value::Int(RETRIES));
}

/// A symbol of `CRAM-DESIGNATORS`.
pub(super) fn variable(image: &mut Image, name: &str) -> Sym {
    packages::symbol(image, "CRAM-DESIGNATORS", name)
}

fn register(
    image: &mut Image,
    list: &str,
    priority: &Value,
    function: &Value,
    documentation: Option<Value>,
) -> Result<Value> {
    let Value::Int(priority) = *priority else {
        return Err(Raise::type_error(priority, known::INTEGER));
    };
    let entry = Value::list([
        priority.into(),
        function.clone(),
        documentation.into(),
        Value::T,
    ]);
    let list = variable(image, list);
    let mut entries: Vec<Value> = image
        .special(list)
        .iter_list()
        .filter(|e| !is_about(e, function))
        .collect();
    let place = entries
        .iter()
        .position(|e| matches!(e.car_or_nil(), Value::Int(p) if p > priority));
    entries.insert(place.unwrap_or(entries.len()), entry);
    image.set_special(list, Value::list(entries));
    Ok(function.clone())
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
    let most = variable(image, MAX_RETRIES);
    match image.special(most) {
        Value::Int(most) => *most,
        _ => RETRIES,
    }
}

/// Functions of package `SYSTEM`: what the macros that register generators and validators expand into.
pub(crate) static SYSTEM_TABLE: &[Builtin] =
    builtins![add_location_generator, add_location_validator,];

/// Functions of package `CRAM-DESIGNATORS`.
pub(crate) static TABLE: &[Builtin] = builtins![
    delete_location_generator_function,
    enable_location_generator_function,
    disable_location_generator_function,
    delete_location_validation_function,
    enable_location_validation_function,
    disable_location_validation_function,
    list_location_generator_functions,
    reset,
];

/// Functions of package `CRAM-DESIGNATORS` that call rules.
pub(crate) static CONTROL_TABLE: &[Builtin] = builtins![location_grounding_generator,];

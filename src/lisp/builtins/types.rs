//! Builtins on types: `typep`, `subtypep`, `type-of`, `coerce`, `deftype`.

use super::settled_types::element_type;
use crate::builtin::Builtin;
use crate::image::Image;
use crate::image::locks::Meaning;
use crate::typed::{self, builtin, builtins};
use crate::types::asking;
use crate::types::coerce::coerce;
use crate::types::emptiness::is_subtype;
use crate::types::parse::parse;
use crate::types::specifier::{Answers, Stop};
use crate::types::subtype::Verdict;
use crate::types::test::typep_with;
use crate::types::type_of;
use crate::value::Value;
use crate::value::element_type::ElementType;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;
use crate::vm::machine::Machine;
use crate::vm::step::Step;

/// Is the object of the type?
///
/// `(typep 5 '(integer 0 10))` => `T`
/// `(typep 4 '(satisfies oddp))` => `NIL`
#[builtin(_, "object type &optional environment")]
fn typep(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    asking::run(machine, "TYPEP", typep_operation, args)
}

/// Is every object of the first type one of the second? The second value tells whether the answer
/// is certain.
///
/// `(subtypep 'integer 'number)` => `T ; T`
/// `(subtypep 'string 'number)` => `NIL ; T`
#[builtin(_, "type-1 type-2 &optional environment")]
fn subtypep(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    asking::run(machine, "SUBTYPEP", subtypep_operation, args)
}

/// A type specifier that the object belongs to.
///
/// `(type-of 1.5)` => `SINGLE-FLOAT`
/// `(type-of '(1))` => `CONS`
#[builtin("TYPE-OF")]
fn type_of_builtin(image: &mut Image, object: &Value) -> Result<Value, Box<Raise>> {
    Ok(type_of(image, object))
}

/// Converts an object to an equivalent one of another type.
///
/// `(coerce 1/2 'float)` => `0.5`
/// `(coerce '(1 2) 'vector)` => `#(1 2)`
#[builtin("COERCE", "object result-type")]
fn coerce_builtin(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    asking::run(machine, "COERCE", coerce_operation, args)
}

/// The element type that an array made for elements of the type really has.
///
/// `(upgraded-array-element-type 'symbol)` => `T`
#[builtin]
fn upgraded_array_element_type(
    image: &mut Image,
    type_: &Value,
    _environment: Option<&Value>,
) -> Result<Value, Box<Raise>> {
    element_type(image, type_).map(ElementType::specifier)
}

fn typep_operation(
    image: &mut Image,
    args: &[Value],
    answers: &mut Answers,
) -> Result<Value, Stop> {
    if let Some(part) = untestable(&args[1]) {
        let part = crate::object::text(image, &part);
        return Err(Raise::simple(format!(
            "Nothing can be tested for being {part}: such a type is for declarations."
        ))
        .into());
    }
    typep_with(image, &args[0], &args[1], answers).map(Value::bool)
}

/// The type specifier, or the one that it combines with others, that tells what functions take or
/// what forms return.
fn untestable(specifier: &Value) -> Option<Value> {
    let head = specifier.car_or_nil();
    if head
        .as_symbol()
        .is_some_and(|name| COMBINATIONS.contains(&name))
    {
        let mut parts = specifier.iter_list().skip(1).take(MAX_PARTS);
        parts.find(is_for_declarations)
    } else {
        is_for_declarations(specifier).then(|| specifier.clone())
    }
}

/// A list of parts may have no end.
const MAX_PARTS: usize = 1000;

const COMBINATIONS: [Sym; 3] = [known::AND, known::OR, known::NOT];

fn is_for_declarations(specifier: &Value) -> bool {
    let head = specifier.car_or_nil();
    matches!(head.as_symbol(), Some(known::FUNCTION | known::VALUES))
        && specifier.cdr_or_nil().is_true()
}

fn subtypep_operation(
    image: &mut Image,
    args: &[Value],
    answers: &mut Answers,
) -> Result<Value, Stop> {
    let mut known = |specifier| match parse(image, specifier, answers) {
        Ok(found) => Ok(Some(found)),
        Err(Stop::UnknownType(_)) => Ok(None),
        Err(stop) => Err(stop),
    };
    let verdict = match (known(&args[0])?, known(&args[1])?) {
        (Some(a), Some(b)) => is_subtype(image, &a, &b),
        // Nothing is known about a type that is not defined.
        _ => Verdict::Unknown,
    };
    Ok(Value::values(vec![
        Value::bool(verdict == Verdict::Yes),
        Value::bool(verdict != Verdict::Unknown),
    ]))
}

fn coerce_operation(
    image: &mut Image,
    args: &[Value],
    answers: &mut Answers,
) -> Result<Value, Stop> {
    coerce(image, &args[0], &args[1], answers)
}

/// Defines a type whose specifiers the expander turns, from the list of their arguments, into
/// others. The last argument is a list of what the name stands for by itself, if that is known.
#[builtin("%DEFINE-TYPE", "name expander alone")]
fn define_type(
    image: &mut Image,
    name_value: &Value,
    expander_value: &Value,
    alone: &Value,
) -> Result<Value, Box<Raise>> {
    match (name_value, expander_value) {
        (Value::Symbol(name, ..), Value::Function(expander)) => {
            image.check_lock(*name, Meaning::Type)?;
            if image.class(*name).is_some() {
                return Err(Raise::simple(format!(
                    "DEFTYPE cannot redefine the class {}.",
                    image.name(*name)
                )));
            }
            image.types.insert(*name, expander.clone());
            match alone {
                Value::Cons(known) => image.type_names.insert(*name, known.car()),
                _ => image.type_names.shift_remove(name),
            };
            Ok(name_value.clone())
        }
        (name, _) => Err(Raise::type_error(name, Value::symbol(known::SYMBOL))),
    }
}

/// The builtins.
pub(crate) static TABLE: &[Builtin] = builtins![
    typep,
    subtypep,
    type_of_builtin,
    coerce_builtin,
    upgraded_array_element_type,
];

/// Builtins of the package `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![define_type,];

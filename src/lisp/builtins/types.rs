//! Builtins on types: `typep`, `subtypep`, `type-of`, `coerce`, `deftype`.

use super::settled_types::element_type;
use crate::builtin::{Builtin, control, pure};
use crate::image::Image;
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

/// The builtins.
pub static TABLE: &[Builtin] = &[
    control(
        "TYPEP",
        "object type &optional environment",
        "Is the object of the type?",
        &[
            "(typep 5 '(integer 0 10)) => T",
            "(typep 4 '(satisfies oddp)) => NIL",
        ],
        |machine, args| asking::run(machine, "TYPEP", typep_operation, args),
    ),
    control(
        "SUBTYPEP",
        "type-1 type-2 &optional environment",
        "Is every object of the first type one of the second? The second value tells whether the answer is certain.",
        &[
            "(subtypep 'integer 'number) => T ; T",
            "(subtypep 'string 'number) => NIL ; T",
        ],
        |machine, args| asking::run(machine, "SUBTYPEP", subtypep_operation, args),
    ),
    pure(
        "TYPE-OF",
        "object",
        "A type specifier that the object belongs to.",
        &["(type-of 1.5) => SINGLE-FLOAT", "(type-of '(1)) => CONS"],
        |image, args| Ok(type_of(image, &args[0])),
    ),
    control(
        "COERCE",
        "object result-type",
        "Converts an object to an equivalent one of another type.",
        &[
            "(coerce 1/2 'float) => 0.5",
            "(coerce '(1 2) 'vector) => #(1 2)",
        ],
        |machine, args| asking::run(machine, "COERCE", coerce_operation, args),
    ),
    pure(
        "UPGRADED-ARRAY-ELEMENT-TYPE",
        "type &optional environment",
        "The element type that an array made for elements of the type really has.",
        &["(upgraded-array-element-type 'symbol) => T"],
        |image, args| element_type(image, &args[0]).map(ElementType::specifier),
    ),
];

/// Builtins of the package `SYSTEM`.
pub static SYSTEM_TABLE: &[Builtin] = &[pure(
    "%DEFINE-TYPE",
    "name expander alone",
    "Defines a type whose specifiers the expander turns, from the list of their arguments, into others. The last argument is a list of what the name stands for by itself, if that is known.",
    &[],
    define_type,
)];

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
        let mut parts = specifier.iter_list().skip(1).take(MOST_PARTS);
        parts.find(is_for_declarations)
    } else {
        is_for_declarations(specifier).then(|| specifier.clone())
    }
}

/// A list of parts may have no end.
const MOST_PARTS: usize = 1000;

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

fn define_type(image: &mut Image, args: &[Value]) -> Result<Value, Box<Raise>> {
    match (&args[0], &args[1]) {
        (Value::Symbol(name, ..), Value::Function(expander)) => {
            if image.class(*name).is_some() {
                return Err(Raise::simple(format!(
                    "DEFTYPE cannot redefine the class {}.",
                    image.name(*name)
                )));
            }
            image.types.insert(*name, expander.clone());
            match &args[2] {
                Value::Cons(known) => image.type_names.insert(*name, known.car()),
                _ => image.type_names.shift_remove(name),
            };
            Ok(args[0].clone())
        }
        (name, _) => Err(Raise::type_error(name, Value::symbol(known::SYMBOL))),
    }
}

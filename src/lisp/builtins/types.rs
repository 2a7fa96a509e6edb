//! Builtins on types: `typep`, `subtypep`, `type-of`, `coerce`, `deftype`.

use crate::lisp::builtin::{Builtin, Operator, control, pure};
use crate::lisp::image::Image;
use crate::lisp::types::asking;
use crate::lisp::types::coerce::coerce;
use crate::lisp::types::parse::{parse, upgraded};
use crate::lisp::types::specifier::{Answers, Stop};
use crate::lisp::types::subtype::{Verdict, is_subset};
use crate::lisp::types::test::typep_with;
use crate::lisp::types::type_of;
use crate::lisp::value::Value;
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;

/// The builtins.
pub(crate) static TABLE: &[Builtin] = &[
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
        |image, args| Ok(upgraded(image, &args[0]).into()),
    ),
];

/// Builtins of the package `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = &[pure(
    "%DEFINE-TYPE",
    "name expander",
    "Defines a type whose specifiers the expander turns, from the list of their arguments, into others.",
    &[],
    define_type,
)];

/// The macros.
pub(crate) static OPERATORS: &[Operator] = &[Operator {
    name: "DEFTYPE",
    lambda_list: "name lambda-list &body body",
    doc: "Defines a type by what its specifiers stand for.",
    examples: &["(deftype small () '(integer 0 9)) => SMALL"],
    expand: Some(expand_deftype),
}];

fn typep_operation(
    image: &mut Image,
    args: &[Value],
    answers: &mut Answers,
) -> Result<Value, Stop> {
    typep_with(image, &args[0], &args[1], answers).map(Value::bool)
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
        (Some(a), Some(b)) => is_subset(image, &a, &b),
        // Nothing can be told of a type that is not defined.
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
        (Value::Symbol(name), Value::Function(expander)) => {
            if image.class(*name).is_some() {
                return Err(Raise::simple(format!(
                    "DEFTYPE cannot redefine the class {}.",
                    image.name(*name)
                )));
            }
            image.types.insert(*name, expander.clone());
            Ok(args[0].clone())
        }
        (name, _) => Err(Raise::type_error(name, Value::Symbol(known::SYMBOL))),
    }
}

/// `(deftype name lambda-list body…)` becomes a function of the argument list.
fn expand_deftype(image: &mut Image, form: &Value) -> Result<Value, Box<Raise>> {
    let parts = form.list_to_vec().unwrap_or_default();
    let [_, name, lambda_list, body @ ..] = parts.as_slice() else {
        return Err(Raise::program(
            "DEFTYPE takes a name, a lambda list and a body.",
        ));
    };
    let args = Value::Symbol(image.gensym("ARGS"));
    let quote = |v: &Value| Value::list([known::QUOTE.into(), v.clone()]);
    let block = Value::list_with_tail(
        [known::BLOCK.into(), name.clone()],
        Value::list(body.to_vec()),
    );
    let destructured = Value::list([
        known::DESTRUCTURING_BIND.into(),
        star_defaults(lambda_list),
        args.clone(),
        block,
    ]);
    let expander = Value::list([known::LAMBDA.into(), Value::list([args]), destructured]);
    Ok(Value::list([
        known::SYS_DEFINE_TYPE.into(),
        quote(name),
        expander,
    ]))
}

/// The lambda list with `'*` as the default of optional parameters that have none.
fn star_defaults(lambda_list: &Value) -> Value {
    let star = || Value::list([known::QUOTE.into(), known::TIMES.into()]);
    let mut in_optional = false;
    let mut items = lambda_list.iter_list();
    let mut result = Vec::new();
    for item in items.by_ref() {
        let item = match &item {
            Value::Symbol(known::L_OPTIONAL | known::L_KEY) => {
                in_optional = true;
                item
            }
            Value::Symbol(
                known::L_REST | known::L_BODY | known::L_AUX | known::L_ALLOW_OTHER_KEYS,
            ) => {
                in_optional = false;
                item
            }
            Value::Symbol(_) if in_optional => Value::list([item, star()]),
            Value::Cons(pair) if in_optional && pair.cdr().is_nil() => {
                Value::list([pair.car(), star()])
            }
            _ => item,
        };
        result.push(item);
    }
    Value::list_with_tail(result, items.rest)
}

//! `(a TYPE (key value)…)` and the like: from the form to code that makes the designator.
//!
//! A key is a symbol or a string. Values are parsed when the form is expanded: symbols become
//! keywords unless they are `?variables` or bound globally, lists are parsed item by item and never
//! called, and nested designator forms make designators.

use super::literal;
use super::schema::{self, Kind};
use super::value::{Class, Quantifier};
use crate::packages;
use lisp::builtin::Operator;
use lisp::image::Image;
use lisp::print;
use lisp::source::Place;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;
use lisp::value::symbol::{Sym, VariableKind};

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Maximum depth of nested values.
const MAX_NESTED: usize = 200;
/// Maximum length of a chain of globals whose values name further globals.
const MAX_CHAIN_LENGTH: usize = 32;

/// Macros of package `CRAM-DESIGNATORS`.
pub(crate) static OPERATORS: &[Operator] = &[
    Operator {
        name: "A",
        lambda_list: "type &rest properties",
        doc: "A description of an action, motion, object or location. In (key value) a symbol stands for the keyword, ?variables are evaluated.",
        examples: &["(desig:desig-prop-value (desig:a motion (type going)) :type) => :GOING"],
        expand: Some(expand_a),
    },
    Operator {
        name: "AN",
        lambda_list: "type &rest properties",
        doc: "The same as A.",
        examples: &["(desig:desig-prop-value (desig:an object (type bottle)) :type) => :BOTTLE"],
        expand: Some(expand_a),
    },
    Operator {
        name: "ALL",
        lambda_list: "types &rest properties",
        doc: "A description of all things that fit: (all objects (type bottle)).",
        examples: &["(desig:quantifier (desig:all objects (type bottle))) => :ALL"],
        expand: Some(expand_all),
    },
];

fn expand_a(image: &mut Image, form: &Value) -> Result<Value> {
    designator_form(image, form, Quantifier::A, 0)
}

fn expand_all(image: &mut Image, form: &Value) -> Result<Value> {
    designator_form(image, form, Quantifier::All, 0)
}

fn list(items: impl IntoIterator<Item = Value>) -> Value {
    Value::list(items.into_iter().collect::<Vec<_>>())
}

fn quote(value: Value) -> Value {
    list([known::QUOTE.into(), value])
}

/// `(make-from-form :a :object (list (list :key value) (if condition (list …)) …))`.
fn designator_form(
    image: &mut Image,
    form: &Value,
    quantifier: Quantifier,
    depth: usize,
) -> Result<Value> {
    let Some(items) = form.list_to_vec() else {
        return Err(Raise::program("A designator is a proper list."));
    };
    let (operator, kind, properties) = match items.as_slice() {
        [operator, kind, properties @ ..] => (operator, kind, properties),
        _ => {
            let name = print::to_string(image, &form.car_or_nil(), false);
            return Err(Raise::new(
                known::ARG_COUNT_ERROR,
                format!(
                    "Error while parsing arguments to DEFMACRO {name}: too few elements in () to satisfy lambda list (TYPE &REST PROPERTIES): at least 1 expected, but got 0. As in ({} motion (type going)).",
                    name.to_lowercase()
                ),
            ));
        }
    };
    let Some(kind) = kind.as_symbol() else {
        return Err(Raise::program(format!(
            "{} is not a kind of designator: one of ACTION, MOTION, OBJECT and LOCATION was expected after {}.",
            print::to_string(image, kind, true),
            print::to_string(image, operator, false),
        )));
    };
    let mut name = image.name(kind).to_owned();
    if quantifier == Quantifier::All {
        name = name.trim_end_matches(['S', 's']).to_owned();
    }
    if image.notes.is_some() {
        let name = name.to_uppercase();
        match Class::named(&name) {
            Some(class) => literal::note_mistakes(image, class, properties, place_of(form)),
            None => literal::note_unknown_class(image, &name, place_of(form)),
        }
    }
    let mut code = vec![Value::from(known::LIST)];
    for property in properties {
        code.push(property_code(image, &name, property, depth)?);
    }
    let maker = packages::symbol(image, "CRAM-DESIGNATORS", "DESIGNATOR-OF-FORM");
    let quantifier = image.keyword(quantifier.name());
    let class = image.keyword(&name.to_uppercase());
    Ok(list([
        maker.into(),
        quantifier.into(),
        class.into(),
        list(code),
    ]))
}

/// Code for a property list, or for `NIL` if a condition omits the property.
fn property_code(image: &mut Image, class: &str, property: &Value, depth: usize) -> Result<Value> {
    // A variable stands for a property, or for none.
    if let Some(variable) = property.as_symbol()
        && image.name(variable).starts_with('?')
    {
        return Ok(property.clone());
    }
    let items = property.list_to_vec().filter(|items| !items.is_empty());
    let Some(items) = items else {
        return Err(Raise::program(format!(
            "{} is not a property: a list (key value) was expected.",
            print::to_string(image, property, true)
        )));
    };
    if let [head, condition, inner @ ..] = items.as_slice()
        && head.as_symbol() == Some(known::WHEN)
    {
        let [inner] = inner else {
            return Err(Raise::program(
                "(when condition (key value)) takes exactly one property.",
            ));
        };
        let inner = property_code(image, class, inner, depth)?;
        return Ok(list([
            known::IF.into(),
            condition.clone(),
            inner,
            Value::NIL,
        ]));
    }
    let key = match &items[0] {
        Value::Symbol(sym, ..) => Value::from(keyword_of(image, *sym)),
        other => other.clone(),
    };
    let is_goal = key.as_symbol().is_some_and(|s| image.name(s) == "GOAL");
    check_number_of_values(image, class, &key, &items)?;
    let mut code = vec![Value::from(known::LIST), quote(key)];
    for value in &items[1..] {
        code.push(match is_goal {
            true => goal_code(image, value, depth + 1)?,
            false => value_code(image, value, depth + 1)?,
        });
    }
    Ok(list(code))
}

/// Signals an error for a property without a value, or with several where only the first one would
/// count.
fn check_number_of_values(
    image: &Image,
    class: &str,
    key: &Value,
    property: &[Value],
) -> Result<()> {
    let Some(key) = key.as_symbol().map(|key| image.name(key)) else {
        return Ok(());
    };
    let shown = |items: &[Value]| print::to_string(image, &Value::list(items.to_vec()), true);
    let few = key.to_lowercase();
    match property {
        [_] => Err(Raise::program(format!(
            "{} has no value: ({few} value) was expected.",
            shown(property)
        ))),
        [_, _, others @ ..] if !others.is_empty() && takes_one_value(image, class, key) => {
            Err(Raise::program(format!(
                "{} has {} values, and a designator has one {few}: ({few} value) was expected.",
                shown(property),
                property.len() - 1
            )))
        }
        _ => Ok(()),
    }
}

/// Does a key of a class of designators take one value, which is no list?
fn takes_one_value(image: &Image, class: &str, key: &str) -> bool {
    let Some(class) = Class::named(&class.to_uppercase()) else {
        return false;
    };
    let is_one = |kind: &Kind| {
        !matches!(
            kind,
            Kind::Objects | Kind::Keywords | Kind::List | Kind::Poses | Kind::Anything
        )
    };
    match class {
        _ if key == "TYPE" => true,
        Class::Object => schema::OBJECT_KEYS
            .iter()
            .any(|known| known.name == key && is_one(&known.kind)),
        Class::Location => schema::LOCATION_KEYS
            .iter()
            .any(|known| known.name == key && is_one(&known.kind)),
        Class::Human => false,
        Class::Action | Class::Motion => {
            let rows = schema::all(image, class);
            let mut kinds = rows.iter().filter_map(|row| row.key(key)).peekable();
            kinds.peek().is_some() && kinds.all(|known| is_one(&known.kind))
        }
    }
}

/// Code for a goal `(occasion argument…)`: the name of the occasion stays a symbol of its package.
fn goal_code(image: &mut Image, goal: &Value, depth: usize) -> Result<Value> {
    let head = goal.car_or_nil();
    let Value::Cons(cons) = goal else {
        return value_code(image, goal, depth);
    };
    let is_name = head
        .as_symbol()
        .is_some_and(|s| !image.name(s).starts_with('?'));
    if !is_name || !goal.is_list() {
        return value_code(image, goal, depth);
    }
    let mut code = vec![Value::from(known::LIST), quote(head)];
    for argument in cons.cdr().iter_list() {
        code.push(value_code(image, &argument, depth + 1)?);
    }
    Ok(list(code))
}

fn place_of(form: &Value) -> Place {
    form.as_cons().map_or(Place::NONE, |cons| cons.place())
}

fn keyword_of(image: &mut Image, sym: Sym) -> Sym {
    if image.is_keyword(sym) {
        return sym;
    }
    let name = image.name(sym).to_owned();
    image.keyword(&name)
}

/// Code for a value.
fn value_code(image: &mut Image, value: &Value, depth: usize) -> Result<Value> {
    if depth > MAX_NESTED {
        return Err(Raise::program("A designator is nested too deeply."));
    }
    match value {
        Value::Symbol(sym, ..) => Ok(symbol_code(image, *sym)),
        Value::Cons(cons) => match nested_quantifier(image, &cons.car(), value) {
            Some(quantifier) => designator_form(image, value, quantifier, depth),
            None => list_code(image, value, depth),
        },
        other => Ok(quote(other.clone())),
    }
}

fn list_code(image: &mut Image, value: &Value, depth: usize) -> Result<Value> {
    let mut code = vec![Value::from(known::LIST)];
    let mut items = value.iter_list();
    for item in items.by_ref() {
        code.push(value_code(image, &item, depth + 1)?);
    }
    if items.rest.is_nil() {
        return Ok(list(code));
    }
    let tail = value_code(image, &items.rest, depth + 1)?;
    code[0] = known::LIST_STAR.into();
    code.push(tail);
    Ok(list(code))
}

/// The quantifier (a, an, all, some, the) if this is the start of a nested designator.
pub(super) fn nested_quantifier(image: &Image, head: &Value, form: &Value) -> Option<Quantifier> {
    let quantifier = match image.name(head.as_symbol()?) {
        "A" | "AN" | "SOME" | "THE" => Quantifier::A,
        "ALL" => Quantifier::All,
        _ => return None,
    };
    let kind = form.cdr_or_nil().car_or_nil().as_symbol()?;
    let mut name = image.name(kind).to_uppercase();
    if quantifier == Quantifier::All {
        name = name.trim_end_matches('S').to_owned();
    }
    Class::named(&name).map(|_| quantifier)
}

/// `?variables` are evaluated; a globally bound symbol stands for its value; any other symbol
/// becomes the keyword.
fn symbol_code(image: &mut Image, sym: Sym) -> Value {
    if image.is_keyword(sym) {
        return sym.into();
    }
    if image.name(sym).starts_with('?') {
        return sym.into();
    }
    let mut sym = sym;
    for _ in 0..MAX_CHAIN_LENGTH {
        let data = image.symbol(sym);
        if data.value.is_unbound() || sym == known::NIL || sym == known::T {
            break;
        }
        match (&data.value, data.kind) {
            (Value::Symbol(next, ..), _) => sym = *next,
            (value, VariableKind::Constant | VariableKind::Special | VariableKind::Lexical) => {
                return quote(value.clone());
            }
        }
        if image.is_keyword(sym) {
            break;
        }
    }
    match sym {
        known::NIL | known::T => sym.into(),
        other => quote(keyword_of(image, other).into()),
    }
}

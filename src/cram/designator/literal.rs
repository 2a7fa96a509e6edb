//! Checks designators as written: unknown types, keys that a type does not take, values that a key does
//! not take. Mistakes become compiler notes; nothing is refused here, because a program may define
//! types of its own.

use super::literal_values;
use super::schema;
use super::schema::TypeRow;
use super::value::Class;
use crate::packages;
use crate::prolog::facts;
use closest_name::closest_name;
use lisp::image::Image;
use lisp::image::notes::NoteKind;
use lisp::source::Place;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::symbol::{FunctionCell, Sym, VariableKind};

/// Notes the mistakes in the properties of a designator of a class.
pub(crate) fn note_mistakes(image: &mut Image, class: Class, properties: &[Value], place: Place) {
    let written: Vec<(String, Value)> = properties
        .iter()
        .filter_map(|property| named(image, property))
        .collect();
    // What a template splices in is unknown.
    let is_whole = written.len() == properties.len();
    let mut mistakes = match class {
        Class::Action | Class::Motion if is_whole => of_type(image, class, &written),
        Class::Location => misspelt_keys(&written, "A location", schema::LOCATION_KEYS),
        Class::Object => misspelt_keys(&written, "An object", schema::OBJECT_KEYS),
        _ => Vec::new(),
    };
    for (key, value) in &written {
        if class == Class::Action && key == "GOAL" {
            image.note(place, || NoteKind::Goal(value.clone()));
        }
        match not_evaluated(image, key, value) {
            Some(mistake) => mistakes.push(mistake),
            None => mistakes.extend(literal_values::mistake(image, class, &written, key, value)),
        }
    }
    for (name, text) in mistakes {
        image.note(place, || NoteKind::Mistake { name, text });
    }
}

/// Key and value of a property, also inside `(when condition (key value))`.
fn named(image: &Image, property: &Value) -> Option<(String, Value)> {
    let head = property.car_or_nil();
    if head.as_symbol() == Some(known::WHEN) {
        let inner = property.cdr_or_nil().cdr_or_nil().car_or_nil();
        let key = inner.car_or_nil().as_symbol()?;
        return Some((name(image, key), inner.cdr_or_nil().car_or_nil()));
    }
    let key = head.as_symbol()?;
    Some((name(image, key), property.cdr_or_nil().car_or_nil()))
}

fn name(image: &Image, sym: Sym) -> String {
    image.name(sym).to_uppercase()
}

/// Whether a rule of a plan grounds actions or motions of a type.
fn is_grounded(image: &mut Image, class: Class, name: &str) -> bool {
    let functor = match class {
        Class::Motion => "MOTION-GROUNDING",
        _ => "ACTION-GROUNDING",
    };
    let functor = packages::symbol(image, "CRAM-DESIGNATORS", functor);
    facts::of(image).is_about(image, functor, name)
}

fn of_type(image: &mut Image, class: Class, written: &[(String, Value)]) -> Vec<(String, String)> {
    let kind = class.name().to_lowercase();
    let given = written.iter().find(|(key, _)| key == "TYPE");
    if given.is_none() {
        return without_type(image, class, &kind, written);
    }
    let Some(given) = given.and_then(|(_, value)| literal_name(image, value)) else {
        return Vec::new();
    };
    let rows = schema::rows(image, class, &given);
    if rows.is_empty() {
        if is_grounded(image, class, &given) {
            return Vec::new();
        }
        let near = schema::nearest_type(image, class, &given);
        let text = asking(
            format!("There is no {kind} of type {given}"),
            near.as_deref(),
        );
        return vec![(given, text)];
    }
    let is_known = |key: &str| {
        schema::COMMON_KEYS.contains(&key) || rows.iter().any(|row| row.key(key).is_some())
    };
    let mut mistakes: Vec<(String, String)> = written
        .iter()
        .filter(|(key, _)| !is_known(key))
        .map(|(key, _)| {
            let near = closest_name(key, rows.iter().flat_map(|row| row.key_names()));
            let text = format!("The {kind} {given} has no key {key}");
            (key.clone(), asking(text, near))
        })
        .collect();
    let lacking = |row: &TypeRow| row.lacking(|name| written.iter().any(|(key, _)| key == name));
    if mistakes.is_empty()
        && rows.iter().all(|row| lacking(row).is_some())
        && let Some(needed) = rows.first().and_then(|row| lacking(row))
    {
        let text = format!("The {kind} {given} needs {needed}.");
        mistakes.push((class.name().to_owned(), text));
    }
    mistakes
}

/// What is wrong with an action or a motion without a type: a key that may be it.
fn without_type(
    image: &Image,
    class: Class,
    kind: &str,
    written: &[(String, Value)],
) -> Vec<(String, String)> {
    let is_a_type = |value: &Value| {
        let name = literal_name(image, value);
        name.is_some_and(|name| schema::is_type(image, class, &name))
    };
    let meant = written
        .iter()
        .find(|(key, value)| is_a_type(value) && closest_name(key, ["TYPE"]).is_some());
    let meant = meant.map(|(key, _)| {
        let text = asking(format!("The {kind} has no key {key}"), Some("TYPE"));
        (key.clone(), text)
    });
    meant.into_iter().collect()
}

/// Notes the name of a kind of designators that there is not.
pub(crate) fn note_unknown_class(image: &mut Image, name: &str, place: Place) {
    let names = Class::ALL.map(Class::name);
    let near = closest_name(name, names);
    let text = asking(format!("There are no designators of kind {name}"), near);
    let name = name.to_owned();
    image.note(place, || NoteKind::Mistake { name, text });
}

/// Keys of a class that nearly are known ones. Others may be those of a user's own rules.
fn misspelt_keys(
    written: &[(String, Value)],
    what: &str,
    keys: &[schema::Key],
) -> Vec<(String, String)> {
    let names = || keys.iter().map(|key| &*key.name);
    let unknown = written.iter().filter(|(key, _)| {
        !schema::COMMON_KEYS.contains(&key.as_str()) && !names().any(|name| name == key)
    });
    unknown
        .filter_map(|(key, _)| {
            let near = closest_name(key, names())?;
            let text = asking(format!("{what} has no key {key}"), Some(near));
            Some((key.clone(), text))
        })
        .collect()
}

/// The name that a plain symbol stands for, unless it is a `?variable` or a global.
pub(super) fn literal_name(image: &Image, value: &Value) -> Option<String> {
    let sym = value.as_symbol()?;
    if image.is_keyword(sym) {
        return Some(image.name(sym).to_owned());
    }
    let data = image.symbol(sym);
    let is_global = !data.value.is_unbound() || data.kind != VariableKind::Lexical;
    (!is_global && !data.name.starts_with('?')).then(|| name(image, sym))
}

/// Why a value is not evaluated as it may seem, and the name that is wrong: it is quoted, or looks like a call.
fn not_evaluated(image: &Image, key: &str, value: &Value) -> Option<(String, String)> {
    let head = value.as_cons()?.car().as_symbol()?;
    let wrong = key.to_owned();
    let key = key.to_lowercase();
    let remedy = format!("bind a variable such as ?{key} and write ({key} ?{key}).");
    if matches!(head, known::QUOTE | known::FUNCTION) {
        let text = "Nothing is quoted inside a designator";
        let quoted = value.cdr_or_nil().car_or_nil().as_symbol();
        return Some(match quoted.filter(|_| head == known::QUOTE) {
            Some(quoted) => {
                let quoted = name(image, quoted);
                (
                    format!("'{quoted}"),
                    format!("{text}; did you mean {quoted}?"),
                )
            }
            None => (wrong, format!("{text}: {remedy}")),
        });
    }
    let is_function = matches!(image.symbol(head).function, FunctionCell::Function(_));
    let is_nested = matches!(image.name(head), "A" | "AN" | "ALL" | "SOME" | "THE");
    (is_function && !is_nested).then(|| {
        let name = image.name(head).to_lowercase();
        let text = format!("({name} …) is not called inside a designator: {remedy}");
        (wrong, text)
    })
}

/// A finding, with the name that was probably meant.
fn asking(text: String, near: Option<&str>) -> String {
    match near {
        Some(near) => format!("{text}; did you mean {near}?"),
        None => format!("{text}."),
    }
}

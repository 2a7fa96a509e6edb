//! Grounding: from an action or motion designator to the plan or motion of the schema.

use std::rc::Rc;

use super::check;
use super::failure::Unresolved;
use super::schema;
use super::schema::{Kind, TypeRow};
use super::value;
use super::value::{Class, Designator};
use crate::pose::value::as_pose_stamped;
use closest_name::closest_name;
use lisp::image::Image;
use lisp::print;
use lisp::value::Value;
use lisp::value::raise::Raise;

/// Why a designator cannot be grounded.
pub(crate) enum Refusal {
    /// A value has the wrong type, which is an error of its own.
    Error(Box<Raise>),
    /// There is no such type of action or motion.
    UnknownType(Unresolved),
    /// The type is known but something is missing or unknown.
    Incomplete(Unresolved),
}

impl Refusal {
    /// The reason, unless it is an error.
    pub(crate) fn reason(self) -> Result<Unresolved, Box<Raise>> {
        match self {
            Refusal::Error(raise) => Err(raise),
            Refusal::UnknownType(why) | Refusal::Incomplete(why) => Ok(why),
        }
    }
}

/// An action or motion whose type is known and whose keys are valid.
pub(crate) struct Grounding {
    /// The row of the schema.
    pub row: Rc<TypeRow>,
    /// Keys in upper case, aliases resolved, with their values; the type is not included.
    pub properties: Vec<(String, Value)>,
}

/// Finds the row of the schema that matches the designator.
pub(crate) fn ground(image: &mut Image, designator: &Designator) -> Result<Grounding, Refusal> {
    let class = designator.class;
    let kind = class.name().to_lowercase();
    let Some(type_name) = designator.type_name(image) else {
        return Err(Refusal::UnknownType(Unresolved::new(format!(
            "The {kind} has no type: write (type …), as in (type going)."
        ))));
    };
    let rows = schema::rows(image, class, &type_name);
    let Some(first) = rows.first() else {
        return Err(Refusal::UnknownType(unknown_type(image, class, &type_name)));
    };
    // Of several that fit, the one that knows more of the keys.
    let fitting = rows
        .iter()
        .filter(|row| missing(image, designator, row).is_none())
        .min_by_key(|row| unknown_keys(image, designator, row));
    let row = fitting.unwrap_or(first).clone();
    check::check_row(image, designator, &row).map_err(Refusal::Error)?;
    if let Some(why) = missing(image, designator, &row) {
        return Err(match row.is_known_by_keys {
            true => Refusal::UnknownType(why),
            false => Refusal::Incomplete(why),
        });
    }
    let why = mistyped_key(image, designator, &row)
        .or_else(|| needless_object(image, designator, &row))
        .or_else(|| not_detected(image, designator, &row));
    if let Some(why) = why {
        return Err(Refusal::Incomplete(why));
    }
    let properties = properties(image, designator, &row);
    Ok(Grounding { row, properties })
}

fn unknown_type(image: &Image, class: Class, name: &str) -> Unresolved {
    let kind = class.name().to_lowercase();
    let suggestion = schema::nearest_type(image, class, name);
    let mut reason = format!("There is no {kind} of type {name}");
    match &suggestion {
        Some(near) => reason.push_str(&format!("; did you mean {near}?")),
        None => {
            let other = match class {
                Class::Action => Class::Motion,
                _ => Class::Action,
            };
            if schema::is_type(image, other, name) {
                let article = if other == Class::Action { "an" } else { "a" };
                let kind = other.name().to_lowercase();
                reason.push_str(&format!("; there is {article} {kind} of that type."));
            } else {
                reason.push('.');
            }
        }
    }
    Unresolved { reason, suggestion }
}

/// What is required but missing.
fn missing(image: &Image, designator: &Designator, row: &TypeRow) -> Option<Unresolved> {
    let kind = row.class.name().to_lowercase();
    let lacking = row.lacking(|name| designator.property_named(image, name).is_some())?;
    let reason = format!("The {kind} {} needs {lacking}", row.name);
    match unknown_key(image, designator, row) {
        Some((written, near)) => Some(Unresolved {
            reason: format!("{reason}; did you mean {near} by {written}?"),
            suggestion: Some(near),
        }),
        None => Some(Unresolved::new(format!("{reason}."))),
    }
}

/// The number of keys that are not in the row.
fn unknown_keys(image: &Image, designator: &Designator, row: &TypeRow) -> usize {
    let properties = designator.properties();
    let names = properties
        .iter()
        .filter_map(|(key, _)| key.as_symbol().map(|sym| image.name(sym)));
    names
        .filter(|name| row.key(name).is_none() && !schema::COMMON_KEYS.contains(name))
        .count()
}

/// A key that is not in the row but similar to one that is.
fn unknown_key(image: &Image, designator: &Designator, row: &TypeRow) -> Option<(String, String)> {
    designator.properties().iter().find_map(|(key, _)| {
        let name = image.name(key.as_symbol()?);
        if row.key(name).is_some() || schema::COMMON_KEYS.contains(&name) {
            return None;
        }
        let near = closest_name(name, row.key_names())?;
        Some((name.to_owned(), near.to_owned()))
    })
}

fn mistyped_key(image: &Image, designator: &Designator, row: &TypeRow) -> Option<Unresolved> {
    let (written, near) = unknown_key(image, designator, row)?;
    Some(Unresolved {
        reason: format!(
            "The {} {} has no key {written}; did you mean {near}?",
            row.class.name().to_lowercase(),
            row.name
        ),
        suggestion: Some(near),
    })
}

/// Refuses an object given to a type that takes none: it must not be ignored silently.
fn needless_object(image: &Image, designator: &Designator, row: &TypeRow) -> Option<Unresolved> {
    if row.key("OBJECT").is_some() {
        return None;
    }
    let object = designator.property_named(image, "OBJECT")?;
    value::as_class(&object, Class::Object)?;
    Some(Unresolved::new(format!(
        "The {} {} cannot act on an object: it was given {}.",
        row.class.name().to_lowercase(),
        row.name,
        print::to_string(image, &object, false)
    )))
}

/// Refuses an object that has not been detected for a key that requires it.
fn not_detected(image: &Image, designator: &Designator, row: &TypeRow) -> Option<Unresolved> {
    let mut keys = row.keys.iter().filter(|k| k.kind == Kind::DetectedObject);
    keys.find_map(|key| {
        let mut given = key
            .names()
            .filter_map(|n| designator.property_named(image, n));
        lacks_detection(image, &given.next()?)
    })
}

fn lacks_detection(image: &Image, object: &Value) -> Option<Unresolved> {
    let current = value::current(object);
    let object = value::as_designator(&current)?;
    let lacks = ["TYPE", "NAME", "POSE"]
        .into_iter()
        .find(|key| object.property_named(image, key).is_none_or(|v| v.is_nil()))?;
    Some(Unresolved::new(format!(
        "The object has no {}: detect it first, as in (perform (an action (type detecting) (object (an object (type bottle))))), and pick up what that returns.",
        lacks.to_lowercase()
    )))
}

fn properties(image: &mut Image, designator: &Designator, row: &TypeRow) -> Vec<(String, Value)> {
    let mut properties: Vec<(String, Value)> = Vec::new();
    for (key, values) in designator.properties() {
        let Some(written) = key.as_symbol().map(|s| image.name(s).to_owned()) else {
            continue;
        };
        if written == "TYPE" || written == "GOAL" {
            continue;
        }
        let mut value = values.car_or_nil();
        let known = row.key(&written);
        if known.is_some_and(|k| k.kind == Kind::Place) && as_pose_stamped(&value).is_some() {
            value = value::make(image, Class::Location, &[("POSE", value)]);
        }
        let name = known.map_or(written, |k| k.name.to_string());
        if !properties.iter().any(|(n, _)| *n == name) {
            properties.push((name, value));
        }
    }
    properties
}

/// The call of an action's plan: the function and keyword arguments.
pub(crate) fn plan_call(image: &mut Image, grounding: &Grounding) -> (Value, Vec<Value>) {
    let mut args = Vec::new();
    for (name, value) in &grounding.properties {
        args.push(image.keyword(name).into());
        args.push(value.clone());
    }
    (grounding.row.plan.into(), args)
}

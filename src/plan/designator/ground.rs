//! From an action or motion designator to the plan or motion of the schema.

use super::check;
use super::failure::Unresolved;
use super::schema;
use super::schema::{Kind, TypeRow};
use super::value;
use super::value::{Class, Designator};
use crate::closest_name::closest_name;
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::raise::Raise;
use crate::plan::pose::value::as_pose_stamped;

/// Why a designator is not grounded.
pub(crate) enum Refusal {
    /// A value is of a wrong type: an error of its own.
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

/// An action or motion whose type is known and whose keys fit.
pub(crate) struct Grounding {
    /// The row of the schema.
    pub(crate) row: &'static TypeRow,
    /// Keys in upper case, aliases resolved, with their values; the type is not among them.
    pub(crate) properties: Vec<(String, Value)>,
}

/// Finds the row of the schema that fits the designator.
pub(crate) fn ground(image: &mut Image, designator: &Designator) -> Result<Grounding, Refusal> {
    let class = designator.class;
    let kind = class.name().to_lowercase();
    let Some(type_name) = designator.type_name(image) else {
        return Err(Refusal::UnknownType(Unresolved::new(format!(
            "The {kind} has no type: write (type …), as in (type going)."
        ))));
    };
    let rows: Vec<&'static TypeRow> = schema::rows(class, &type_name).collect();
    let Some(first) = rows.first() else {
        return Err(Refusal::UnknownType(unknown_type(class, &type_name)));
    };
    let row = rows
        .iter()
        .find(|row| missing(image, designator, row).is_none())
        .unwrap_or(first);
    check::check_row(image, designator, row).map_err(Refusal::Error)?;
    if let Some(why) = missing(image, designator, row) {
        return Err(Refusal::Incomplete(why));
    }
    if let Some(why) = mistyped_key(image, designator, row) {
        return Err(Refusal::Incomplete(why));
    }
    if row.plan == "PICK-UP"
        && let Some(why) = not_detected(image, designator)
    {
        return Err(Refusal::Incomplete(why));
    }
    let properties = properties(image, designator, row);
    Ok(Grounding { row, properties })
}

fn unknown_type(class: Class, name: &str) -> Unresolved {
    let kind = class.name().to_lowercase();
    let suggestion = schema::nearest_type(class, name);
    let mut reason = format!("There is no {kind} of type {name}");
    match suggestion {
        Some(near) => reason.push_str(&format!("; did you mean {near}?")),
        None => {
            let other = match class {
                Class::Action => Class::Motion,
                _ => Class::Action,
            };
            if schema::rows(other, name).next().is_some() {
                let article = if other == Class::Action { "an" } else { "a" };
                let kind = other.name().to_lowercase();
                reason.push_str(&format!("; there is {article} {kind} of that type."));
            } else {
                reason.push('.');
            }
        }
    }
    Unresolved {
        reason,
        suggestion: suggestion.map(str::to_owned),
    }
}

fn has_key(image: &Image, designator: &Designator, row: &'static TypeRow, name: &str) -> bool {
    let Some(key) = row.key(name) else {
        return false;
    };
    std::iter::once(key.name)
        .chain(key.aliases.iter().copied())
        .any(|n| designator.property_named(image, n).is_some())
}

/// The first required key that is not there.
fn missing(image: &Image, designator: &Designator, row: &'static TypeRow) -> Option<Unresolved> {
    let kind = row.class.name().to_lowercase();
    let lacking = row
        .keys
        .iter()
        .find(|key| key.is_required && !has_key(image, designator, row, key.name));
    let reason = match lacking {
        Some(key) => format!(
            "The {kind} {} needs ({} …): {}",
            row.name,
            key.name.to_lowercase(),
            key.doc
        ),
        None if row.one_of.is_empty() => return None,
        None if row
            .one_of
            .iter()
            .any(|name| has_key(image, designator, row, name)) =>
        {
            return None;
        }
        None => {
            let names: Vec<String> = row.one_of.iter().map(|n| n.to_lowercase()).collect();
            format!("The {kind} {} needs one of {}", row.name, names.join(", "))
        }
    };
    match unknown_key(image, designator, row) {
        Some((written, near)) => Some(Unresolved {
            reason: format!("{reason}; did you mean {near} by {written}?"),
            suggestion: Some(near.to_owned()),
        }),
        None => Some(Unresolved::new(format!("{reason}."))),
    }
}

/// A key that the row does not know but that is near to one it knows.
fn unknown_key(
    image: &Image,
    designator: &Designator,
    row: &'static TypeRow,
) -> Option<(String, &'static str)> {
    designator.properties().iter().find_map(|(key, _)| {
        let name = image.name(key.as_symbol()?);
        if row.key(name).is_some() || schema::COMMON_KEYS.contains(&name) {
            return None;
        }
        let near = closest_name(name, schema::key_names(row))?;
        Some((name.to_owned(), near))
    })
}

fn mistyped_key(
    image: &Image,
    designator: &Designator,
    row: &'static TypeRow,
) -> Option<Unresolved> {
    let (written, near) = unknown_key(image, designator, row)?;
    Some(Unresolved {
        reason: format!(
            "The {} {} has no key {written}; did you mean {near}?",
            row.class.name().to_lowercase(),
            row.name
        ),
        suggestion: Some(near.to_owned()),
    })
}

/// An object to grasp must have been detected.
fn not_detected(image: &Image, designator: &Designator) -> Option<Unresolved> {
    let object = designator.property_named(image, "OBJECT")?;
    let current = value::current(&object);
    let object = value::as_designator(&current)?;
    let lacks = ["TYPE", "NAME", "POSE"]
        .into_iter()
        .find(|key| object.property_named(image, key).is_none_or(|v| v.is_nil()))?;
    Some(Unresolved::new(format!(
        "The object has no {}: detect it first, as in (perform (an action (type detecting) (object (an object (type bottle))))), and pick up what that returns.",
        lacks.to_lowercase()
    )))
}

fn properties(
    image: &mut Image,
    designator: &Designator,
    row: &'static TypeRow,
) -> Vec<(String, Value)> {
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
        let name = known.map_or(written, |k| k.name.to_owned());
        if !properties.iter().any(|(n, _)| *n == name) {
            properties.push((name, value));
        }
    }
    properties
}

/// The call of the plan: its name in `PP-PLANS` and keyword arguments.
pub(crate) fn plan_call(image: &mut Image, grounding: &Grounding) -> (Value, Vec<Value>) {
    let package =
        crate::plan::packages::ensure(image, "CRAM-MOBILE-PICK-PLACE-PLANS", &["PP-PLANS"]);
    let plan = image.intern(package, grounding.row.plan);
    let mut args = Vec::new();
    for (name, value) in &grounding.properties {
        args.push(image.keyword(name).into());
        args.push(value.clone());
    }
    (plan.into(), args)
}

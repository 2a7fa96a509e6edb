//! Values of a location's properties, and errors that show them as users write them.

use crate::simulation::names::name_text;
use closest_name::closest_name;
use cram::designator::value::Designator;
use lisp::image::Image;
use lisp::print;
use lisp::value::Value;
use lisp::value::number;
use lisp::value::raise::Raise;
use robotics::world::WorldError;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// An error of the world as a condition.
pub(super) fn raised(error: &WorldError) -> Box<Raise> {
    let text = error.to_string();
    let end = if text.ends_with(['?', '.']) { "" } else { "." };
    Raise::simple(text + end)
}

/// All values of a property, of all properties with that key, also those in lists.
pub(super) fn values(image: &Image, designator: &Designator, key: &str) -> Vec<Value> {
    let properties = designator.properties().into_iter();
    properties
        .filter(|(k, _)| k.as_symbol().is_some_and(|s| image.name(s) == key))
        .flat_map(|(_, values)| values.iter_list().collect::<Vec<_>>())
        .flat_map(|value| match &value {
            Value::Cons(_) => value.iter_list().collect(),
            _ => vec![value],
        })
        .collect()
}

/// A property as users write it.
pub(super) fn written(image: &Image, key: &str, value: &Value) -> String {
    let value = match value.as_symbol() {
        Some(sym) => image.name(sym).to_lowercase(),
        None => print::to_string(image, value, false),
    };
    format!("({} {value})", key.to_lowercase())
}

/// The distance (m) that a property gives.
pub(super) fn metres(image: &Image, key: &str, value: &Value) -> Result<f64> {
    let number = number::to_f64(value).filter(|x| x.is_finite() && *x >= 0.0);
    number.ok_or_else(|| {
        Raise::simple(format!(
            "{} is no distance: a number of metres, not below 0, was expected.",
            written(image, key, value)
        ))
    })
}

/// One of several names that a property takes.
pub(super) fn one_of<T: Copy>(
    image: &Image,
    (key, value): (&str, &Value),
    choices: &[T],
    name: fn(T) -> &'static str,
) -> std::result::Result<T, String> {
    let text = name_text(image, value).unwrap_or_default().to_lowercase();
    let found = choices.iter().find(|choice| name(**choice) == text);
    found.copied().ok_or_else(|| {
        let names: Vec<&str> = choices.iter().map(|choice| name(*choice)).collect();
        let near = closest_name(&text, names.iter().copied());
        let near = near.map_or_else(String::new, |near| format!("; did you mean {near}?"));
        let end = if near.is_empty() { "." } else { &near };
        format!(
            "{}: one of {} was expected{end}",
            written(image, key, value),
            names.join(", ")
        )
    })
}

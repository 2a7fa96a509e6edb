//! Names of objects and types: symbols for users, strings in the world.

use super::Simulation;
use closest_name::closest_name;
use lisp::image::Image;
use lisp::print;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;

/// The text of a name given as symbol or string, in upper case, with `_` read as `-`.
pub(crate) fn name_text(image: &Image, name: &Value) -> Option<String> {
    let text = match name {
        Value::Symbol(sym, ..) if name.is_true() => image.name(*sym).to_owned(),
        Value::Str(s) => s.text(),
        _ => return None,
    };
    Some(text.to_uppercase().replace('_', "-"))
}

/// The name of a type in the object library: lower case, with `_` read as `-`.
pub(crate) fn type_text(image: &Image, name: &Value) -> Option<String> {
    name_text(image, name).map(|text| text.to_lowercase())
}

/// The same; an error if the value is no name.
pub(crate) fn type_text_of(image: &Image, name: &Value) -> Result<String, Box<Raise>> {
    type_text(image, name).ok_or_else(|| Raise::type_error(name, known::SYMBOL))
}

/// The keyword of a type of the object library.
pub(crate) fn type_keyword(image: &mut Image, name: &str) -> Value {
    image.keyword(&name.to_uppercase()).into()
}

/// "; did you mean X?" if a name is similar.
pub(crate) fn suggestion<'a>(
    wanted: &str,
    names: impl IntoIterator<Item = &'a str>,
    show: impl Fn(&str) -> String,
) -> String {
    match closest_name(wanted, names) {
        Some(name) => format!("; did you mean {}?", show(name)),
        None => String::new(),
    }
}

impl Simulation {
    /// The name in the world of an existing object.
    pub(crate) fn object_named(&self, image: &Image, name: &Value) -> Result<String, Box<Raise>> {
        let Some(text) = name_text(image, name) else {
            return Err(Raise::type_error(name, known::SYMBOL));
        };
        if self.world.object(&text).is_ok() {
            return Ok(text);
        }
        let shown = print::to_string(image, name, true);
        let near = suggestion(&text, self.names.keys().map(String::as_str), str::to_owned);
        let known: Vec<&str> = self.names.keys().map(String::as_str).collect();
        let remedy = match (near.is_empty(), known.is_empty()) {
            (false, _) => near,
            (true, false) => format!("; there are {}.", known.join(", ")),
            (true, true) => "; there are none: use spawn-object.".to_owned(),
        };
        Err(Raise::simple(format!(
            "There is no object named {shown}{remedy}"
        )))
    }

    /// The symbol by which users know an object.
    pub(crate) fn symbol_of(&self, name: &str) -> Value {
        self.names.get(name).cloned().unwrap_or(Value::NIL)
    }
}

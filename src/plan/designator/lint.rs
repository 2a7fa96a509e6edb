//! Mistakes in designator forms that can be told without running anything: unknown kinds,
//! types and keys, quoted values, and calls that would not be calls.

use std::collections::BTreeSet;

use super::schema;
use super::schema::TypeRow;
use super::value::{Class, Quantifier};
use crate::closest_name::closest_name;
use crate::lisp::image::Image;
use crate::lisp::print;
use crate::lisp::source::Place;
use crate::lisp::value::Value;
use crate::lisp::value::known;
use crate::lisp::value::symbol::{FunctionCell, Sym};
use crate::plan::packages;

/// A mistake.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Mistake {
    /// Where the form stands.
    pub(crate) place: Place,
    /// What is wrong.
    pub(crate) message: String,
}

/// The search for mistakes in the forms of one text, in order: types that its fact groups
/// ground are known afterwards.
pub(crate) struct Lint {
    makers: [(Sym, Quantifier); 3],
    types: BTreeSet<String>,
}

impl Lint {
    /// A search that knows the types of the schema.
    pub(crate) fn new(image: &mut Image) -> Lint {
        let maker = |image: &mut Image, name| packages::symbol(image, "CRAM-DESIGNATORS", name);
        Lint {
            makers: [
                (maker(image, "A"), Quantifier::A),
                (maker(image, "AN"), Quantifier::A),
                (maker(image, "ALL"), Quantifier::All),
            ],
            types: BTreeSet::new(),
        }
    }

    /// The mistakes of a form and all forms in it, in order.
    pub(crate) fn form(&mut self, image: &Image, form: &Value) -> Vec<Mistake> {
        let mut mistakes = Vec::new();
        let mut pending = vec![form.clone()];
        while let Some(form) = pending.pop() {
            let Value::Cons(cons) = &form else {
                continue;
            };
            match cons.car().as_symbol() {
                Some(known::QUOTE) => continue,
                Some(sym) if image.name(sym) == "DEF-FACT-GROUP" => {
                    self.learn_types(image, &form);
                    continue;
                }
                Some(sym) => {
                    if let Some((_, quantifier)) = self.makers.iter().find(|(s, _)| *s == sym) {
                        self.designator(image, &form, *quantifier, &mut mistakes);
                    }
                }
                None => {}
            }
            // The last one pushed comes first.
            let mut items: Vec<Value> = form.iter_list().collect();
            items.reverse();
            pending.extend(items);
        }
        mistakes
    }

    /// Types that rules name: every `(:type :name)` in a fact group.
    fn learn_types(&mut self, image: &Image, group: &Value) {
        let mut pending = vec![group.clone()];
        while let Some(form) = pending.pop() {
            if !matches!(form, Value::Cons(_)) {
                continue;
            }
            let head = form.car_or_nil().as_symbol();
            if head.is_some_and(|s| image.name(s) == "TYPE")
                && let Some(name) = form.cdr_or_nil().car_or_nil().as_symbol()
            {
                self.types.insert(image.name(name).to_owned());
            }
            pending.extend(form.iter_list());
        }
    }

    fn designator(
        &self,
        image: &Image,
        form: &Value,
        quantifier: Quantifier,
        mistakes: &mut Vec<Mistake>,
    ) {
        let place = place_of(form);
        let mut say = |place: Place, message: String| mistakes.push(Mistake { place, message });
        let rest = form.cdr_or_nil();
        let Some(kind) = rest.car_or_nil().as_symbol() else {
            return;
        };
        let mut name = image.name(kind).to_uppercase();
        if quantifier == Quantifier::All {
            name = name.trim_end_matches('S').to_owned();
        }
        let Some(class) = Class::named(&name) else {
            let near = closest_name(&name, Class::ALL.map(Class::name));
            let near = near.map_or_else(String::new, |n| format!("; did you mean {n}?"));
            say(
                place,
                format!("There is no designator of kind {name}{near}"),
            );
            return;
        };
        let properties: Vec<Value> = rest.cdr_or_nil().iter_list().map(unwrapped).collect();
        for property in &properties {
            if !matches!(property, Value::Cons(_)) {
                let shown = print::to_string(image, property, true);
                say(
                    place,
                    format!("{shown} is not a property: (key value) was expected"),
                );
                return;
            }
            for value in property.cdr_or_nil().iter_list() {
                if let Some(message) = not_evaluated(image, property, &value) {
                    say(place_of(property), message);
                }
            }
        }
        // A template's spliced properties are not known.
        let is_template = properties.iter().any(|p| {
            let head = p.car_or_nil().as_symbol();
            matches!(head, Some(known::UNQUOTE | known::UNQUOTE_SPLICING))
        });
        if !is_template && matches!(class, Class::Action | Class::Motion) {
            self.typed(image, class, form, &properties, mistakes);
        }
    }

    /// Checks type and keys of an action or motion.
    fn typed(
        &self,
        image: &Image,
        class: Class,
        form: &Value,
        properties: &[Value],
        mistakes: &mut Vec<Mistake>,
    ) {
        let kind = class.name().to_lowercase();
        let key_of = |p: &Value| {
            p.car_or_nil()
                .as_symbol()
                .map(|s| image.name(s).to_uppercase())
        };
        let Some(property) = properties
            .iter()
            .find(|p| key_of(p).as_deref() == Some("TYPE"))
        else {
            return;
        };
        let Some(type_name) = constant_name(image, &property.cdr_or_nil().car_or_nil()) else {
            return;
        };
        if self.types.contains(&type_name) {
            return;
        }
        let rows: Vec<&'static TypeRow> = schema::rows(class, &type_name).collect();
        let keys: Vec<String> = properties.iter().filter_map(key_of).collect();
        let Some(row) = rows
            .iter()
            .find(|row| lacking(row, &keys).is_none())
            .or(rows.first())
        else {
            let near = schema::nearest_type(class, &type_name);
            let near = near.map_or_else(String::new, |n| format!("; did you mean {n}?"));
            mistakes.push(Mistake {
                place: place_of(property),
                message: format!("There is no {kind} of type {type_name}{near}"),
            });
            return;
        };
        for property in properties {
            let Some(key) = key_of(property) else {
                continue;
            };
            if row.key(&key).is_some() || schema::COMMON_KEYS.contains(&key.as_str()) {
                continue;
            }
            if let Some(near) = closest_name(&key, schema::key_names(row)) {
                mistakes.push(Mistake {
                    place: place_of(property),
                    message: format!(
                        "The {kind} {} has no key {key}; did you mean {near}?",
                        row.name
                    ),
                });
                return;
            }
        }
        if let Some(needed) = lacking(row, &keys) {
            mistakes.push(Mistake {
                place: place_of(form),
                message: format!("The {kind} {} needs {needed}", row.name),
            });
        }
    }
}

/// The key that a row demands and that is not there.
fn lacking(row: &'static TypeRow, keys: &[String]) -> Option<String> {
    let is_there = |name: &str| {
        row.key(name).is_some_and(|key| {
            keys.iter()
                .any(|k| k == key.name || key.aliases.contains(&k.as_str()))
        })
    };
    let missing = row.keys.iter().find(|k| k.is_required && !is_there(k.name));
    if let Some(key) = missing {
        return Some(format!("({} …): {}", key.name.to_lowercase(), key.doc));
    }
    if row.one_of.is_empty() || row.one_of.iter().any(|name| is_there(name)) {
        return None;
    }
    let names: Vec<String> = row.one_of.iter().map(|n| n.to_lowercase()).collect();
    Some(format!("one of {}", names.join(", ")))
}

/// `(when condition (key value))` is about `(key value)`.
fn unwrapped(property: Value) -> Value {
    let mut property = property;
    while property.car_or_nil().as_symbol() == Some(known::WHEN) {
        property = property.cdr_or_nil().cdr_or_nil().car_or_nil();
    }
    property
}

/// The name that a symbol stands for, unless it is a variable.
fn constant_name(image: &Image, value: &Value) -> Option<String> {
    let sym = value.as_symbol()?;
    let name = image.name(sym);
    let is_variable = name.starts_with('?') || (name.starts_with('*') && name.len() > 1);
    let is_bound = !image.is_keyword(sym) && !image.symbol(sym).value.is_unbound();
    (!is_variable && !is_bound).then(|| name.to_owned())
}

/// Why a value is not what it seems: it is quoted, or looks like a call.
fn not_evaluated(image: &Image, property: &Value, value: &Value) -> Option<String> {
    let Value::Cons(cons) = value else {
        return None;
    };
    let key = property.car_or_nil().as_symbol()?;
    let key = image.name(key).to_lowercase();
    let head = cons.car().as_symbol()?;
    let remedy = format!("bind a variable such as ?{key} and write ({key} ?{key})");
    if matches!(head, known::QUOTE | known::FUNCTION) {
        return Some(format!("Nothing is quoted inside a designator: {remedy}"));
    }
    let is_function = matches!(image.symbol(head).function, FunctionCell::Function(_));
    let is_nested = matches!(image.name(head), "A" | "AN" | "ALL" | "SOME" | "THE");
    if is_function && !is_nested {
        let name = image.name(head).to_lowercase();
        return Some(format!(
            "({name} …) is not called inside a designator: {remedy}"
        ));
    }
    None
}

fn place_of(form: &Value) -> Place {
    form.as_cons().map_or(Place::NONE, |cons| cons.place())
}

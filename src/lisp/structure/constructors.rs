//! The constructors of a structure, as forms.

use super::options::Constructor;
use crate::image::Image;
use crate::value::Value;
use crate::value::class::StructureSlot;
use crate::value::form::form;
use crate::value::known;
use crate::value::symbol::Sym;

/// The form that defines a constructor; `make` builds the form that makes the structure
/// from the forms of the slot values.
pub(crate) fn constructor_form(
    image: &mut Image,
    constructor: &Constructor,
    slots: &[StructureSlot],
    make: impl FnOnce(Vec<Value>) -> Value,
) -> Value {
    let (lambda_list, values) = match &constructor.lambda_list {
        None => by_keywords(image, slots),
        Some(lambda_list) => by_order(image, lambda_list, slots),
    };
    form![known::DEFUN, constructor.name, lambda_list, make(values),]
}

/// `(&key (slot default)…)`. The variables are fresh symbols, so that no default form sees a slot.
fn by_keywords(image: &mut Image, slots: &[StructureSlot]) -> (Value, Vec<Value>) {
    let mut parameters = vec![Value::symbol(known::L_KEY)];
    let mut values = Vec::new();
    for slot in slots {
        let name = image.name(slot.name).to_owned();
        let keyword = image.keyword(&name);
        let variable = image.symbols.make_for_program(name.into());
        parameters.push(form![
            form![keyword, variable.clone()],
            slot.initform.clone()
        ]);
        values.push(variable);
    }
    (Value::list(parameters), values)
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Section {
    Required,
    Optional,
    Rest,
    Key,
    Aux,
}

/// A lambda list by order of arguments: optional and keyword parameters without a default take that
/// of the slot of the same name; slots that are not parameters take their own.
fn by_order(
    image: &mut Image,
    lambda_list: &Value,
    slots: &[StructureSlot],
) -> (Value, Vec<Value>) {
    let mut section = Section::Required;
    let mut parameters = Vec::new();
    // Variables that hold slot values, by name, and slots that stay unset.
    let mut bound: Vec<Sym> = Vec::new();
    let mut unset: Vec<Sym> = Vec::new();
    for item in lambda_list.iter_list() {
        section = match item.as_symbol() {
            Some(known::L_OPTIONAL) => Section::Optional,
            Some(known::L_REST | known::L_BODY) => Section::Rest,
            Some(known::L_KEY) => Section::Key,
            Some(known::L_AUX) => Section::Aux,
            Some(known::L_ALLOW_OTHER_KEYS) => section,
            _ => {
                let parameter = match variable_of(&item) {
                    Some(variable) if section == Section::Aux && item.as_symbol().is_some() => {
                        unset.push(variable);
                        continue;
                    }
                    Some(variable) => {
                        bound.push(variable);
                        with_default(image, &item, variable, section, slots)
                    }
                    None => item,
                };
                parameters.push(parameter);
                continue;
            }
        };
        parameters.push(item);
    }
    let values = slots
        .iter()
        .map(|slot| {
            let name = image.name(slot.name);
            let same = |sym: &&Sym| image.name(**sym) == name;
            match bound.iter().find(same) {
                Some(variable) => (*variable).into(),
                None if unset.iter().any(|u| image.name(*u) == name) => Value::NIL,
                None => slot.initform.clone(),
            }
        })
        .collect();
    (Value::list(parameters), values)
}

/// The variable of a parameter: `v`, `(v …)` or `((:key v) …)`.
fn variable_of(parameter: &Value) -> Option<Sym> {
    match parameter {
        Value::Symbol(sym, ..) => Some(*sym),
        Value::Cons(cons) => match cons.car() {
            Value::Symbol(sym, ..) => Some(sym),
            Value::Cons(pair) => pair.cdr().car_or_nil().as_symbol(),
            _ => None,
        },
        _ => None,
    }
}

/// The parameter with the default of its slot, if it may have one and has none.
fn with_default(
    image: &Image,
    parameter: &Value,
    variable: Sym,
    section: Section,
    slots: &[StructureSlot],
) -> Value {
    if !matches!(section, Section::Optional | Section::Key) {
        return parameter.clone();
    }
    let name = image.name(variable);
    let Some(slot) = slots.iter().find(|s| image.name(s.name) == name) else {
        return parameter.clone();
    };
    match parameter {
        Value::Cons(cons) if cons.cdr().is_nil() => form![cons.car(), slot.initform.clone()],
        Value::Cons(_) => parameter.clone(),
        plain => form![plain.clone(), slot.initform.clone()],
    }
}

//! The reports of conditions.

use std::rc::Rc;

use super::to_string;
use crate::image::Image;
use crate::value::Value;
use crate::value::class::{Class, ClassKind, Instance};
use crate::value::function::Function;
use crate::value::known;
use crate::value::symbol::Sym;

/// The `:report` function of a condition's class, inherited ones included.
pub fn function(instance: &Instance) -> Option<Rc<Function>> {
    let class = instance.class();
    let own = class.report.borrow().clone();
    own.or_else(|| {
        let precedence = class.precedence.borrow();
        precedence.iter().find_map(|c| c.report.borrow().clone())
    })
}

/// A slot of the condition, by its name in the standard conditions.
fn slot(image: &Image, instance: &Instance, name: &str) -> Option<Value> {
    let class = instance.class();
    let sym = class
        .slots
        .borrow()
        .iter()
        .find(|slot| image.name(slot.name) == name)
        .map(|slot| slot.name)?;
    instance.slot(sym).filter(|value| !value.is_unbound())
}

/// The report of a condition, as far as it needs no Lisp code.
pub fn report(image: &Image, condition: &Value) -> String {
    let Value::Instance(instance) = condition else {
        return to_string(image, condition, false);
    };
    let get = |name: &str| slot(image, instance, name).unwrap_or(Value::NIL);
    if let Some(text) = slot(image, instance, "REPORT").and_then(|v| v.as_text()) {
        return text;
    }
    // The most specific class that has a text decides.
    let class = instance.class();
    let own = [class.clone()];
    let precedence = class.precedence.borrow();
    let classes: &[Rc<Class>] = if precedence.is_empty() {
        &own
    } else {
        &precedence
    };
    for class in classes {
        if let Some(text) = standard(image, class.name, &get) {
            return text;
        }
    }
    format!("Condition {} was signalled.", qualified(image, class.name))
}

/// The longest message within the printed form of a condition, in characters.
const MESSAGE_LENGTH: usize = 80;

/// What a condition says, on one line and not too long, for its printed form; `None` if that
/// needs Lisp code, or if it says nothing beyond its class.
pub(super) fn message(image: &Image, instance: &Rc<Instance>) -> Option<String> {
    if instance.class().kind != ClassKind::Condition {
        return None;
    }
    let condition = Value::Instance(instance.clone());
    let given = slot(image, instance, "REPORT").and_then(|text| text.as_text());
    let text = match given {
        Some(text) => text,
        None if function(instance).is_some() => return None,
        None => {
            let mut budget = MESSAGE_LENGTH;
            let slots = instance.slots.borrow();
            if !slots.iter().all(|value| is_plain(value, &mut budget)) {
                return None;
            }
            drop(slots);
            let text = report(image, &condition);
            if text.starts_with("Condition ") && text.ends_with(" was signalled.") {
                return None;
            }
            text
        }
    };
    on_line(&text)
}

/// A text on one line that is not too long; `None` if it is empty.
pub(super) fn on_line(text: &str) -> Option<String> {
    let words: Vec<&str> = text.split_whitespace().collect();
    let line = words.join(" ");
    if line.chars().count() <= MESSAGE_LENGTH {
        return (!line.is_empty()).then_some(line);
    }
    let mut cut: String = line.chars().take(MESSAGE_LENGTH - 1).collect();
    cut.push('…');
    Some(cut)
}

/// Is it certain, without looking at more than `budget` values, that a value is no condition and
/// contains none, which could contain the condition that is being printed?
fn is_plain(value: &Value, budget: &mut usize) -> bool {
    let mut open = vec![value.clone()];
    while let Some(value) = open.pop() {
        let Some(left) = budget.checked_sub(1) else {
            return false;
        };
        *budget = left;
        match &value {
            Value::Cons(cons) => open.extend([cons.car(), cons.cdr()]),
            Value::Instance(_) | Value::Vector(_) | Value::Array(_) | Value::Hash(_) => {
                return false;
            }
            _ => {}
        }
    }
    true
}

/// A symbol with its package, as `prin1` shows it where no symbol is accessible.
fn qualified(image: &Image, sym: Sym) -> String {
    crate::print::qualified(image, &sym.into())
}

fn standard(image: &Image, class: Sym, get: &dyn Fn(&str) -> Value) -> Option<String> {
    let shown = |name: &str| to_string(image, &get(name), true);
    Some(match class {
        known::SIMPLE_CONDITION => {
            let control = get("FORMAT-CONTROL");
            let arguments: Vec<Value> = get("FORMAT-ARGUMENTS").iter_list().collect();
            match control.as_text() {
                Some(text) => simple(image, &text, &arguments),
                None if control.is_nil() => return None,
                None => to_string(image, &control, false),
            }
        }
        known::TYPE_ERROR => format!(
            "The value\n  {}\nis not of type\n  {}",
            shown("DATUM"),
            shown("EXPECTED-TYPE")
        ),
        known::UNBOUND_VARIABLE => format!("The variable {} is unbound.", shown("NAME")),
        known::UNDEFINED_FUNCTION => {
            let name = get("NAME");
            format!(
                "The function {} is undefined.",
                crate::print::qualified(image, &name)
            )
        }
        known::UNBOUND_SLOT => format!(
            "The slot {} is unbound in the object {}.",
            crate::print::qualified(image, &get("NAME")),
            shown("INSTANCE")
        ),
        known::ARITHMETIC_ERROR
        | known::DIVISION_BY_ZERO
        | known::FLOATING_POINT_OVERFLOW
        | known::FLOATING_POINT_UNDERFLOW
        | known::FLOATING_POINT_INEXACT
        | known::FLOATING_POINT_INVALID_OPERATION => {
            let mut text = format!("arithmetic error {} signalled", image.name(class));
            let operation = get("OPERATION");
            if operation.is_true() {
                let call = Value::cons(operation, get("OPERANDS"));
                text.push_str(&format!(
                    "\nOperation was {}.",
                    to_string(image, &call, true)
                ));
            }
            text
        }
        known::END_OF_FILE => format!("end of file on {}", shown("STREAM")),
        known::PRINT_NOT_READABLE => format!("{} cannot be printed readably.", shown("OBJECT")),
        known::PACKAGE_ERROR => format!("error on package {}", shown("PACKAGE")),
        known::FILE_ERROR => format!("error on file {}", shown("PATHNAME")),
        known::CONTROL_STACK_EXHAUSTED => {
            "Control stack exhausted (the recursion is too deep).".to_owned()
        }
        _ => return None,
    })
}

/// The report of a condition with a format control; the control itself if it is wrong.
fn simple(image: &Image, control: &str, arguments: &[Value]) -> String {
    super::format::format_to_string(image, control, arguments)
        .unwrap_or_else(|_| control.to_owned())
}

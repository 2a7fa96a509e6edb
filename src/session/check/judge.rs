//! Judges whether a compiler's note is a mistake, once the whole text has been seen, so
//! that the order of definitions does not matter.

use super::known::KnownNames;
use super::meant::{self, Meant};
use crate::package_name::short_name;
use lisp::image::Image;
use lisp::image::notes::NoteKind;
use lisp::library::definition_of;
use lisp::print;
use lisp::value::function::{Body, Function};
use lisp::value::symbol::{FunctionCell, Sym, VariableKind};

/// A mistake: what is wrong, and the name concerned in upper case, unless the whole form is
/// wrong.
#[derive(Debug, PartialEq)]
pub(super) struct Mistake {
    pub text: String,
    pub name: Option<String>,
}

/// Judges a note.
pub(super) fn judge(image: &Image, names: &KnownNames, note: &NoteKind) -> Option<Mistake> {
    match note {
        NoteKind::Function(name, count) => function(image, names, *name, *count),
        NoteKind::Variable(name, near) => variable(image, names, *name, *near),
        NoteKind::Mistake { name, text } => (!names.in_rules.contains(name)).then(|| Mistake {
            text: text.clone(),
            name: Some(name.clone()),
        }),
        NoteKind::Assigned(_) | NoteKind::Definition(_) => None,
    }
}

fn function(image: &Image, names: &KnownNames, name: Sym, count: Option<usize>) -> Option<Mistake> {
    match &image.symbol(name).function {
        FunctionCell::Function(function) => {
            let (count, (min, max)) = (count?, arity(image, function)?);
            if count >= min && max.is_none_or(|max| count <= max) {
                return None;
            }
            Some(Mistake {
                text: format!(
                    "{} takes {}, but is called with {count}.",
                    shown(image, name),
                    taken(min, max)
                ),
                name: None,
            })
        }
        FunctionCell::Unbound if !names.is_open && !names.defined.contains(&name) => {
            let is_function = |sym| meant::has_function(image, sym) || names.defined.contains(&sym);
            let text = format!("The function {} is not defined", shown(image, name));
            Some(Mistake {
                text: asking(&text, image, name, is_function),
                name: Some(image.name(name).to_uppercase()),
            })
        }
        FunctionCell::Unbound | FunctionCell::Macro(_) | FunctionCell::Builtin => None,
    }
}

fn variable(image: &Image, names: &KnownNames, name: Sym, near: Option<Sym>) -> Option<Mistake> {
    let data = image.symbol(name);
    // Symbols without a home are made by macros.
    let is_known = data.kind != VariableKind::Lexical
        || !data.value.is_unbound()
        || data.symbol_macro.is_some()
        || data.package.is_none()
        || names.is_open
        || names.defined.contains(&name);
    if is_known {
        return None;
    }
    let text = format!("The variable {} is unbound", shown(image, name));
    let text = match near {
        Some(near) => format!("{text}; did you mean {}?", shown(image, near)),
        None => asking(&text, image, name, |sym| {
            let other = image.symbol(sym);
            names.defined.contains(&sym) && matches!(other.function, FunctionCell::Unbound)
                || other.kind == VariableKind::Special
        }),
    };
    Some(Mistake {
        text,
        name: Some(data.name.to_uppercase()),
    })
}

/// Minimum and maximum number of arguments; `None` if not fixed.
fn arity(image: &Image, function: &Function) -> Option<(usize, Option<usize>)> {
    match &function.body {
        Body::Deferred(_) => {
            let lambda_list = &definition_of(image, function)?.signature().lambda_list;
            let (min, max) = lisp::builtin::arity(lambda_list);
            Some((min.into(), max.map(usize::from)))
        }
        Body::Native(native) => Some((native.min.into(), native.max.map(usize::from))),
        Body::Closure { code, .. } => {
            let p = &code.parameters;
            let min = usize::from(p.required);
            let takes_more = p.rest || p.has_keys;
            let max = (!takes_more).then_some(min + usize::from(p.optional));
            Some((min, max))
        }
        Body::Generic(_) => None,
    }
}

fn taken(min: usize, max: Option<usize>) -> String {
    let arguments = |n: usize| match n {
        0 => "no arguments".to_owned(),
        1 => "1 argument".to_owned(),
        n => format!("{n} arguments"),
    };
    match max {
        Some(max) if max == min => arguments(min),
        Some(max) if min == 0 => format!("at most {}", arguments(max)),
        Some(max) => format!("{min} to {}", arguments(max)),
        None => format!("at least {}", arguments(min)),
    }
}

fn shown(image: &Image, sym: Sym) -> String {
    print::to_string(image, &sym.into(), true)
}

/// The finding with a suggestion, if there is one.
fn asking(text: &str, image: &Image, name: Sym, is_kind: impl Fn(Sym) -> bool) -> String {
    match Meant::by(image, name, is_kind) {
        Some(Meant::InPackage(package)) => {
            let package = short_name(image, package);
            format!("{text}; did you mean {package}:{}?", image.name(name))
        }
        Some(Meant::Similar(near)) => format!("{text}; did you mean {near}?"),
        None => format!("{text}."),
    }
}

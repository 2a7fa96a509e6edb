//! Judges whether a compiler's note is a mistake, once the whole text has been seen, so
//! that the order of definitions does not matter.

use super::known::KnownNames;
use crate::closest_name::closest_name;
use crate::lisp::image::Image;
use crate::lisp::image::notes::NoteKind;
use crate::lisp::library::definition_of;
use crate::lisp::print;
use crate::lisp::value::function::{Body, Function};
use crate::lisp::value::known;
use crate::lisp::value::package::{Access, PackageTable};
use crate::lisp::value::symbol::{FunctionCell, Sym, VariableKind};

/// A mistake: what is wrong, and the name concerned in upper case, unless the whole form is
/// wrong.
#[derive(Debug, PartialEq)]
pub(super) struct Mistake {
    pub(crate) text: String,
    pub(crate) name: Option<String>,
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
            let is_function = |sym: Sym| {
                matches!(
                    image.symbol(sym).function,
                    FunctionCell::Function(_) | FunctionCell::Macro(_) | FunctionCell::Builtin
                ) || names.defined.contains(&sym)
            };
            let text = format!("The function {} is not defined", shown(image, name));
            Some(Mistake {
                text: asking(text, image, name, is_function),
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
        None => asking(text, image, name, |sym| {
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
            let (min, max) = crate::lisp::builtin::arity(lambda_list);
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

/// The finding with a suggestion: the same name in another package, or else a similar name
/// that is accessible in the current package.
fn asking(text: String, image: &Image, name: Sym, is_kind: impl Fn(Sym) -> bool) -> String {
    let wanted = image.name(name);
    let namesake = image.symbols.iter().find_map(|(sym, data)| {
        let fits = sym != name
            && *data.name == *wanted
            && image.home_access(sym) == Some(Access::External)
            && is_kind(sym);
        let package = data.package.filter(|_| fits)?;
        Some(format!("{}:{wanted}", short_name(image, package)))
    });
    if let Some(namesake) = namesake {
        return format!("{text}; did you mean {namesake}?");
    }
    let package = image.symbol(name).package.unwrap_or(PackageTable::USER);
    let visible = image.symbols.iter().filter_map(|(sym, data)| {
        let found = image.packages.find_symbol(package, &data.name);
        let is_visible = sym != name && found.is_some_and(|(found, _)| found == sym);
        (is_visible && sym != known::NIL && is_kind(sym)).then_some(&*data.name)
    });
    // Names of one or two letters are all similar.
    let is_long = wanted.chars().count() > 2;
    match closest_name(wanted, visible).filter(|_| is_long) {
        Some(near) => format!("{text}; did you mean {near}?"),
        None => format!("{text}."),
    }
}

/// The shortest name of a package.
fn short_name(image: &Image, package: crate::lisp::value::package::PackageId) -> String {
    let package = image.packages.get(package);
    std::iter::once(&package.name)
        .chain(&package.nicknames)
        .min_by_key(|name| name.chars().count())
        .map_or_else(String::new, |name| name.to_string())
}

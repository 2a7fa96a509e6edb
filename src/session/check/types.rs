//! Judges names of types, classes and conditions.

use super::judge::Mistake;
use super::known::KnownNames;
use lisp::image::Image;
use lisp::print;
use lisp::types::parse::{is_type_name, near_type};
use lisp::value::Value;
use lisp::value::known;
use lisp::value::symbol::Sym;

/// The names in a type specifier that are no types; `what` says what they would be.
pub(super) fn unknown(
    image: &Image,
    names: &KnownNames,
    specifier: &Value,
    what: &str,
) -> Vec<Mistake> {
    let mut mistakes = Vec::new();
    let mut pending = vec![specifier.clone()];
    while let Some(specifier) = pending.pop() {
        match &specifier {
            Value::Symbol(name, ..) if *name != known::T && *name != known::NIL => {
                mistakes.extend(unknown_name(image, names, *name, what, is_type_name));
            }
            Value::Cons(cons)
                if matches!(
                    cons.car().as_symbol(),
                    Some(known::OR | known::AND | known::NOT)
                ) =>
            {
                pending.extend(cons.cdr().iter_list());
            }
            _ => {}
        }
    }
    mistakes
}

/// The mistake in a name that is to be a class.
pub(super) fn unknown_class(
    image: &Image,
    names: &KnownNames,
    name: Sym,
    what: &str,
) -> Option<Mistake> {
    unknown_name(image, names, name, what, |image, name| {
        let class = image.class(name);
        class.is_some_and(|class| class.is_defined.get())
    })
}

fn unknown_name(
    image: &Image,
    names: &KnownNames,
    name: Sym,
    what: &str,
    is_known: impl Fn(&Image, Sym) -> bool,
) -> Option<Mistake> {
    // Symbols without a home are made by macros.
    let is_made = image.symbol(name).package.is_none();
    if names.is_open || is_made || names.defined.contains(&name) || is_known(image, name) {
        return None;
    }
    let shown = |name: Sym| print::to_string(image, &name.into(), true);
    let text = format!("There is no {what} {}", shown(name));
    let text = match near_type(image, name) {
        Some(near) => format!("{text}; did you mean {}?", shown(near)),
        None => format!("{text}."),
    };
    Some(Mistake {
        text,
        name: Some(image.name(name).to_uppercase()),
        is_style: false,
    })
}

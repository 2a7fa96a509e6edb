//! The arguments of the call that is being typed.

use super::hub::Request;
use super::package_text::package_of;
use super::sexp::Sexp;
use session::dialogue::{KnownSymbol, Names, current_parameter, parameters};

/// What marks the place of the cursor in a form.
const CURSOR: &str = "swank:%cursor-marker%";

/// A call around the cursor.
pub(super) struct OpenCall<'s> {
    /// The operator as typed.
    pub(super) operator: &'s str,
    /// The number of the argument at the cursor, from zero; none at the operator itself.
    argument: Option<usize>,
    /// The argument before it, if that is an atom.
    last: Option<&'s str>,
    /// The form, operator and all.
    items: &'s [Sexp],
}

/// The calls around the cursor in a form, innermost first.
pub(super) fn open_calls(form: &Sexp) -> Vec<OpenCall<'_>> {
    let mut path = Vec::new();
    find(form, &mut path);
    path.reverse();
    path
}

/// Finds the lists around the cursor; returns whether it is in the form.
fn find<'s>(form: &'s Sexp, path: &mut Vec<OpenCall<'s>>) -> bool {
    let items = form.items();
    let mark = items.iter().position(|item| item.as_name() == Some(CURSOR));
    let mut inner = Vec::new();
    let inside = items.iter().position(|item| find(item, &mut inner));
    // The mark follows the item in which the cursor is.
    let at = match (mark, inside) {
        (Some(mark), _) => mark.saturating_sub(1),
        (None, Some(inside)) => inside,
        (None, None) => return false,
    };
    if let Some(Sexp::Str(operator)) = items.first().filter(|_| !items.is_empty()) {
        path.push(OpenCall {
            operator,
            argument: at.checked_sub(1),
            last: at
                .checked_sub(1)
                .filter(|before| *before > 0)
                .and_then(|before| items.get(before)?.as_str()),
            items,
        });
    }
    path.append(&mut inner);
    true
}

/// The shape of a call with the parameter of an argument marked.
fn marked(symbol: &KnownSymbol, call: &OpenCall<'_>) -> Option<String> {
    let function = symbol.function.as_ref()?;
    let words = parameters(&function.lambda_list);
    let current = call
        .argument
        .and_then(|argument| current_parameter(&words, argument, call.last));
    let mut shape = format!("({}", call.operator);
    for (at, word) in words.iter().enumerate() {
        if Some(at) == current {
            shape.push_str(&format!(" ===> {word} <==="));
        } else {
            shape.push_str(&format!(" {word}"));
        }
    }
    shape.push(')');
    Some(shape)
}

/// What is told about the call around the cursor, if it is known.
fn shape(names: &Names, request: &Request) -> Option<String> {
    let package = package_of(names, request.package.as_deref());
    let calls = open_calls(request.argument(0)?);
    designator(names, &calls).or_else(|| {
        let mut calls = calls.iter();
        calls.find_map(|call| marked(names.typed(package, call.operator)?, call))
    })
}

/// The designator that is being typed, with all its keys, the one at the cursor marked. The cursor is
/// between its keys or in one of them.
fn designator(names: &Names, calls: &[OpenCall<'_>]) -> Option<String> {
    let is_article = |call: &OpenCall<'_>| {
        ["a", "an", "all"].contains(&bare(call.operator).to_lowercase().as_str())
    };
    let at = calls.iter().take(2).position(is_article)?;
    let call = calls.get(at)?;
    let class = bare(call.items.get(1)?.as_str()?);
    let word = |list: &'_ Sexp, index: usize| -> Option<String> {
        Some(bare(list.items().get(index)?.as_str()?).to_lowercase())
    };
    let mut keys = call.items.iter().skip(2);
    let of_type = keys.find(|key| word(key, 0).as_deref() == Some("type"));
    let of_type = of_type.and_then(|key| word(key, 1)).unwrap_or_default();
    let known = names.description(class, &of_type)?;
    let current = at.checked_sub(1).and_then(|inside| calls.get(inside));
    let current = current.map(|key| bare(key.operator).to_lowercase());
    let mut shape = format!("({} {class}", call.operator);
    if !of_type.is_empty() {
        shape.push_str(&format!(" (type {of_type})"));
    }
    for (key, is_needed) in &known.keys {
        let text = match is_needed {
            true => format!("({key} …)"),
            false => format!("[({key} …)]"),
        };
        shape.push_str(&match current.as_ref() == Some(key) {
            true => format!(" ===> {text} <==="),
            false => format!(" {text}"),
        });
    }
    shape.push(')');
    Some(shape)
}

/// A name without its package.
fn bare(name: &str) -> &str {
    name.rsplit(':').next().unwrap_or(name)
}

/// `autodoc`.
pub(super) fn autodoc(names: &Names, request: &Request) -> Sexp {
    match shape(names, request) {
        Some(shape) => Sexp::list([shape.into(), Sexp::t()]),
        None => Sexp::list([Sexp::symbol(":not-available"), Sexp::t()]),
    }
}

/// `operator-arglist`.
pub(super) fn operator_arglist(names: &Names, request: &Request) -> Option<Sexp> {
    let package = package_of(names, request.argument(1).and_then(Sexp::as_name));
    let symbol = names.typed(package, request.text(0)?)?;
    Some(symbol.call()?.into())
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use session::dialogue::{KnownDescription, KnownFunction};

    fn told(form: &str) -> Option<String> {
        let symbol = KnownSymbol {
            function: Some(KnownFunction {
                lambda_list: "a b &key size".to_owned(),
                ..KnownFunction::default()
            }),
            ..KnownSymbol::default()
        };
        let form = Sexp::read(form).unwrap();
        marked(&symbol, open_calls(&form).first()?)
    }

    #[test]
    fn the_keys_of_a_designator_are_told() {
        let names = Names {
            descriptions: Arc::new(vec![KnownDescription {
                class: "ACTION",
                types: vec!["going".to_owned(), "navigating".to_owned()],
                keys: vec![("target".to_owned(), true), ("speed".to_owned(), false)],
            }]),
            ..Names::default()
        };
        let told = |form: &str| {
            let form = form.replace('|', "swank::%cursor-marker%");
            designator(&names, &open_calls(&Sexp::read(&form).unwrap()))
        };
        let shape = |text: &str| Some(text.to_owned());
        assert_eq!(
            told("(\"perform\" (\"an\" \"action\" (\"type\" \"Navigating\") (\"\" |)))"),
            shape("(an action (type navigating) (target …) [(speed …)])")
        );
        assert_eq!(
            told("(\"desig:an\" \"action\" (\"type\" \"going\") (\"speed\" \"\" |))"),
            shape("(desig:an action (type going) (target …) ===> [(speed …)] <===)")
        );
        let inside_of_a_value =
            "(\"an\" \"action\" (\"type\" \"going\") (\"target\" (\"f\" \"\" |)))";
        for other in [
            inside_of_a_value,
            "(\"an\" \"action\" |)",
            "(\"an\" |)",
            "(\"a\" (\"x\" |))",
        ] {
            assert_eq!(told(other), None, "{other}");
        }
    }

    #[test]
    fn the_argument_at_the_cursor_is_marked() {
        let mark = "swank::%cursor-marker%";
        let told = |form: &str| told(&form.replace('|', mark));
        let shape = |text: &str| Some(text.to_owned());
        assert_eq!(told("(\"f\" |)"), shape("(f a b &key size)"));
        assert_eq!(told("(\"f\" \"\" |)"), shape("(f ===> a <=== b &key size)"));
        assert_eq!(
            told("(\"f\" \"x\" \"\" |)"),
            shape("(f a ===> b <=== &key size)")
        );
        assert_eq!(
            told("(\"f\" \"x\" \"y\" \":size\" \"\" |)"),
            shape("(f a b &key ===> size <===)")
        );
        assert_eq!(
            told("(\"g\" (\"f\" \"x\" |))"),
            shape("(f ===> a <=== b &key size)")
        );
        assert_eq!(told("(\"f\")"), None);
        assert_eq!(told("|"), None);
    }
}

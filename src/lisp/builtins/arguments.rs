//! What destructuring lambda lists expand into: checks of a list of arguments.

use crate::builtin::{Builtin, Entry};
use crate::image::Image;
use crate::print;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::known;
use crate::value::package::PackageTable;
use crate::value::raise::Raise;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// The list, if it has as many elements as a lambda list asks for.
///
/// `(system:check-arguments '(1) 1 1 'f '(x))` => `(1)`
#[builtin(_, "list least most context lambda-list")]
fn check_arguments(
    image: &mut Image,
    list: &Value,
    least_value: &Value,
    most_value: &Value,
    context: &Value,
    lambda_list_value: &Value,
) -> Result<Value> {
    let mut elements = list.iter_list();
    let items = elements.by_ref().count();
    // A dotted list destructures if the lambda list ends in a rest parameter.
    let is_dotted = !elements.rest.is_nil();
    if is_dotted && !(most_value.is_nil() && list.as_cons().is_some()) {
        return Err(Raise::type_error(list, known::LIST));
    }
    let count = i64::try_from(items).unwrap_or(i64::MAX);
    let bound = |v: &Value| match v {
        Value::Int(n) => Some(*n),
        _ => None,
    };
    let least = bound(least_value).unwrap_or(0);
    let most = bound(most_value);
    if count >= least && most.is_none_or(|most| count <= most) {
        return Ok(list.clone());
    }
    let lambda_list = lambda_list_text(image, context, lambda_list_value);
    let show = |v: &Value| print::to_string(image, v, true);
    let context = match context.as_symbol() {
        Some(known::DESTRUCTURING_BIND) => "DESTRUCTURING-BIND".to_owned(),
        _ => format!("DEFMACRO {}", show(context)),
    };
    let few = if count < least { "few" } else { "many" };
    let expected = match most {
        Some(most) if most == least => format!("exactly {least}"),
        Some(most) => format!("between {least} and {most}"),
        None => format!("at least {least}"),
    };
    Err(Raise::new(
        known::ARG_COUNT_ERROR,
        format!(
            "Error while parsing arguments to {context}:\n  too {few} elements in\n    {}\n  to satisfy lambda list\n    {lambda_list}:\n  {expected} expected, but got {count}",
            show(list),
        ),
    ))
}

/// A lambda list for the user to read. The parameters of the library's macros belong to `SYSTEM`.
fn lambda_list_text(image: &mut Image, context: &Value, lambda_list: &Value) -> String {
    let entry = context.as_symbol().and_then(|name| image.entry(name));
    if !matches!(entry, Some(Entry::Library(_))) {
        return print::to_string(image, lambda_list, true);
    }
    let package = image.special(known::V_PACKAGE).clone();
    image.set_special(known::V_PACKAGE, Value::Package(PackageTable::SYSTEM));
    let text = print::to_string(image, lambda_list, true);
    image.set_special(known::V_PACKAGE, package);
    text
}

/// An error unless the list is a property list of these keys.
///
/// `(system:check-keys '(:a 1) '(:a))` => `NIL`
#[builtin(_, "list keys")]
fn check_keys(image: &mut Image, list: &Value, keys_value: &Value) -> Result<Value> {
    let items: Vec<Value> = list.iter_list().collect();
    if !items.len().is_multiple_of(2) {
        return Err(Raise::program("odd number of &KEY arguments"));
    }
    let allowed = items
        .chunks_exact(2)
        .any(|pair| pair[0].as_symbol() == Some(known::K_ALLOW_OTHER_KEYS) && pair[1].is_true());
    if allowed {
        return Ok(Value::NIL);
    }
    for pair in items.chunks_exact(2) {
        let is_known = pair[0].as_symbol() == Some(known::K_ALLOW_OTHER_KEYS)
            || keys_value.iter_list().any(|key| key.is_eq(&pair[0]));
        if !is_known {
            let shown = print::to_string(image, &pair[0], true);
            let keys: Vec<_> = keys_value
                .iter_list()
                .filter_map(|key| key.as_symbol())
                .collect();
            return Err(Raise::unknown_key(
                &shown,
                keys.iter().map(|key| image.name(*key)),
            ));
        }
    }
    Ok(Value::NIL)
}

/// The rest of a property list after a key; NIL if it is not there.
///
/// `(system:key-tail '(:a 1 :b 2) :b)` => `(2)`
#[builtin]
fn key_tail(list: Value, key: &Value) -> Result<Value> {
    let mut rest = list;
    while let Value::Cons(cons) = &rest {
        if cons.car().is_eq(key) {
            return Ok(cons.cdr());
        }
        let next = cons.cdr().cdr_or_nil();
        rest = next;
    }
    Ok(Value::NIL)
}

/// Builtins of package `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![check_arguments, check_keys, key_tail,];

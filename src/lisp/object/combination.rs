//! Method combinations: the builtin ones and the short form of `define-method-combination`.

use crate::image::Image;
use crate::typed::{self, builtin};
use crate::value::Value;
use crate::value::form::{form, quote};
use crate::value::generic::Combination;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;

/// Operators that combinations are named after, and whether the value of a single method is
/// the value of the call.
const BUILTIN: &[(Sym, bool)] = &[
    (known::STANDARD, true),
    (known::PLUS, true),
    (known::AND, true),
    (known::APPEND, false),
    (known::LIST, false),
    (known::MAX, true),
    (known::MIN, true),
    (known::NCONC, true),
    (known::OR, true),
    (known::PROGN, true),
];

/// Is this the name of a combination of the language?
pub(crate) fn is_builtin(name: &Value) -> bool {
    let name = name.as_symbol();
    BUILTIN.iter().any(|(operator, _)| Some(*operator) == name)
}

/// The combination of a name.
pub(crate) fn combination_named(image: &Image, name: &Value) -> Result<Combination, Box<Raise>> {
    let unknown = || {
        Raise::program(format!(
            "There is no method combination named {}.",
            super::text(image, name)
        ))
    };
    let sym = name.as_symbol().ok_or_else(unknown)?;
    if let Some((_, is_identity)) = BUILTIN.iter().find(|(operator, _)| *operator == sym) {
        return Ok(Combination {
            name: sym,
            operator: sym,
            is_identity: *is_identity,
        });
    }
    // A program's own combinations are on the property lists of their names: (operator . identity).
    let plist: Vec<Value> = image.symbol(sym).plist.iter_list().collect();
    let kept = plist
        .chunks_exact(2)
        .find(|pair| pair[0].as_symbol() == Some(known::METHOD_COMBINATION))
        .map(|pair| pair[1].clone())
        .ok_or_else(unknown)?;
    Ok(Combination {
        name: sym,
        operator: kept.car_or_nil().as_symbol().ok_or_else(unknown)?,
        is_identity: kept.cdr_or_nil().is_true(),
    })
}

/// `(define-method-combination name :operator operator :identity-with-one-argument flag)`.
pub(crate) fn expand_define_method_combination(
    _: &mut Image,
    whole: &Value,
) -> Result<Value, Box<Raise>> {
    let parts = whole.list_to_vec().unwrap_or_default();
    let [_, name @ Value::Symbol(..), options @ ..] = parts.as_slice() else {
        return Err(Raise::program(
            "DEFINE-METHOD-COMBINATION takes a name and options.",
        ));
    };
    if options.first().is_some_and(Value::is_list) {
        return Ok(
            form![known::SYS_DEFINE_LONG_COMBINATION, name.clone(); Value::list(options.iter().cloned())],
        );
    }
    let option = |keyword| {
        options
            .chunks_exact(2)
            .find(|pair| pair[0].as_symbol() == Some(keyword))
            .map(|pair| pair[1].clone())
    };
    let operator = option(known::K_OPERATOR).unwrap_or_else(|| name.clone());
    let is_identity = option(known::K_IDENTITY_WITH_ONE_ARGUMENT).unwrap_or(Value::NIL);
    Ok(form![
        known::SYS_DEFINE_COMBINATION,
        quote(name.clone()),
        quote(operator),
        Value::bool(is_identity.is_true()),
    ])
}

/// Defines a method combination as DEFINE-METHOD-COMBINATION describes it.
#[builtin("%DEFINE-COMBINATION")]
pub(crate) fn define_combination(
    image: &mut Image,
    name: Sym,
    operator: Value,
    identity_with_one_argument: Value,
) -> Sym {
    let kept = Value::cons(operator, identity_with_one_argument);
    let data = image.symbols.get_mut(name);
    data.plist =
        Value::list_with_tail([known::METHOD_COMBINATION.into(), kept], data.plist.clone());
    name
}

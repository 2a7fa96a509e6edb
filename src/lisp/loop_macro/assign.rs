//! Variables of clauses: single ones, and trees that destructure a list.

use super::parser::Parser;
use super::plan::{Accumulator, Assignment, Plan};
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;

/// The most variables in a tree.
const MAX_VARIABLES: usize = 10_000;

/// Reads a variable or tree of variables, and a type if one follows.
///
/// Returns the tree and the type.
pub(crate) fn variable(
    parser: &mut Parser<'_>,
    plan: &mut Plan,
    clause: &str,
) -> Result<(Value, Option<Value>), Box<Raise>> {
    let tree = parser.form(clause)?;
    for name in leaves(&tree)? {
        let Value::Symbol(sym, ..) = &name else {
            return Err(Raise::program(format!(
                "{} after {clause} in LOOP is not a variable.",
                parser.shown(&name)
            )));
        };
        if parser.image.is_keyword(*sym) || *sym == known::T {
            return Err(Raise::program(format!(
                "{} after {clause} in LOOP is a constant and cannot be a variable.",
                parser.shown(&name)
            )));
        }
        let is_result = |a: &Accumulator| a.into.as_ref().is_some_and(|into| into.is_eq(&name));
        if plan.accumulators.iter().any(is_result) {
            return Err(twice(parser, &name));
        }
        only_once(parser, plan, &name)?;
        plan.variables.push(name);
    }
    Ok((tree, variable_type(parser, clause)?))
}

/// Checks that no `for` or `with` clause binds a variable yet.
pub(crate) fn only_once(
    parser: &Parser<'_>,
    plan: &Plan,
    variable: &Value,
) -> Result<(), Box<Raise>> {
    if plan.variables.iter().any(|v| v.is_eq(variable)) {
        return Err(twice(parser, variable));
    }
    Ok(())
}

fn twice(parser: &Parser<'_>, variable: &Value) -> Box<Raise> {
    Raise::program(format!(
        "The variable {} stands twice in LOOP.",
        parser.shown(variable)
    ))
}

/// Reads a type: after `of-type`, or one of the simple types that may stand alone.
pub(crate) fn variable_type(
    parser: &mut Parser<'_>,
    clause: &str,
) -> Result<Option<Value>, Box<Raise>> {
    if parser.accept(&["OF-TYPE"]) {
        return parser.form(&format!("OF-TYPE in {clause}")).map(Some);
    }
    if parser.is_any(&["FIXNUM", "FLOAT", "T", "NIL"]) {
        return parser.form(clause).map(Some);
    }
    Ok(None)
}

/// The value of a variable that was not given one.
pub(crate) fn default_value(of_type: Option<&Value>) -> Value {
    match of_type {
        Some(Value::Symbol(
            known::FIXNUM
            | known::INTEGER
            | known::NUMBER
            | known::REAL
            | known::RATIONAL
            | known::BIT
            | known::UNSIGNED_BYTE,
            ..,
        )) => Value::Int(0),
        Some(Value::Symbol(known::FLOAT | known::SINGLE_FLOAT | known::SHORT_FLOAT, ..)) => {
            Value::Single(0.0)
        }
        Some(Value::Symbol(known::DOUBLE_FLOAT | known::LONG_FLOAT, ..)) => Value::Double(0.0),
        _ => Value::NIL,
    }
}

/// Each variable of a tree, with the value that it has if it is given none. The type may be a tree, too.
pub(crate) fn defaults(tree: &Value, of_type: Option<&Value>) -> Vec<Assignment> {
    let mut found = Vec::new();
    let mut pending = vec![(tree.clone(), of_type.cloned())];
    while let Some((part, of_type)) = pending.pop() {
        match (&part, &of_type) {
            (Value::Cons(names), Some(Value::Cons(types))) => {
                pending.push((names.cdr(), Some(types.cdr())));
                pending.push((names.car(), Some(types.car())));
            }
            (Value::Cons(names), _) => {
                pending.push((names.cdr(), of_type.clone()));
                pending.push((names.car(), of_type));
            }
            (Value::Symbol(known::NIL, ..), _) => {}
            _ => {
                let value = default_value(of_type.as_ref());
                found.push((part, value));
            }
        }
    }
    found
}

/// The variables of a tree; `NIL` is none.
fn leaves(tree: &Value) -> Result<Vec<Value>, Box<Raise>> {
    let mut found = Vec::new();
    let mut pending = vec![tree.clone()];
    while let Some(part) = pending.pop() {
        match &part {
            Value::Cons(cons) => {
                pending.push(cons.cdr());
                pending.push(cons.car());
            }
            Value::Symbol(known::NIL, ..) => {}
            _ => found.push(part),
        }
        if found.len() + pending.len() > MAX_VARIABLES {
            return Err(Raise::program("LOOP has too many variables in one clause."));
        }
    }
    Ok(found)
}

/// Each variable of a tree, with the form that extracts its value from a variable.
pub(crate) fn parts(tree: &Value, whole: &Value) -> Vec<Assignment> {
    let mut found = Vec::new();
    let mut pending = vec![(tree.clone(), whole.clone())];
    while let Some((part, form)) = pending.pop() {
        match &part {
            Value::Cons(cons) => {
                let half = |f| Value::list([Value::symbol(f), form.clone()]);
                pending.push((cons.cdr(), half(known::CDR)));
                pending.push((cons.car(), half(known::CAR)));
            }
            Value::Symbol(known::NIL, ..) => {}
            _ => found.push((part, form)),
        }
    }
    found
}

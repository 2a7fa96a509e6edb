//! Searches by macros of the plan language in the code they are given: all of it is walked each
//! time, so this must be fast.
//!
//! `with-tags` binds a variable for each `(:tag name …)` in its body before the body runs, so it
//! searches the forms for them, and the expansions of the program's macros, but not quoted data,
//! nor a nested `with-tags`, which binds its own.

use crate::state::Plan;
use lisp::builtin::Builtin;
use lisp::compile;
use lisp::image::Image;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;
use lisp::value::symbol::Sym;

/// The names of the tags in forms, in order.
///
/// `(plan-system:find-tags '((:tag a 1) (list (:tag b 2)) '(:tag c 3)))` => `(A B)`
#[builtin("FIND-TAGS")]
fn find_tags_builtin(image: &mut Image, forms: &Value) -> Result<Value, Box<Raise>> {
    let tags = find_tags(image, forms);
    Ok(Value::list(
        tags.into_iter().map(Value::from).collect::<Vec<_>>(),
    ))
}

/// Does (FUNCTION NAME) occur in a form?
///
/// `(plan-system:mentions-function 'f '(mapc #'f list))` => `T`
#[builtin("MENTIONS-FUNCTION")]
fn mentions_function_builtin(name: &Value, form: &Value) -> Result<Value, Box<Raise>> {
    Ok(Value::bool(mentions_function(form, name)))
}

/// Maximum number of macro expansions in one search for tags.
const MAX_EXPANSIONS: usize = 10_000;

/// The names of the tags in the forms, in order.
fn find_tags(image: &mut Image, body: &Value) -> Vec<Sym> {
    let names = Plan::of(image).names;
    let mut tags = Vec::new();
    let mut expansions = 0;
    let mut pending: Vec<Value> = body.list_to_vec().unwrap_or_default();
    pending.reverse();
    while let Some(form) = pending.pop() {
        let Value::Cons(cons) = &form else {
            continue;
        };
        let Some(head) = cons.car().as_symbol() else {
            push_elements(&mut pending, &form);
            continue;
        };
        let rest = cons.cdr();
        if head == names.tag {
            let name = rest.car_or_nil().as_symbol().filter(|s| *s != known::NIL);
            if let Some(name) = name.filter(|name| !tags.contains(name)) {
                tags.push(name);
            }
            push_elements(&mut pending, &rest.cdr_or_nil());
            continue;
        }
        match head {
            known::QUOTE | known::QUASIQUOTE => {}
            known::CASE
            | known::ECASE
            | known::CCASE
            | known::TYPECASE
            | known::ETYPECASE
            | known::CTYPECASE => {
                let clauses = rest.cdr_or_nil().list_to_vec().unwrap_or_default();
                for clause in clauses.iter().rev() {
                    push_elements(&mut pending, &clause.cdr_or_nil());
                }
                pending.push(rest.car_or_nil());
            }
            head if head == names.with_tags => {}
            head => {
                let is_macro = image.symbol(head).function.is_macro_of_program();
                if is_macro && expansions < MAX_EXPANSIONS {
                    expansions += 1;
                    if let Ok(Some(expansion)) = compile::macroexpand_1(image, &form) {
                        pending.push(expansion);
                        continue;
                    }
                }
                push_elements(&mut pending, &rest);
            }
        }
    }
    tags
}

/// Pushes the elements of a list, so that the first is popped first.
fn push_elements(pending: &mut Vec<Value>, list: &Value) {
    let start = pending.len();
    pending.extend(list.iter_list());
    pending[start..].reverse();
}

/// Whether `(function name)` occurs in the form.
fn mentions_function(form: &Value, name: &Value) -> bool {
    let mut pending = vec![form.clone()];
    while let Some(Value::Cons(cons)) = pending.pop() {
        let (head, rest) = (cons.car(), cons.cdr());
        if head.as_symbol() == Some(known::FUNCTION) && rest.car_or_nil().is_eq(name) {
            return true;
        }
        for value in [head, rest] {
            if matches!(value, Value::Cons(_)) {
                pending.push(value);
            }
        }
    }
    false
}

/// Builtins of package `PLAN-SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] =
    builtins![find_tags_builtin, mentions_function_builtin,];

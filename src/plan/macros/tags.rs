//! Tags: names for the tasks of parts of a plan.
//!
//! `with-tags` binds a variable for each `(:tag name …)` in its body before the body runs,
//! so it looks for them in the forms: also in what macros of the program expand into, not
//! in quoted data, nor in a `with-tags` inside, which binds its own.

use super::{check_plan, first_rest, macro_, plan, progn, quoted};
use crate::lisp::builtin::Operator;
use crate::lisp::compile;
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::form::form;
use crate::lisp::value::known;
use crate::lisp::value::symbol::Sym;

/// The macros.
pub(crate) static OPERATORS: &[Operator] = &[macro_(
    "WITH-TAGS",
    "&body body",
    "Runs the body, in which (:TAG NAME FORM…) runs forms in a task of that name; the names are bound to the tasks.",
    &[
        "(cpl:top-level (cpl:with-tags (:tag a 1) (list (cpl:value (cpl:status a)) (cpl:result a)))) => (:SUCCEEDED 1)",
    ],
    |image, form| {
        let check = check_plan(&plan(image), "WITH-TAGS");
        let body = with_tags(image, form.cdr_or_nil());
        Ok(form![known::PROGN, check, body])
    },
)];

/// Macros named by keywords.
pub(crate) static KEYWORD_OPERATORS: &[Operator] = &[macro_(
    "TAG",
    "name &body body",
    "Inside WITH-TAGS, runs forms in a task of that name.",
    &["(cpl:top-level (cpl:with-tags (:tag a 1))) => 1"],
    |image, form| {
        let (name, _) = first_rest(form);
        Ok(form![plan(image).names.sys_tag_outside, quoted(name)])
    },
)];

/// Macro expansions that one search for tags may make.
const MOST_EXPANSIONS: usize = 10_000;

/// A body inside which tags mean tasks.
pub(super) fn with_tags(image: &mut Image, body: Value) -> Value {
    let tags = find_tags(image, &body);
    if tags.is_empty() {
        return progn(body);
    }
    let names = plan(image).names;
    let bindings: Vec<Value> = tags
        .iter()
        .map(|tag| form![*tag, form![names.sys_make_tag, quoted(*tag)]])
        .collect();
    let (name, forms) = (image.gensym("NAME"), image.gensym("BODY"));
    // (:tag name form…) => (progn (setq name (fresh-tag name 'name))
    //                             (run-tag name (lambda () form…)))
    let quote_name = form![known::LIST, quoted(known::QUOTE), name];
    let fresh = form![known::LIST, quoted(names.sys_fresh_tag), name, quote_name];
    let set = form![known::LIST, quoted(known::SETQ), name, fresh];
    let function = form![known::LIST_STAR, quoted(known::LAMBDA), Value::NIL, forms];
    let run = form![known::LIST, quoted(names.sys_run_tag), name, function];
    let expansion = form![known::LIST, quoted(known::PROGN), set, run];
    let parameters = form![name, known::L_BODY, forms];
    let tag_macro = form![names.tag, parameters, expansion];
    form![
        known::LET_STAR,
        Value::list(bindings),
        form![known::MACROLET, form![tag_macro]; body],
    ]
}

/// The names of the tags in forms, in order.
fn find_tags(image: &mut Image, body: &Value) -> Vec<Sym> {
    let names = plan(image).names;
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
                if is_macro && expansions < MOST_EXPANSIONS {
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

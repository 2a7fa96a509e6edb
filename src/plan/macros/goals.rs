//! Goals: `declare-goal` and `def-goal`.

use super::tags::with_tags;
use super::{Expansion, first_rest, gensym, macro_, plan, quoted, thunk_of};
use crate::lisp::builtin::Operator;
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::form::{doc_form, form, split_body};
use crate::lisp::value::known;
use crate::lisp::value::symbol::Sym;
use crate::plan::builtins::is_variable;

/// The macros.
pub(crate) static OPERATORS: &[Operator] = &[
    macro_(
        "DECLARE-GOAL",
        "name lambda-list &body body",
        "Declares goals of a name: a call runs the body, which may RETURN, and then the first goal whose pattern matches the arguments.",
        &["(cpl:declare-goal achieve (what)) => ACHIEVE"],
        declare_goal,
    ),
    macro_(
        "DEF-GOAL",
        "(name &rest pattern) &body body",
        "Defines a goal; symbols that begin with ? in the pattern are variables of the body. (SUCCEED value…) leaves it.",
        &[
            "(progn (cpl:declare-goal reach (what)) (cpl:def-goal (reach (loc ?x)) (list :at ?x)) (cpl:top-level (reach '(loc table)))) => (:AT TABLE)",
        ],
        def_goal,
    ),
];

fn declare_goal(image: &mut Image, form: &Value) -> Expansion {
    let names = plan(image).names;
    let (name, rest) = first_rest(form);
    let split = split_body(&rest.cdr_or_nil());
    let args = gensym(image, "ARGUMENTS");
    let body = Value::list_with_tail(split.declarations, split.forms);
    let before = form![known::LAMBDA, rest.car_or_nil(); body];
    let mut definition = vec![
        Value::from(known::DEFUN),
        name.clone(),
        form![known::L_REST, args.clone()],
    ];
    if split.doc.is_some() {
        definition.push(doc_form(split.doc.as_ref()));
    }
    definition.push(form![
        known::BLOCK,
        Value::NIL,
        form![known::APPLY, before, args.clone()],
        form![names.sys_call_goal, quoted(name.clone()), args],
    ]);
    Ok(form![
        known::PROGN,
        form![names.sys_declare_goal, quoted(name)],
        Value::list(definition),
    ])
}

fn def_goal(image: &mut Image, form: &Value) -> Expansion {
    let names = plan(image).names;
    let (head, body) = first_rest(form);
    let (name, pattern) = (head.car_or_nil(), head.cdr_or_nil());
    let variables = variables(image, &pattern);
    let split = split_body(&body);
    let block = gensym(image, "GOAL");
    let results = gensym(image, "RESULTS");
    let values_list = image.intern(crate::lisp::value::package::PackageTable::CL, "VALUES-LIST");
    let leave = form![
        known::RETURN_FROM,
        block.clone(),
        form![values_list, results.clone()],
    ];
    let succeed = form![names.succeed, form![known::L_REST, results], leave];
    let inner = form![known::FLET, form![succeed], with_tags(image, split.forms)];
    let part = form![names.goal, head.clone()];
    let what = format!(
        "GOAL-{}",
        crate::lisp::print::to_string(image, &name, false)
    );
    let call = form![
        names.sys_in_node,
        quoted(part),
        Value::string(what),
        thunk_of(form![known::BLOCK, block, inner]),
    ];
    let parameters = Value::list(
        variables
            .iter()
            .map(|v| Value::from(*v))
            .collect::<Vec<_>>(),
    );
    let ignorable = form![known::DECLARE, form![known::IGNORABLE; parameters.clone()]];
    let mut function = vec![Value::from(known::LAMBDA), parameters.clone(), ignorable];
    function.extend(split.declarations);
    function.push(call);
    Ok(form![
        names.sys_register_goal,
        quoted(name),
        quoted(pattern),
        quoted(parameters),
        Value::list(function),
        doc_form(split.doc.as_ref()),
    ])
}

/// The variables of a pattern, in order.
fn variables(image: &Image, pattern: &Value) -> Vec<Sym> {
    let mut found = Vec::new();
    let mut pending = vec![pattern.clone()];
    while let Some(value) = pending.pop() {
        match value {
            Value::Cons(cons) => {
                pending.push(cons.cdr());
                pending.push(cons.car());
            }
            Value::Symbol(sym)
                if is_variable(image, sym) && !found.contains(&sym) && image.name(sym) != "?_" =>
            {
                found.push(sym);
            }
            _ => {}
        }
    }
    found
}

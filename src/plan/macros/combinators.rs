//! Forms that run others: in order, in parallel, until one succeeds.

use super::{
    Expansion, check_plan, first_rest, gensym, macro_, option, plan, progn, quoted, thunk_of,
};
use crate::lisp::builtin::Operator;
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::form::form;
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;
use crate::lisp::value::symbol::Sym;

/// The macros.
pub(crate) static OPERATORS: &[Operator] = &[
    macro_(
        "TOP-LEVEL",
        "&body body",
        "Runs a plan and returns its values.",
        &["(cpl:top-level 1 2) => 2"],
        |image, form| {
            let names = plan(image).names;
            let body = form![known::BLOCK, Value::NIL; form.cdr_or_nil()];
            Ok(form![names.sys_top_level, Value::NIL, thunk_of(body)])
        },
    ),
    macro_(
        "NAMED-TOP-LEVEL",
        "(&key name) &body body",
        "Runs a plan that keeps its task tree under a name.",
        &["(cpl-impl::named-top-level (:name x) 1) => 1"],
        named_top_level,
    ),
    macro_(
        "SEQ",
        "&body forms",
        "Runs forms in order.",
        &["(cpl:seq 1 2) => 2"],
        |_, form| Ok(progn(form.cdr_or_nil())),
    ),
    macro_(
        "PAR",
        "&body forms",
        "Runs forms in parallel until all have succeeded; the values of the first. Fails as soon as one fails.",
        &["(cpl:top-level (cpl:par (cpl:seq (cpl:sleep 1) :slow) :fast)) => :SLOW"],
        |image, form| Ok(parallel(form, plan(image).names.sys_par)),
    ),
    macro_(
        "PURSUE",
        "&body forms",
        "Runs forms in parallel until one succeeds; its values. Fails as soon as one fails.",
        &["(cpl:top-level (cpl:pursue (cpl:seq (cpl:sleep 1) :slow) :fast)) => :FAST"],
        |image, form| Ok(parallel(form, plan(image).names.sys_pursue)),
    ),
    macro_(
        "TRY-ALL",
        "&body forms",
        "Runs forms in parallel until one succeeds; its values. Fails when all have failed.",
        &["(cpl:top-level (cpl:try-all (cpl:fail) :ok)) => :OK"],
        |image, form| Ok(parallel(form, plan(image).names.sys_try_all)),
    ),
    macro_(
        "TRY-IN-ORDER",
        "&body forms",
        "Runs forms one after the other until one succeeds; its values. Fails when all have failed.",
        &["(cpl:top-level (cpl:try-in-order (cpl:fail) 2 3)) => 2"],
        try_in_order,
    ),
    macro_(
        "TRY-EACH-IN-ORDER",
        "(variable list) &body body",
        "Runs the body for one element after the other until it succeeds.",
        &["(cpl:top-level (cpl:try-each-in-order (x '(1 2)) (if (oddp x) (cpl:fail) x))) => 2"],
        try_each_in_order,
    ),
    macro_(
        "PAR-LOOP",
        "(variable list) &body body",
        "Runs the body for all elements in parallel; the values for the first.",
        &["(cpl:top-level (cpl:par-loop (x '(1 2 3)) (* 10 x))) => 10"],
        par_loop,
    ),
    macro_(
        "PARTIAL-ORDER",
        "(&body forms) &body orders",
        "Runs forms in parallel, tagged ones as the orders (:ORDER earlier later) say.",
        &[
            "(cpl:top-level (cpl:with-tags (cpl:partial-order ((:tag b :b) (:tag a :a)) (:order a b)))) => :B",
        ],
        partial_order,
    ),
    macro_(
        "MAPCAR-CLEAN",
        "function list",
        "Like MAPCAR, without the values that are NIL.",
        &["(cpl:mapcar-clean (lambda (x) (when (oddp x) x)) '(1 2 3)) => (1 3)"],
        mapcar_clean,
    ),
];

/// A call with a function for each form.
fn parallel(form: &Value, function: Sym) -> Value {
    let thunks: Vec<Value> = form.cdr_or_nil().iter_list().map(thunk_of).collect();
    form![function; Value::list(thunks)]
}

fn named_top_level(image: &mut Image, form: &Value) -> Expansion {
    let names = plan(image).names;
    let (options, body) = first_rest(form);
    let name = option(&options, names.name).unwrap_or(Value::NIL);
    let body = form![known::BLOCK, Value::NIL; body];
    Ok(form![names.sys_top_level, quoted(name), thunk_of(body)])
}

/// `(handler-case form (plan-failure (c) (push c failures)))`, the form leaving with its
/// values if it succeeds.
fn attempt(image: &mut Image, form: Value, failures: &Value) -> Value {
    let names = plan(image).names;
    let failure = gensym(image, "FAILURE");
    let note = form![
        known::SETQ,
        failures.clone(),
        form![known::CONS, failure.clone(), failures.clone()],
    ];
    form![
        known::HANDLER_CASE,
        form![known::RETURN_FROM, Value::NIL, form],
        form![names.plan_failure, form![failure], note],
    ]
}

/// The failure when everything has failed, of failures that were noted last first.
fn all_failed(image: &mut Image, failures: &Value) -> Value {
    let names = plan(image).names;
    let reverse = image.intern(crate::lisp::value::package::PackageTable::CL, "REVERSE");
    form![names.sys_all_failed, form![reverse, failures.clone()]]
}

fn try_in_order(image: &mut Image, form: &Value) -> Expansion {
    let check = check_plan(&plan(image), "TRY-IN-ORDER");
    let failures = gensym(image, "FAILURES");
    let attempts: Vec<Value> = form
        .cdr_or_nil()
        .iter_list()
        .map(|form| attempt(image, form, &failures))
        .collect();
    let end = form![all_failed(image, &failures)];
    let body = Value::list_with_tail(attempts, end);
    let bindings = form![form![failures, Value::NIL]];
    Ok(form![
        known::PROGN,
        check,
        form![known::BLOCK, Value::NIL, form![known::LET, bindings; body]],
    ])
}

fn try_each_in_order(image: &mut Image, form: &Value) -> Expansion {
    let check = check_plan(&plan(image), "TRY-EACH-IN-ORDER");
    let (spec, body) = first_rest(form);
    let failures = gensym(image, "FAILURES");
    let attempt = attempt(image, progn(body), &failures);
    let end = all_failed(image, &failures);
    let header = form![spec.car_or_nil(), spec.cdr_or_nil().car_or_nil(), end,];
    let bindings = form![form![failures, Value::NIL]];
    Ok(form![
        known::PROGN,
        check,
        form![known::LET, bindings, form![known::DOLIST, header, attempt]],
    ])
}

fn par_loop(image: &mut Image, form: &Value) -> Expansion {
    let names = plan(image).names;
    let (spec, body) = first_rest(form);
    let variable = form![spec.car_or_nil()];
    let list = spec.cdr_or_nil().car_or_nil();
    let function = form![known::LAMBDA, variable; body];
    Ok(form![names.sys_par_loop, function, list])
}

fn partial_order(image: &mut Image, form: &Value) -> Expansion {
    let names = plan(image).names;
    let (steps, orders) = first_rest(form);
    let mut lists = vec![Value::from(known::LIST)];
    for order in orders.iter_list() {
        let parts = order.list_to_vec().unwrap_or_default();
        match parts.as_slice() {
            [head, earlier, later] if head.as_symbol() == Some(names.order) => {
                lists.push(form![known::LIST, earlier.clone(), later.clone()]);
            }
            _ => return Err(Raise::simple("Malformed ordering constraint.")),
        }
    }
    let thunks: Vec<Value> = steps.iter_list().map(thunk_of).collect();
    let check = check_plan(&plan(image), "PARTIAL-ORDER");
    Ok(form![
        known::PROGN,
        check,
        form![names.sys_partial_order, Value::list(lists); Value::list(thunks)],
    ])
}

fn mapcar_clean(image: &mut Image, form: &Value) -> Expansion {
    let remove = image.intern(crate::lisp::value::package::PackageTable::CL, "REMOVE");
    let call = form![known::MAPCAR; form.cdr_or_nil()];
    Ok(form![remove, Value::NIL, call])
}

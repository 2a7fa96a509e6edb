//! Handling failures: `with-failure-handling` and retry counters.
//!
//! `with-failure-handling` is handlers around a body that can be begun again: the handlers
//! run where the failure is, so that they may decline; `retry` jumps before the body.

use super::{Expansion, first_rest, gensym, macro_, plan, quoted};
use crate::lisp::builtin::Operator;
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::form::form;
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;
use crate::lisp::value::symbol::Sym;
use crate::plan::state::Plan;

/// The macros.
pub(crate) static OPERATORS: &[Operator] = &[
    macro_(
        "WITH-FAILURE-HANDLING",
        "(&rest clauses) &body body",
        "Runs the body; a clause (TYPE (VARIABLE) FORM…) handles failures and errors of a type: it may leave with (RETURN value), begin the body again with (RETRY), or decline by coming to its end.",
        &[
            "(let ((n 0)) (cpl:with-failure-handling ((cpl:plan-failure (e) (cpl:retry))) (incf n) (when (< n 3) (cpl:fail)) n)) => 3",
            "(cpl:with-failure-handling ((cpl:plan-failure (e) (return :given-up))) (cpl:fail)) => :GIVEN-UP",
        ],
        with_failure_handling,
    ),
    macro_(
        "WITH-RETRY-COUNTERS",
        "((counter count)…) &body body",
        "Binds counters for DO-RETRY, GET-COUNTER and RESET-COUNTER.",
        &[
            "(cpl:with-retry-counters ((c 1)) (list (cpl:do-retry c :again) (cpl:do-retry c :again))) => (:AGAIN NIL)",
        ],
        with_retry_counters,
    ),
];

struct Clause {
    condition_type: Value,
    parameters: Value,
    body: Value,
}

fn clauses(image: &mut Image, list: &Value) -> Result<Vec<Clause>, Box<Raise>> {
    let mut clauses = Vec::new();
    for clause in list.iter_list() {
        let (parameters, body) = first_rest(&clause);
        if clause.as_cons().is_none() || !parameters.is_list() {
            let shown = crate::lisp::print::to_string(image, &clause, true);
            return Err(Raise::program(format!(
                "{shown} is not a clause of WITH-FAILURE-HANDLING: (type (variable) form…) was expected."
            )));
        }
        let parameters = if parameters.is_nil() {
            form![gensym(image, "FAILURE")]
        } else {
            parameters
        };
        clauses.push(Clause {
            condition_type: clause.car_or_nil(),
            parameters,
            body,
        });
    }
    Ok(clauses)
}

/// Is every condition of the type a failure of plans, so that none comes in an envelope?
fn is_plan_failure(image: &Image, plan: &Plan, condition_type: &Value) -> bool {
    match condition_type {
        Value::Symbol(name) => image
            .class(*name)
            .is_some_and(|class| class.is_subclass_of(plan.names.plan_failure)),
        Value::Cons(cons) if cons.car().as_symbol() == Some(known::OR) => cons
            .cdr()
            .iter_list()
            .all(|each| is_plan_failure(image, plan, &each)),
        _ => false,
    }
}

fn with_failure_handling(image: &mut Image, form: &Value) -> Expansion {
    let plan = plan(image);
    let names = &plan.names;
    let (list, body) = first_rest(form);
    let clauses = clauses(image, &list)?;
    if clauses.is_empty() {
        return Ok(form![known::BLOCK, Value::NIL; body]);
    }
    let again = gensym(image, "AGAIN");
    let mut functions = Vec::new();
    let mut handlers = Vec::new();
    let mut unwrapping = Vec::new();
    for clause in clauses {
        let function = form![known::LAMBDA, clause.parameters; clause.body];
        if is_plan_failure(image, &plan, &clause.condition_type) {
            handlers.push(form![clause.condition_type, function]);
            continue;
        }
        // Such a clause may get what an envelope holds, too.
        let name = gensym(image, "HANDLER");
        functions.push(form![name.clone(), function]);
        unwrapping.push((clause.condition_type.clone(), name.clone()));
        handlers.push(form![clause.condition_type, name]);
    }
    if !unwrapping.is_empty() {
        handlers.insert(
            0,
            form![names.envelope, unwrapping_handler(image, &plan, unwrapping)],
        );
    }
    let handled = form![known::HANDLER_BIND, Value::list(handlers); body];
    let handled = if functions.is_empty() {
        handled
    } else {
        form![known::LET, Value::list(functions), handled]
    };
    let protected = form![known::RETURN_FROM, Value::NIL, handled];
    let jump = form![known::GO, again.clone()];
    let protected = if mentions_function(form, names.retry) {
        form![
            known::FLET,
            form![form![names.retry, Value::NIL, jump]],
            protected,
        ]
    } else {
        form![
            known::MACROLET,
            form![form![names.retry, Value::NIL, quoted(jump)]],
            protected,
        ]
    };
    Ok(form![
        known::BLOCK,
        Value::NIL,
        form![known::TAGBODY, again, protected],
    ])
}

/// A handler of envelopes that gives what they hold to the first clause that fits.
fn unwrapping_handler(image: &mut Image, plan: &Plan, clauses: Vec<(Value, Value)>) -> Value {
    let envelope = gensym(image, "ENVELOPE");
    let inner = gensym(image, "INNER");
    let cases: Vec<Value> = clauses
        .into_iter()
        .map(|(condition_type, function)| {
            let call = form![known::FUNCALL, function, inner.clone()];
            form![condition_type, call]
        })
        .collect();
    let content = form![plan.names.envelop_error, envelope.clone()];
    form![
        known::LAMBDA,
        form![envelope],
        form![
            known::LET,
            form![form![inner.clone(), content]],
            form![known::TYPECASE, inner; Value::list(cases)],
        ],
    ]
}

/// Does `(function name)` occur in a form?
fn mentions_function(form: &Value, name: Sym) -> bool {
    let mut pending = vec![form.clone()];
    while let Some(Value::Cons(cons)) = pending.pop() {
        let (head, rest) = (cons.car(), cons.cdr());
        if head.as_symbol() == Some(known::FUNCTION) && rest.car_or_nil().as_symbol() == Some(name)
        {
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

fn with_retry_counters(image: &mut Image, form: &Value) -> Expansion {
    let names = plan(image).names;
    let (definitions, body) = first_rest(form);
    let mut bindings = Vec::new();
    let mut counters = Vec::new();
    for definition in definitions.iter_list() {
        let (count, _) = first_rest(&definition);
        let name = definition.car_or_nil();
        let (start, left) = (gensym(image, "START"), gensym(image, "COUNTER"));
        bindings.push(form![start.clone(), count]);
        bindings.push(form![left.clone(), start.clone()]);
        counters.push(form![name, left, start]);
    }
    let counters = quoted(Value::list(counters));
    let (counter, forms) = (gensym(image, "NAME"), gensym(image, "BODY"));
    let definition = |name: Sym, parameters: Value, expand: Sym, args: Value| {
        form![name, parameters, form![expand, counters.clone(); args]]
    };
    let macros = form![
        definition(
            names.do_retry,
            form![counter.clone(), known::L_BODY, forms.clone()],
            names.sys_expand_do_retry,
            form![counter.clone(), forms],
        ),
        definition(
            names.get_counter,
            form![counter.clone()],
            names.sys_expand_get_counter,
            form![counter.clone()],
        ),
        definition(
            names.reset_counter,
            form![counter.clone()],
            names.sys_expand_reset_counter,
            form![counter],
        ),
    ];
    Ok(form![
        known::LET_STAR,
        Value::list(bindings),
        form![known::MACROLET, macros; body],
    ])
}

/// The variables of a counter: what is left, and the start. `NIL` if there is no counter
/// of that name.
fn counter(counters: &Value, name: &Value) -> (Value, Value) {
    let found = counters
        .iter_list()
        .find(|c| c.car_or_nil().is_eq(name))
        .unwrap_or(Value::NIL);
    let (left, rest) = first_rest(&found);
    (left, rest.car_or_nil())
}

/// The expansion of `do-retry`.
pub(in crate::plan) fn do_retry(counters: &Value, name: &Value, body: &Value) -> Value {
    let (left, _) = counter(counters, name);
    form![
        known::WHEN,
        form![known::GREATER, left.clone(), Value::Int(0)],
        form![known::SETQ, left.clone(), form![known::ONE_MINUS, left]];
        body.clone()
    ]
}

/// The expansion of `get-counter`.
pub(in crate::plan) fn get_counter(counters: &Value, name: &Value) -> Value {
    counter(counters, name).0
}

/// The expansion of `reset-counter`.
pub(in crate::plan) fn reset_counter(image: &Image, counters: &Value, name: &Value) -> Expansion {
    let (left, start) = counter(counters, name);
    if left.is_nil() {
        let shown = crate::lisp::print::to_string(image, name, true);
        return Err(Raise::program(format!(
            "There is no retry counter {shown} here."
        )));
    }
    Ok(form![known::SETQ, left, start])
}

//! Macros of control flow: conditionals, loops, handlers and restarts.

use super::form::form;
use crate::lisp::image::Image;
use crate::lisp::print;
use crate::lisp::value::Value;
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;
use crate::lisp::value::symbol::Sym;

type Expansion = Result<Value, Box<Raise>>;

/// The forms as one: a single form is itself.
fn progn(forms: Value) -> Value {
    if let Value::Cons(cons) = &forms
        && cons.cdr().is_nil()
    {
        return cons.car();
    }
    Value::cons(known::PROGN.into(), forms)
}

fn quote(value: Value) -> Value {
    form![known::QUOTE, value]
}

fn gensym(image: &mut Image, prefix: &str) -> Value {
    image.gensym(prefix).into()
}

/// First argument, and the others.
fn first_rest(form: &Value) -> (Value, Value) {
    let args = form.cdr_or_nil();
    (args.car_or_nil(), args.cdr_or_nil())
}

pub(super) fn when(_: &mut Image, form: &Value) -> Expansion {
    let (test, body) = first_rest(form);
    Ok(form![known::IF, test, progn(body)])
}

pub(super) fn unless(_: &mut Image, form: &Value) -> Expansion {
    let (test, body) = first_rest(form);
    Ok(form![known::IF, test, Value::NIL, progn(body)])
}

pub(super) fn cond(image: &mut Image, form: &Value) -> Expansion {
    let mut result = Value::NIL;
    let clauses: Vec<Value> = form.cdr_or_nil().iter_list().collect();
    for clause in clauses.iter().rev() {
        let Value::Cons(cons) = clause else {
            let shown = print::to_string(image, clause, true);
            return Err(Raise::program(format!(
                "COND clause is not a list: {shown}; (test form…) was expected."
            )));
        };
        let (test, body) = (cons.car(), cons.cdr());
        result = if body.is_nil() {
            form![known::OR, test, result]
        } else if test.as_symbol() == Some(known::T) {
            progn(body)
        } else {
            form![known::IF, test, progn(body), result]
        };
    }
    Ok(result)
}

/// What happens when no clause of a case form fits.
#[derive(Clone, Copy, PartialEq)]
enum Otherwise {
    Nil,
    Error,
}

pub(super) fn case(image: &mut Image, form: &Value) -> Expansion {
    case_form(image, form, Otherwise::Nil, false)
}

pub(super) fn ecase(image: &mut Image, form: &Value) -> Expansion {
    case_form(image, form, Otherwise::Error, false)
}

pub(super) fn ccase(image: &mut Image, form: &Value) -> Expansion {
    case_form(image, form, Otherwise::Error, false)
}

pub(super) fn typecase(image: &mut Image, form: &Value) -> Expansion {
    case_form(image, form, Otherwise::Nil, true)
}

pub(super) fn etypecase(image: &mut Image, form: &Value) -> Expansion {
    case_form(image, form, Otherwise::Error, true)
}

pub(super) fn ctypecase(image: &mut Image, form: &Value) -> Expansion {
    case_form(image, form, Otherwise::Error, true)
}

fn case_form(image: &mut Image, form: &Value, otherwise: Otherwise, by_type: bool) -> Expansion {
    let operator = form.car_or_nil();
    let (key_form, clauses) = first_rest(form);
    let key = gensym(image, "KEY");
    let clauses: Vec<Value> = clauses.iter_list().collect();
    let mut wanted = Vec::new();
    let mut cond_clauses = Vec::new();
    for (i, clause) in clauses.iter().enumerate() {
        let Value::Cons(cons) = clause else {
            let shown = print::to_string(image, clause, true);
            return Err(Raise::program(format!(
                "{shown} is not a clause: (key form…) was expected."
            )));
        };
        let (keys, mut body) = (cons.car(), cons.cdr());
        if body.is_nil() {
            body = form![Value::NIL];
        }
        let is_last = i + 1 == clauses.len();
        let is_default = matches!(keys.as_symbol(), Some(known::T | known::OTHERWISE))
            && is_last
            && otherwise == Otherwise::Nil;
        let test = if is_default {
            Value::T
        } else if by_type {
            wanted.push(keys.clone());
            form![known::TYPEP, key.clone(), quote(keys)]
        } else {
            let keys: Vec<Value> = match &keys {
                Value::Symbol(known::NIL) => Vec::new(),
                Value::Cons(_) => keys.iter_list().collect(),
                single => vec![single.clone()],
            };
            wanted.extend(keys.iter().cloned());
            let tests = keys.into_iter().map(|k| {
                let is_simple = matches!(k, Value::Symbol(_));
                let test = if is_simple { known::EQ } else { known::EQL };
                form![test, key.clone(), quote(k)]
            });
            Value::cons(known::OR.into(), Value::list(tests.collect::<Vec<_>>()))
        };
        cond_clauses.push(Value::cons(test, body));
    }
    if otherwise == Otherwise::Error {
        let failure = form![
            known::CASE_FAILED,
            key.clone(),
            quote(operator),
            quote(Value::list(wanted))
        ];
        cond_clauses.push(form![Value::T, failure]);
    }
    let body = Value::cons(known::COND.into(), Value::list(cond_clauses));
    Ok(form![known::LET, form![form![key, key_form]], body])
}

/// All values of the form reach the catch.
pub(super) fn throw(_: &mut Image, form: &Value) -> Expansion {
    let (tag, rest) = first_rest(form);
    Ok(form![
        known::MULTIPLE_VALUE_CALL,
        form![known::FUNCTION, known::THROW_VALUES],
        form![known::VALUES, tag],
        rest.car_or_nil()
    ])
}

pub(super) fn return_(_: &mut Image, form: &Value) -> Expansion {
    let (value, _) = first_rest(form);
    Ok(form![known::RETURN_FROM, Value::NIL, value])
}

pub(super) fn do_(image: &mut Image, form: &Value) -> Expansion {
    do_form(image, form, known::LET, known::PSETQ)
}

pub(super) fn do_star(image: &mut Image, form: &Value) -> Expansion {
    do_form(image, form, known::LET_STAR, known::SETQ)
}

fn do_form(image: &mut Image, form: &Value, binder: Sym, stepper: Sym) -> Expansion {
    let (specs, rest) = first_rest(form);
    let (end, body) = (rest.car_or_nil(), rest.cdr_or_nil());
    let mut bindings = Vec::new();
    let mut steps = Vec::new();
    for spec in specs.iter_list() {
        match &spec {
            Value::Cons(cons) => {
                let init = cons.cdr();
                bindings.push(form![cons.car(), init.car_or_nil()]);
                if let Value::Cons(step) = init.cdr_or_nil() {
                    steps.push(cons.car());
                    steps.push(step.car());
                }
            }
            name => bindings.push(form![name.clone()]),
        }
    }
    let split = super::body::split_declarations(&body);
    let again = gensym(image, "AGAIN");
    let test = form![
        known::WHEN,
        end.car_or_nil(),
        form![known::RETURN_FROM, Value::NIL, progn(end.cdr_or_nil())]
    ];
    let step = Value::cons(stepper.into(), Value::list(steps));
    let mut statements = vec![known::TAGBODY.into(), again.clone(), test];
    statements.push(Value::cons(known::TAGBODY.into(), split.forms));
    statements.push(step);
    statements.push(form![known::GO, again]);
    let mut let_form = vec![Value::from(binder), Value::list(bindings)];
    let_form.extend(split.declarations);
    let_form.push(Value::list(statements));
    Ok(form![known::BLOCK, Value::NIL, Value::list(let_form)])
}

pub(super) fn dolist(image: &mut Image, form: &Value) -> Expansion {
    let (spec, body) = first_rest(form);
    let var = spec.car_or_nil();
    let list_form = spec.cdr_or_nil().car_or_nil();
    let result = spec.cdr_or_nil().cdr_or_nil();
    let split = super::body::split_declarations(&body);
    let (list, again, end) = (
        gensym(image, "LIST"),
        gensym(image, "AGAIN"),
        gensym(image, "END"),
    );
    let mut let_form = vec![
        Value::from(known::LET),
        form![form![var.clone(), form![known::CAR, list.clone()]]],
    ];
    let_form.extend(split.declarations);
    let_form.push(Value::cons(known::TAGBODY.into(), split.forms));
    let result = if result.is_nil() {
        Value::NIL
    } else {
        form![
            known::LET,
            form![form![var.clone(), Value::NIL]],
            form![known::DECLARE, form![known::IGNORABLE, var]],
            result.car_or_nil()
        ]
    };
    let statements = form![
        known::TAGBODY,
        again.clone(),
        form![
            known::IF,
            form![known::ENDP, list.clone()],
            form![known::GO, end.clone()]
        ],
        Value::list(let_form),
        form![known::SETQ, list.clone(), form![known::CDR, list.clone()]],
        form![known::GO, again],
        end,
    ];
    let loop_form = form![
        known::LET,
        form![form![list, list_form]],
        statements,
        result
    ];
    Ok(form![known::BLOCK, Value::NIL, loop_form])
}

pub(super) fn dotimes(image: &mut Image, form: &Value) -> Expansion {
    let (spec, body) = first_rest(form);
    let var = spec.car_or_nil();
    let count_form = spec.cdr_or_nil().car_or_nil();
    let result = spec.cdr_or_nil().cdr_or_nil().car_or_nil();
    let split = super::body::split_declarations(&body);
    let (count, again, end) = (
        gensym(image, "COUNT"),
        gensym(image, "AGAIN"),
        gensym(image, "END"),
    );
    let statements = form![
        known::TAGBODY,
        again.clone(),
        form![
            known::IF,
            form![known::GREATER_EQUAL, var.clone(), count.clone()],
            form![known::GO, end.clone()]
        ],
        Value::cons(known::TAGBODY.into(), split.forms),
        form![
            known::SETQ,
            var.clone(),
            form![known::ONE_PLUS, var.clone()]
        ],
        form![known::GO, again],
        end,
    ];
    let mut let_form = vec![
        Value::from(known::LET_STAR),
        form![form![count, count_form], form![var, Value::Int(0)]],
    ];
    let_form.extend(split.declarations);
    let_form.push(statements);
    let_form.push(result);
    Ok(form![known::BLOCK, Value::NIL, Value::list(let_form)])
}

pub(super) fn prog(_: &mut Image, form: &Value) -> Expansion {
    prog_form(form, known::LET)
}

pub(super) fn prog_star(_: &mut Image, form: &Value) -> Expansion {
    prog_form(form, known::LET_STAR)
}

fn prog_form(form: &Value, binder: Sym) -> Expansion {
    let (bindings, body) = first_rest(form);
    let split = super::body::split_declarations(&body);
    let mut let_form = vec![Value::from(binder), bindings];
    let_form.extend(split.declarations);
    let_form.push(Value::cons(known::TAGBODY.into(), split.forms));
    Ok(form![known::BLOCK, Value::NIL, Value::list(let_form)])
}

pub(super) fn multiple_value_list(_: &mut Image, form: &Value) -> Expansion {
    let (values, _) = first_rest(form);
    Ok(form![
        known::MULTIPLE_VALUE_CALL,
        form![known::FUNCTION, known::LIST],
        values
    ])
}

pub(super) fn multiple_value_setq(_: &mut Image, form: &Value) -> Expansion {
    let (names, rest) = first_rest(form);
    let values = rest.car_or_nil();
    if names.is_nil() {
        return Ok(form![known::PROG1, values]);
    }
    let place = Value::cons(known::VALUES.into(), names);
    Ok(form![known::VALUES, form![known::SETF, place, values]])
}

/// Each clause is a tag: its handler keeps the condition in a variable and jumps there.
pub(super) fn handler_case(image: &mut Image, form: &Value) -> Expansion {
    let (expression, clauses) = first_rest(form);
    let mut clauses: Vec<Value> = clauses.iter_list().collect();
    let no_error = clauses
        .iter()
        .position(|c| c.car_or_nil().as_symbol() == Some(known::K_NO_ERROR))
        .map(|i| clauses.remove(i));
    if let Some(no_error) = no_error {
        let (error_return, normal_return) = (
            gensym(image, "ERROR-RETURN"),
            gensym(image, "NORMAL-RETURN"),
        );
        let function = Value::cons(known::LAMBDA.into(), no_error.cdr_or_nil());
        let inner = Value::list_with_tail(
            [
                known::HANDLER_CASE.into(),
                form![known::RETURN_FROM, normal_return.clone(), expression],
            ],
            Value::list(clauses),
        );
        return Ok(form![
            known::BLOCK,
            error_return.clone(),
            form![
                known::MULTIPLE_VALUE_CALL,
                function,
                form![
                    known::BLOCK,
                    normal_return,
                    form![known::RETURN_FROM, error_return, inner]
                ]
            ]
        ]);
    }
    if clauses.is_empty() {
        return Ok(expression);
    }
    let (block, condition) = (gensym(image, "BLOCK"), gensym(image, "CONDITION"));
    let mut handlers = Vec::new();
    let mut statements = Vec::new();
    for clause in &clauses {
        let tag = gensym(image, "CLAUSE");
        let parameter = gensym(image, "C");
        let handler = form![
            known::LAMBDA,
            form![parameter.clone()],
            form![known::SETQ, condition.clone(), parameter],
            form![known::GO, tag.clone()]
        ];
        handlers.push(form![clause.car_or_nil(), handler]);
        statements.push(tag);
        let (variables, body) = first_rest(clause);
        let body = match variables.car_or_nil() {
            Value::Symbol(known::NIL) => Value::cons(known::LOCALLY.into(), body),
            variable => Value::list_with_tail(
                [known::LET.into(), form![form![variable, condition.clone()]]],
                body,
            ),
        };
        statements.push(form![known::RETURN_FROM, block.clone(), body]);
    }
    let protected = form![
        known::RETURN_FROM,
        block.clone(),
        form![known::HANDLER_BIND, Value::list(handlers), expression]
    ];
    let mut tagbody = vec![known::TAGBODY.into(), protected];
    tagbody.extend(statements);
    Ok(form![
        known::BLOCK,
        block,
        form![
            known::LET,
            form![form![condition, Value::NIL]],
            Value::list(tagbody)
        ]
    ])
}

pub(super) fn ignore_errors(image: &mut Image, form: &Value) -> Expansion {
    let condition = gensym(image, "CONDITION");
    Ok(form![
        known::HANDLER_CASE,
        progn(form.cdr_or_nil()),
        form![
            known::ERROR,
            form![condition.clone()],
            form![known::VALUES, Value::NIL, condition]
        ]
    ])
}

/// Keyword options at the start of a clause's body: (keyword, value) pairs, and the rest.
fn options(body: &Value, names: &[Sym]) -> (Vec<(Sym, Value)>, Value) {
    let mut found = Vec::new();
    let mut rest = body.clone();
    while let Some(name) = rest.car_or_nil().as_symbol() {
        if !names.contains(&name) {
            break;
        }
        let tail = rest.cdr_or_nil();
        found.push((name, tail.car_or_nil()));
        rest = tail.cdr_or_nil();
    }
    (found, rest)
}

/// The expression for a restart's report: a string stays one, anything else is a function.
fn report_expression(report: Value) -> Value {
    match report {
        Value::Str(_) => report,
        other => form![known::FUNCTION, other],
    }
}

pub(super) fn restart_case(image: &mut Image, form: &Value) -> Expansion {
    let (expression, clauses) = first_rest(form);
    let clauses: Vec<Value> = clauses.iter_list().collect();
    let (block, arguments) = (gensym(image, "BLOCK"), gensym(image, "ARGUMENTS"));
    let mut restarts = vec![known::LIST.into()];
    let mut statements = Vec::new();
    for clause in &clauses {
        let tag = gensym(image, "RESTART");
        let parameter = gensym(image, "ARGS");
        let (lambda_list, body) = first_rest(clause);
        let (found, body) = options(
            &body,
            &[known::K_REPORT, known::K_INTERACTIVE, known::K_TEST],
        );
        let function = form![
            known::LAMBDA,
            form![known::L_REST, parameter.clone()],
            form![known::SETQ, arguments.clone(), parameter],
            form![known::GO, tag.clone()]
        ];
        let option = |name: Sym| {
            found
                .iter()
                .find(|(n, _)| *n == name)
                .map(|(_, v)| v.clone())
        };
        let report = option(known::K_REPORT).map_or(Value::NIL, report_expression);
        let interactive =
            option(known::K_INTERACTIVE).map_or(Value::NIL, |f| form![known::FUNCTION, f]);
        restarts.push(form![
            known::MAKE_RESTART,
            quote(clause.car_or_nil()),
            function,
            report,
            interactive
        ]);
        statements.push(tag);
        let lambda = Value::list_with_tail([known::LAMBDA.into(), lambda_list], body);
        let call = form![
            known::APPLY,
            form![known::FUNCTION, lambda],
            arguments.clone()
        ];
        statements.push(form![known::RETURN_FROM, block.clone(), call]);
    }
    let protected = form![
        known::RETURN_FROM,
        block.clone(),
        form![known::WITH_RESTARTS, Value::list(restarts), expression]
    ];
    let mut tagbody = vec![known::TAGBODY.into(), protected];
    tagbody.extend(statements);
    Ok(form![
        known::BLOCK,
        block,
        form![
            known::LET,
            form![form![arguments, Value::NIL]],
            Value::list(tagbody)
        ]
    ])
}

pub(super) fn restart_bind(_: &mut Image, form: &Value) -> Expansion {
    let (bindings, body) = first_rest(form);
    let mut restarts = vec![known::LIST.into()];
    for binding in bindings.iter_list() {
        let (function, rest) = first_rest(&binding);
        let (found, _) = options(
            &rest,
            &[
                known::K_REPORT_FUNCTION,
                known::K_INTERACTIVE_FUNCTION,
                known::K_TEST_FUNCTION,
            ],
        );
        let option = |name: Sym| {
            found
                .iter()
                .find(|(n, _)| *n == name)
                .map_or(Value::NIL, |(_, v)| v.clone())
        };
        restarts.push(form![
            known::MAKE_RESTART,
            quote(binding.car_or_nil()),
            function,
            option(known::K_REPORT_FUNCTION),
            option(known::K_INTERACTIVE_FUNCTION)
        ]);
    }
    Ok(Value::list_with_tail(
        [known::WITH_RESTARTS.into(), Value::list(restarts)],
        body,
    ))
}

pub(super) fn with_simple_restart(_: &mut Image, form: &Value) -> Expansion {
    let (spec, body) = first_rest(form);
    let report = form![
        known::LAMBDA,
        form![known::STREAM];
        form![Value::list_with_tail(
            [known::FORMAT.into(), known::STREAM.into()],
            spec.cdr_or_nil()
        )]
    ];
    Ok(form![
        known::RESTART_CASE,
        progn(body),
        form![
            spec.car_or_nil(),
            Value::NIL,
            known::K_REPORT,
            report,
            form![known::VALUES, Value::NIL, Value::T]
        ]
    ])
}

pub(super) fn with_condition_restarts(_: &mut Image, form: &Value) -> Expansion {
    let (condition, rest) = first_rest(form);
    let (restarts, body) = (rest.car_or_nil(), rest.cdr_or_nil());
    Ok(form![known::PROGN, condition, restarts, progn(body)])
}

pub(super) fn assert(_: &mut Image, form: &Value) -> Expansion {
    let (test, rest) = first_rest(form);
    let datum = rest.cdr_or_nil();
    let failure = if datum.is_nil() {
        form![
            known::ERROR,
            "The assertion ~S failed.",
            quote(test.clone())
        ]
    } else {
        Value::cons(known::ERROR.into(), datum)
    };
    let failure = form![
        known::WITH_SIMPLE_RESTART,
        form![known::CONTINUE, "Go on without it."],
        failure
    ];
    Ok(form![
        known::IF,
        test,
        Value::NIL,
        form![known::PROGN, failure, Value::NIL]
    ])
}

pub(super) fn check_type(_: &mut Image, form: &Value) -> Expansion {
    let (place, rest) = first_rest(form);
    let wanted = rest.car_or_nil();
    let failure = form![
        known::CHECK_TYPE_FAILED,
        place.clone(),
        quote(place.clone()),
        quote(wanted.clone()),
        rest.cdr_or_nil().car_or_nil()
    ];
    Ok(form![
        known::IF,
        form![known::TYPEP, place, quote(wanted)],
        Value::NIL,
        failure
    ])
}

pub(super) fn time(_: &mut Image, form: &Value) -> Expansion {
    let (timed, _) = first_rest(form);
    Ok(form![
        known::CALL_WITH_TIMING,
        form![known::LAMBDA, Value::NIL, timed]
    ])
}

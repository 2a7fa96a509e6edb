//! The conditionals and loops that programs use most, in Rust because each expansion takes time
//! when a file is loaded. The others are in Lisp, in `library/control.lisp`.

use crate::guard::Pace;
use crate::image::Image;
use crate::print;
use crate::value::Value;
use crate::value::form::{form, progn, quoted as quote, split_body};
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;

type Expansion = Result<Value, Box<Raise>>;

fn gensym(image: &mut Image, prefix: &str) -> Value {
    image.gensym(prefix)
}

/// First argument, and the others.
fn first_rest(form: &Value) -> (Value, Value) {
    let args = form.cdr_or_nil();
    (args.car_or_nil(), args.cdr_or_nil())
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

pub(super) fn typecase(image: &mut Image, form: &Value) -> Expansion {
    case_form(image, form, Otherwise::Nil, true)
}

pub(super) fn etypecase(image: &mut Image, form: &Value) -> Expansion {
    case_form(image, form, Otherwise::Error, true)
}

fn case_form(image: &mut Image, form: &Value, otherwise: Otherwise, by_type: bool) -> Expansion {
    let operator = form.car_or_nil();
    let (key_form, clauses) = first_rest(form);
    let key = gensym(image, "KEY");
    let clauses: Vec<Value> = clauses.iter_list().collect();
    let mut wanted = Vec::new();
    let mut cond_clauses = Vec::new();
    let mut pace = Pace::default();
    for (i, clause) in clauses.iter().enumerate() {
        pace.step();
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
                Value::Symbol(known::NIL, ..) => Vec::new(),
                Value::Cons(_) => keys.iter_list().collect(),
                single => vec![single.clone()],
            };
            wanted.extend(keys.iter().cloned());
            let tests = keys.into_iter().map(|k| {
                let is_simple = matches!(k, Value::Symbol(..));
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

pub(super) fn do_(image: &mut Image, form: &Value) -> Expansion {
    do_form(image, form, known::LET, known::PSETQ)
}

pub(super) fn do_star(image: &mut Image, form: &Value) -> Expansion {
    do_form(image, form, known::LET_STAR, known::SETQ)
}

fn do_form(image: &mut Image, form: &Value, binder: Sym, stepper: Sym) -> Expansion {
    let (specs, rest) = first_rest(form);
    let (end, body) = (rest.car_or_nil(), rest.cdr_or_nil());
    let malformed = |image: &Image, wrong: &Value, wanted: &str| {
        Raise::program(format!(
            "{} in {}: {wanted} was expected.",
            print::to_string(image, wrong, true),
            print::to_string(image, &form.car_or_nil(), true)
        ))
    };
    let mut bindings = Vec::new();
    let mut steps = Vec::new();
    let Some(specs) = specs.list_to_vec() else {
        return Err(malformed(
            image,
            &specs,
            "a list of variables, ((variable first next)…),",
        ));
    };
    for spec in specs {
        let parts = match &spec {
            Value::Cons(_) => spec.list_to_vec().unwrap_or_default(),
            name => vec![name.clone()],
        };
        match parts.as_slice() {
            [name @ Value::Symbol(..)] => bindings.push(form![name.clone()]),
            [name @ Value::Symbol(..), init] => bindings.push(form![name.clone(), init.clone()]),
            [name @ Value::Symbol(..), init, step] => {
                bindings.push(form![name.clone(), init.clone()]);
                steps.extend([name.clone(), step.clone()]);
            }
            _ => {
                return Err(malformed(
                    image,
                    &spec,
                    "a variable, (variable first next),",
                ));
            }
        }
    }
    let is_end = matches!(&end, Value::Cons(_)) && end.list_to_vec().is_some();
    if !is_end {
        return Err(malformed(
            image,
            &end,
            "when to end and with what values, (test form…),",
        ));
    }
    let split = split_body(&body);
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
    let split = split_body(&body);
    let (list, again, end) = (
        gensym(image, "LIST"),
        gensym(image, "AGAIN"),
        gensym(image, "END"),
    );
    let mut let_form = vec![
        Value::from(known::LET),
        form![form![var.clone(), form![known::CAR, list.clone()]]],
    ];
    let_form.extend(split.declarations.clone());
    let_form.push(Value::cons(known::TAGBODY.into(), split.forms));
    let result = if result.is_nil() {
        Value::NIL
    } else {
        // The declarations hold for the result, too, except for what is said of the elements.
        let mut let_result = vec![
            known::LET.into(),
            form![form![var.clone(), Value::NIL]],
            form![known::DECLARE, form![known::IGNORABLE, var]],
        ];
        let declarations = split.declarations.iter();
        let_result.extend(declarations.filter_map(without_types));
        let_result.push(result.car_or_nil());
        Value::list(let_result)
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

/// What a declaration says of special variables.
fn without_types(declaration: &Value) -> Option<Value> {
    let specifiers = declaration.cdr_or_nil();
    let special = specifiers
        .iter_list()
        .filter(|specifier| specifier.car_or_nil().as_symbol() == Some(known::SPECIAL));
    let special: Vec<Value> = special.collect();
    (!special.is_empty())
        .then(|| Value::list_with_tail([known::DECLARE.into()], Value::list(special)))
}

pub(super) fn dotimes(image: &mut Image, form: &Value) -> Expansion {
    let (spec, body) = first_rest(form);
    let var = spec.car_or_nil();
    let count_form = spec.cdr_or_nil().car_or_nil();
    let result = spec.cdr_or_nil().cdr_or_nil().car_or_nil();
    let split = split_body(&body);
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

pub(super) fn multiple_value_list(_: &mut Image, form: &Value) -> Expansion {
    let (values, _) = first_rest(form);
    Ok(form![
        known::MULTIPLE_VALUE_CALL,
        form![known::FUNCTION, known::LIST],
        values
    ])
}

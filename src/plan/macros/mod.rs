//! The macros of the plan language, by topic.

mod combinators;
mod failure_handling;
mod functions;
mod goals;
mod policies;
mod suspension;
mod tags;
mod variables;

use std::rc::Rc;

use crate::lisp::builtin::{Expander, Operator};
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::form::{form, quote};
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;

use super::state::Plan;

pub(super) use failure_handling::{do_retry, get_counter, reset_counter};

/// Macros of package `CRAM-LANGUAGE-IMPLEMENTATION`, which `CRAM-LANGUAGE` exports, too.
pub(crate) static OPERATORS: &[&[Operator]] = &[
    combinators::OPERATORS,
    failure_handling::OPERATORS,
    functions::OPERATORS,
    goals::OPERATORS,
    policies::OPERATORS,
    suspension::OPERATORS,
    tags::OPERATORS,
    variables::OPERATORS,
];

/// Macros named by keywords.
pub(crate) static KEYWORD_OPERATORS: &[Operator] = tags::KEYWORD_OPERATORS;

type Expansion = Result<Value, Box<Raise>>;

const fn macro_(
    name: &'static str,
    lambda_list: &'static str,
    doc: &'static str,
    examples: &'static [&'static str],
    expand: Expander,
) -> Operator {
    Operator {
        name,
        lambda_list,
        doc,
        examples,
        expand: Some(expand),
    }
}

fn plan(image: &Image) -> Rc<Plan> {
    Plan::of(image)
}

/// The first argument of a form, and the others.
fn first_rest(form: &Value) -> (Value, Value) {
    let args = form.cdr_or_nil();
    (args.car_or_nil(), args.cdr_or_nil())
}

/// A function of no arguments with a body.
fn thunk(body: Value) -> Value {
    form![known::LAMBDA, Value::NIL; body]
}

/// A function of no arguments with one form as its body.
fn thunk_of(body: Value) -> Value {
    thunk(form![body])
}

fn progn(body: Value) -> Value {
    form![known::PROGN; body]
}

fn gensym(image: &mut Image, prefix: &str) -> Value {
    image.gensym(prefix).into()
}

/// A form that signals an error unless inside a plan.
fn check_plan(plan: &Plan, name: &str) -> Value {
    form![plan.names.sys_check_plan, Value::string(name)]
}

/// The options of a list `(:name value …)`.
fn option(options: &Value, name: crate::lisp::value::symbol::Sym) -> Option<Value> {
    let mut rest = options.clone();
    while let Value::Cons(cons) = rest {
        let value = cons.cdr();
        if cons.car().as_symbol() == Some(name) {
            return Some(value.car_or_nil());
        }
        rest = value.cdr_or_nil();
    }
    None
}

fn quoted(value: impl Into<Value>) -> Value {
    quote(value)
}

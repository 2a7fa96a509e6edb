//! The macro `loop`: simple loops, and the loops that are written in clauses.
//!
//! A clause loop is read into a [`plan::Plan`] (variables, steps, body, results) and then turned
//! into one form: a named block around `let` forms around a `tagbody`. The words of clauses are
//! compared by name, whatever their package.

mod accumulation;
mod assign;
mod clauses;
mod emit;
mod iteration;
mod parser;
mod plan;
mod support;

use self::parser::Parser;
use super::value::known;
use super::value::raise::Raise;
use crate::builtin::Operator;
use crate::image::Image;
use crate::value::Value;

pub(crate) use support::SYSTEM_TABLE;

/// Expands `(loop …)`.
fn expand(image: &mut Image, form: &Value) -> Result<Value, Box<Raise>> {
    let Some(forms) = form.cdr_or_nil().list_to_vec() else {
        return Err(Raise::program("LOOP is not followed by a proper list."));
    };
    let expansion = if forms.iter().all(|f| matches!(f, Value::Cons(_))) {
        simple(image, forms)
    } else {
        let plan = clauses::parse(&mut Parser::new(image, forms))?;
        emit::form(image, plan)
    };
    if let (Value::Cons(from), Value::Cons(to)) = (form, &expansion) {
        to.set_place(from.place());
    }
    Ok(expansion)
}

/// A loop without clauses: repeats the forms for ever.
fn simple(image: &mut Image, forms: Vec<Value>) -> Value {
    let tag = image.gensym("AGAIN");
    let again = Value::list([known::GO.into(), tag.clone()]);
    let body = Value::list_with_tail(
        [known::TAGBODY.into(), tag],
        Value::list(forms.into_iter().chain([again]).collect::<Vec<_>>()),
    );
    Value::list([known::BLOCK.into(), Value::NIL, body])
}

/// `(loop-finish)` outside of a clause loop.
fn stray_finish(_: &mut Image, _: &Value) -> Result<Value, Box<Raise>> {
    Err(Raise::program(
        "LOOP-FINISH stands outside of a LOOP with clauses.",
    ))
}

/// `loop` and `loop-finish`.
pub(crate) static OPERATORS: &[Operator] = &[
    Operator {
        name: "LOOP",
        lambda_list: "&rest clauses",
        doc: "Repeats forms, or carries out clauses: for, as, with, repeat, while, until, do, collect, append, nconc, sum, count, maximize, minimize, always, never, thereis, when, if, unless, return, named, initially, finally.",
        examples: &[
            "(loop for i from 1 to 5 collect i) => (1 2 3 4 5)",
            "(loop for (k v) on '(:a 1 :b 2) by #'cddr collect (cons k v)) => ((:A . 1) (:B . 2))",
            "(loop for x in '(1 2 3 4) if (evenp x) sum x into even else sum x into odd finally (return (list even odd))) => (6 4)",
            "(let ((n 0)) (loop (when (= n 3) (return n)) (incf n))) => 3",
        ],
        expand: Some(expand),
    },
    Operator {
        name: "LOOP-FINISH",
        lambda_list: "",
        doc: "Ends the clause loop around it as if its last iteration were over.",
        examples: &["(loop for i from 0 when (= i 3) do (loop-finish) collect i) => (0 1 2)"],
        expand: Some(stray_finish),
    },
];

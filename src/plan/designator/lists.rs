//! `cut:`: bindings, and lazy lists, which are ordinary lists here.

use crate::lisp::builtin::{Builtin, Operator, control, pure};
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::known;
use crate::lisp::value::package::PackageTable;
use crate::lisp::value::raise::Raise;
use crate::lisp::vm::step::Step;

use crate::plan::packages;
use crate::plan::prolog::term::is_variable_name;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Functions of package `CRAM-UTILITIES`.
pub(crate) static TABLE: &[Builtin] = &[
    pure(
        "VAR-VALUE",
        "variable bindings",
        "What a ?variable is bound to in a list of bindings; itself if it is not.",
        &["(cut:var-value '?x '((?x . 1))) => 1"],
        |image, args| Ok(var_value(image, &args[0], &args[1])),
    ),
    pure(
        "IS-VAR",
        "object",
        "Is this a ?variable?",
        &["(cut:is-var '?x) => T"],
        |image, args| Ok(Value::bool(is_variable_name(image, &args[0]))),
    ),
    pure(
        "LAZY-CAR",
        "list",
        "The first element.",
        &["(cut:lazy-car '(1 2)) => 1"],
        |_, args| list(&args[0]).map(|l| l.car_or_nil()),
    ),
    pure(
        "LAZY-CDR",
        "list",
        "The list without its first element.",
        &["(cut:lazy-cdr '(1 2)) => (2)"],
        |_, args| list(&args[0]).map(|l| l.cdr_or_nil()),
    ),
    pure(
        "FORCE-LL",
        "list",
        "The list with all its elements.",
        &["(cut:force-ll '(1 2)) => (1 2)"],
        |_, args| list(&args[0]),
    ),
    pure(
        "LAZY-TAKE",
        "count list",
        "The first elements, at most so many.",
        &["(cut:lazy-take 2 '(1 2 3)) => (1 2)"],
        |_, args| {
            let Value::Int(count) = args[0] else {
                return Err(Raise::type_error(&args[0], known::INTEGER));
            };
            let count = usize::try_from(count).unwrap_or(0);
            let items: Vec<Value> = list(&args[1])?.iter_list().take(count).collect();
            Ok(Value::list(items))
        },
    ),
    control(
        "LAZY-MAPCAR",
        "function list &rest lists",
        "Like MAPCAR.",
        &["(cut:lazy-mapcar #'1+ '(1 2)) => (2 3)"],
        |machine, args| Ok(instead(machine.image, "MAPCAR", args)),
    ),
    control(
        "LAZY-MAPCAN",
        "function list &rest lists",
        "Like MAPCAN.",
        &["(cut:lazy-mapcan #'list '(1 2)) => (1 2)"],
        |machine, args| Ok(instead(machine.image, "MAPCAN", args)),
    ),
    control(
        "LAZY-FILTER",
        "predicate list",
        "The elements for which the predicate holds.",
        &["(cut:lazy-filter #'oddp '(1 2 3)) => (1 3)"],
        |machine, args| Ok(instead(machine.image, "REMOVE-IF-NOT", args)),
    ),
    pure(
        "LAZY-APPEND",
        "list &rest lists",
        "All elements of all lists.",
        &["(cut:lazy-append '(1) '(2)) => (1 2)"],
        |_, args| {
            let mut items = Vec::new();
            for arg in args {
                items.extend(list(arg)?.iter_list());
            }
            Ok(Value::list(items))
        },
    ),
];

/// Macros of package `CRAM-UTILITIES`.
pub(crate) static OPERATORS: &[Operator] = &[
    Operator {
        name: "WITH-VARS-BOUND",
        lambda_list: "variables bindings &body body",
        doc: "Binds ?variables to what a list of bindings says of them.",
        examples: &["(cut:with-vars-bound (?x) '((?x . 1)) ?x) => 1"],
        expand: Some(with_vars_bound),
    },
    Operator {
        name: "LAZY-DOLIST",
        lambda_list: "(variable list &optional result) &body body",
        doc: "Like DOLIST.",
        examples: &["(let ((s 0)) (cut:lazy-dolist (x '(1 2) s) (incf s x))) => 3"],
        expand: Some(|_, form| Ok(Value::cons(known::DOLIST.into(), form.cdr_or_nil()))),
    },
];

fn list(argument: &Value) -> Result<Value> {
    if argument.is_list() {
        return Ok(argument.clone());
    }
    Err(Raise::type_error(argument, known::LIST))
}

fn instead(image: &mut Image, name: &str, args: Vec<Value>) -> Step {
    Step::TailCall {
        function: image.intern(PackageTable::CL, name).into(),
        args,
    }
}

/// Variables may be bound to variables.
fn var_value(image: &Image, variable: &Value, bindings: &Value) -> Value {
    let mut value = variable.clone();
    // A chain is no longer than the list.
    for _ in bindings.iter_list() {
        if !is_variable_name(image, &value) {
            break;
        }
        let found = bindings
            .iter_list()
            .find(|pair| pair.car_or_nil().is_eq(&value));
        match found {
            Some(pair) => value = pair.cdr_or_nil(),
            None => break,
        }
    }
    value
}

fn with_vars_bound(image: &mut Image, form: &Value) -> Result<Value> {
    let rest = form.cdr_or_nil();
    let (variables, rest) = (rest.car_or_nil(), rest.cdr_or_nil());
    let (bindings, body) = (rest.car_or_nil(), rest.cdr_or_nil());
    let all = Value::from(image.gensym("BINDINGS"));
    let reader = packages::symbol(image, "CRAM-UTILITIES", "VAR-VALUE");
    let mut lets = vec![Value::list([all.clone(), bindings])];
    for variable in variables.iter_list() {
        let quoted = Value::list([known::QUOTE.into(), variable.clone()]);
        let read = Value::list([reader.into(), quoted, all.clone()]);
        lets.push(Value::list([variable, read]));
    }
    Ok(Value::list_with_tail(
        [known::LET_STAR.into(), Value::list(lets)],
        body,
    ))
}

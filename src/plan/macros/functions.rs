//! Functions that are plans: each call is a task at a node of the task tree.

use super::tags::with_tags;
use super::{Expansion, first_rest, macro_, option, plan, quoted, thunk, thunk_of};
use crate::lisp::builtin::Operator;
use crate::lisp::image::Image;
use crate::lisp::print;
use crate::lisp::value::Value;
use crate::lisp::value::form::{form, split_body};
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;
use crate::lisp::value::symbol::Sym;

/// The macros.
pub(crate) static OPERATORS: &[Operator] = &[
    macro_(
        "DEF-CRAM-FUNCTION",
        "name lambda-list &body body",
        "Defines a function for plans: a call is a task with a path of its own.",
        &["(cpl:def-cram-function pick (x) (list :picked x)) => PICK"],
        def_cram_function,
    ),
    macro_(
        "DEF-PLAN",
        "name lambda-list &body body",
        "The old name of DEF-CRAM-FUNCTION.",
        &["(cpl:def-plan place (x) (list :placed x)) => PLACE"],
        def_cram_function,
    ),
    macro_(
        "DEF-TOP-LEVEL-CRAM-FUNCTION",
        "name lambda-list &body body",
        "Defines a function that is a whole plan.",
        &["(cpl:def-top-level-cram-function main () :done) => MAIN"],
        def_top_level,
    ),
    macro_(
        "DEF-TOP-LEVEL-PLAN",
        "name lambda-list &body body",
        "The old name of DEF-TOP-LEVEL-CRAM-FUNCTION.",
        &["(cpl:def-top-level-plan main-plan () :done) => MAIN-PLAN"],
        def_top_level,
    ),
    macro_(
        "WITH-TASK-TREE-NODE",
        "(&key path-part name lambda-list parameters) &body body",
        "Runs the body in a task whose path begins with a part.",
        &[
            "(cpl:top-level (cpl:with-task-tree-node (:path-part '(x 1)) cpl-impl:*current-path*)) => ((X 1))",
        ],
        with_task_tree_node,
    ),
];

/// A function definition taken apart: its head, and its body as a call at a node.
struct Definition {
    name: Sym,
    head: Vec<Value>,
    call: Value,
}

fn definition(
    image: &mut Image,
    form: &Value,
    part: impl Fn(Sym) -> Value,
) -> Result<Definition, Box<Raise>> {
    let names = plan(image).names;
    let (name, rest) = first_rest(form);
    let Some(name) = name.as_symbol().filter(|n| *n != known::NIL) else {
        let shown = print::to_string(image, &name, true);
        return Err(Raise::program(format!(
            "{shown} is not the name of a plan."
        )));
    };
    let body = split_body(&rest.cdr_or_nil());
    let mut head: Vec<Value> = vec![known::DEFUN.into(), name.into(), rest.car_or_nil()];
    if let Some(doc) = &body.doc {
        head.push(Value::string(doc.as_ref()));
    }
    head.extend(body.declarations);
    let tagged = with_tags(image, body.forms);
    let function = thunk_of(form![known::BLOCK, name, tagged]);
    let what = Value::string(image.name(name));
    let call = form![names.sys_in_node, part(name), what, function];
    Ok(Definition { name, head, call })
}

fn def_cram_function(image: &mut Image, form: &Value) -> Expansion {
    let part = |name: Sym| quoted(form![name]);
    let mut definition = definition(image, form, part)?;
    definition.head.push(definition.call);
    Ok(Value::list(definition.head))
}

fn def_top_level(image: &mut Image, form: &Value) -> Expansion {
    let names = plan(image).names;
    let part = |name: Sym| quoted(form![names.top_level, name]);
    let mut definition = definition(image, form, part)?;
    definition.head.push(form![
        names.sys_top_level,
        quoted(definition.name),
        thunk_of(definition.call),
    ]);
    Ok(Value::list(definition.head))
}

fn with_task_tree_node(image: &mut Image, form: &Value) -> Expansion {
    let names = plan(image).names;
    let (options, body) = first_rest(form);
    let Some(part) = option(&options, names.path_part) else {
        return Err(Raise::simple("Path parameter is required."));
    };
    let name = option(&options, names.name).unwrap_or("WITH-TASK-TREE-NODE".into());
    let function = match option(&options, names.lambda_list) {
        Some(lambda_list) if lambda_list.is_true() => {
            let parameters = option(&options, names.parameters).unwrap_or(Value::NIL);
            let function = form![known::LAMBDA, lambda_list; body];
            thunk_of(form![known::APPLY, function, parameters])
        }
        _ => thunk(body),
    };
    Ok(form![names.sys_in_node, part, name, function])
}

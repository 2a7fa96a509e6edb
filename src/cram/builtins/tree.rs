//! The task tree: tags, and calls of plans at their own nodes.

use crate::Result;
use crate::request::Request;
use crate::state::Plan;
use crate::task::{Status, TaskName, TaskRef};
use crate::tree::{NodeObject, TreeNode};
use lisp::builtin::{Builtin, control, pure};
use lisp::image::Image;
use lisp::print;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;
use lisp::vm::step::Step;
use std::rc::Rc;

/// The builtins.
pub(crate) static TABLE: &[Builtin] = &[
    pure(
        "GET-TOP-LEVEL-TASK-TREE",
        "name",
        "The task tree of a plan defined by DEF-TOP-LEVEL-CRAM-FUNCTION.",
        &[],
        top_level_tree,
    ),
    pure(
        "REMOVE-TOP-LEVEL-TASK-TREE",
        "name",
        "Forgets the task tree of a named plan.",
        &[],
        |image, args| {
            let Some(name) = args[0].as_symbol() else {
                return Err(Raise::type_error(&args[0], known::SYMBOL));
            };
            let plan = Plan::of(image);
            let removed = plan.trees.borrow_mut().shift_remove(&name);
            Ok(Value::bool(removed.is_some()))
        },
    ),
    pure(
        "TASK-TREE-NODE-PATH",
        "node",
        "The path of a node, innermost part first.",
        &[],
        |image, args| Ok(node(image, &args[0])?.path.clone()),
    ),
    pure(
        "TASK-TREE-NODE-CHILDREN",
        "node",
        "The nodes below a node, as an association list by path part.",
        &[],
        |image, args| {
            let names = Plan::of(image).names;
            let children = node(image, &args[0])?.children();
            Ok(Value::list(
                children
                    .iter()
                    .map(|child| {
                        Value::cons(child.path.car_or_nil(), child.value(names.task_tree_node))
                    })
                    .collect::<Vec<_>>(),
            ))
        },
    ),
];

/// Builtins of package `PLAN-SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = &[
    control(
        "MAKE-TAG",
        "name",
        "A task for a tagged form, which has not begun.",
        &[],
        |m, args| {
            let name = args[0].as_symbol().unwrap_or(known::NIL);
            let name = TaskName::Given(m.image.name(name).into());
            let part = Value::list([tagged(m.image), args[0].clone()]);
            let task = task_at(m.image, name, &part)?;
            Ok(Step::Return(task.value()))
        },
    ),
    pure(
        "TAG-OUTSIDE",
        "name",
        "The error of a tag outside WITH-TAGS.",
        &[],
        |image, args| {
            let shown = print::to_string(image, &args[0], true);
            let text = format!("(:TAG {shown} ..) used outside of WITH-TAGS.");
            let current = Plan::of(image).names.current_task;
            // Inside a plan, the form has been compiled.
            Err(if image.special(current).is_nil() {
                Raise::simple(text)
            } else {
                Raise::new(known::COMPILED_PROGRAM_ERROR, text)
            })
        },
    ),
    control(
        "FRESH-TAG",
        "task name",
        "The task for the next run of a tagged form.",
        &[],
        |m, args| {
            let task = super::tasks::task(m.image, &args[0])?;
            if task.get().status() == Status::Created {
                return Ok(Step::Return(args[0].clone()));
            }
            let part = Value::list([tagged(m.image), args[1].clone()]);
            let task = task_at(m.image, task.get().name.clone(), &part)?;
            Ok(Step::Return(task.value()))
        },
    ),
    control(
        "RUN-TAG",
        "task function",
        "Runs a function as a task and returns its values.",
        &[],
        |m, args| {
            let task = super::tasks::task(m.image, &args[0])?;
            let function = args[1].clone();
            Ok(Step::request(Request::Run { task, function }))
        },
    ),
    control(
        "CALL-IN-NODE",
        "part name function",
        "Runs a function in a task at a node below the current one.",
        &[],
        |m, args| {
            let what = args[1].as_text().unwrap_or_default();
            let number = Plan::of(m.image).fresh_number();
            let task = task_at(m.image, TaskName::Numbered(what.into(), number), &args[0])?;
            let function = args[2].clone();
            Ok(Step::request(Request::Run { task, function }))
        },
    ),
];

fn tagged(image: &Image) -> Value {
    Plan::of(image).names.tagged.into()
}

/// A task at the next node for a part, below the current task's node.
fn task_at(image: &Image, name: TaskName, part: &Value) -> Result<TaskRef> {
    let plan = Plan::of(image);
    let current = image.special(plan.names.current_task);
    let Some(current) = TaskRef::from_value(current) else {
        return Err(Raise::type_error(&Value::NIL, plan.names.task_tree_node));
    };
    let node = current.get().node.enter(part, plan.names.call);
    Ok(TaskRef::new(&plan, name, false, node))
}

fn node(image: &Image, value: &Value) -> Result<Rc<TreeNode>> {
    match value.as_foreign::<NodeObject>() {
        Some(object) => Ok(object.node.clone()),
        None => Err(Raise::type_error(
            value,
            Plan::of(image).names.task_tree_node,
        )),
    }
}

fn top_level_tree(image: &mut Image, args: &[Value]) -> Result<Value> {
    let Some(name) = args[0].as_symbol() else {
        return Err(Raise::type_error(&args[0], known::SYMBOL));
    };
    let plan = Plan::of(image);
    let mut trees = plan.trees.borrow_mut();
    let tree = trees
        .entry(name)
        .or_insert_with(|| TreeNode::new(Value::NIL));
    Ok(tree.value(plan.names.task_tree_node))
}

//! The task tree: tags, and calls of plans at their own nodes.

use crate::Result;
use crate::request::Request;
use crate::state::Plan;
use crate::task::{Status, TaskName, TaskRef};
use crate::tree::{NodeObject, TreeNode};
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::print;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;
use lisp::vm::machine::Machine;
use lisp::vm::step::Step;
use std::rc::Rc;

/// Forgets the task tree of a named plan.
#[builtin]
fn remove_top_level_task_tree(image: &mut Image, name: &Value) -> Result<Value> {
    let Some(name) = name.as_symbol() else {
        return Err(Raise::type_error(name, known::SYMBOL));
    };
    let plan = Plan::of(image);
    let removed = plan.trees.borrow_mut().shift_remove(&name);
    Ok(Value::bool(removed.is_some()))
}

/// The path of a node, innermost part first.
#[builtin(_, "node")]
fn task_tree_node_path(image: &mut Image, node_value: &Value) -> Result<Value> {
    Ok(node(image, node_value)?.path.clone())
}

/// The nodes below a node, as an association list by path part.
#[builtin(_, "node")]
fn task_tree_node_children(image: &mut Image, node_value: &Value) -> Result<Value> {
    let names = Plan::of(image).names;
    let children = node(image, node_value)?.children();
    Ok(Value::list(
        children
            .iter()
            .map(|child| Value::cons(child.path.car_or_nil(), child.value(names.task_tree_node)))
            .collect::<Vec<_>>(),
    ))
}

/// A task for a tagged form, which has not begun.
#[builtin(_, "name")]
fn make_tag(machine: &mut Machine<'_>, name_value: &Value) -> Result<Step> {
    let name = name_value.as_symbol().unwrap_or(known::NIL);
    let name = TaskName::Given(machine.image.name(name).into());
    let part = Value::list([tagged(machine.image), name_value.clone()]);
    let task = task_at(machine.image, name, &part)?;
    Ok(Step::Return(task.value()))
}

/// The error of a tag outside WITH-TAGS.
#[builtin]
fn tag_outside(image: &mut Image, name: &Value) -> Result<Value> {
    let shown = print::to_string(image, name, true);
    let text = format!("(:TAG {shown} ..) used outside of WITH-TAGS.");
    let current = Plan::of(image).names.current_task;
    // Inside a plan, the form has been compiled.
    Err(if image.special(current).is_nil() {
        Raise::simple(text)
    } else {
        Raise::new(known::COMPILED_PROGRAM_ERROR, text)
    })
}

/// The task for the next run of a tagged form.
#[builtin(_, "task name")]
fn fresh_tag(machine: &mut Machine<'_>, task_value: &Value, name: Value) -> Result<Step> {
    let task = super::tasks::task(machine.image, task_value)?;
    if task.get().status() == Status::Created {
        return Ok(Step::Return(task_value.clone()));
    }
    let part = Value::list([tagged(machine.image), name]);
    let task = task_at(machine.image, task.get().name.clone(), &part)?;
    Ok(Step::Return(task.value()))
}

/// Runs a function as a task and returns its values.
#[builtin]
fn run_tag(machine: &mut Machine<'_>, task: &Value, function: Value) -> Result<Step> {
    let task = super::tasks::task(machine.image, task)?;
    Ok(Step::request(Request::Run { task, function }))
}

/// Runs a function in a task at a node below the current one.
#[builtin]
fn call_in_node(
    machine: &mut Machine<'_>,
    part: &Value,
    name: &Value,
    function: Value,
) -> Result<Step> {
    let what = name.as_text().unwrap_or_default();
    let number = Plan::of(machine.image).fresh_number();
    let task = task_at(machine.image, TaskName::Numbered(what.into(), number), part)?;
    Ok(Step::request(Request::Run { task, function }))
}

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

/// The task tree of a plan defined by DEF-TOP-LEVEL-CRAM-FUNCTION.
#[builtin("GET-TOP-LEVEL-TASK-TREE")]
fn top_level_tree(image: &mut Image, name: &Value) -> Result<Value> {
    let Some(name) = name.as_symbol() else {
        return Err(Raise::type_error(name, known::SYMBOL));
    };
    let plan = Plan::of(image);
    let mut trees = plan.trees.borrow_mut();
    let tree = trees
        .entry(name)
        .or_insert_with(|| TreeNode::new(Value::NIL));
    Ok(tree.value(plan.names.task_tree_node))
}

/// The builtins.
pub(crate) static TABLE: &[Builtin] = builtins![
    top_level_tree,
    remove_top_level_task_tree,
    task_tree_node_path,
    task_tree_node_children,
];

/// Builtins of package `PLAN-SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] =
    builtins![make_tag, tag_outside, fresh_tag, run_tag, call_in_node,];

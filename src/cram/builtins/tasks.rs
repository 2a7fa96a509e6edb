//! Tasks: status, result, evaporating, suspending.

use crate::Result;
use crate::fluent::{FluentRef, Operation};
use crate::request::Request;
use crate::state::Plan;
use crate::task::{Status, TaskRef};
use lisp::builtin::{Builtin, control, pure};
use lisp::builtins::keywords;
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;
use lisp::value::symbol::Sym;
use lisp::vm::calls::run;
use lisp::vm::machine::Machine;
use lisp::vm::step::Step;

/// The builtins.
pub(crate) static TABLE: &[Builtin] = &[
    pure(
        "STATUS",
        "task",
        "The fluent of a task's status: :CREATED, :RUNNING, :SUSPENDED, :SUCCEEDED, :FAILED or :EVAPORATED.",
        &["(cpl:top-level (cpl:value (cpl:status cpl:*current-task*))) => :RUNNING"],
        |image, args| {
            let task = task(image, &args[0])?;
            Ok(task.get().fluent(&Plan::of(image)).value())
        },
    ),
    pure(
        "RESULT",
        "task",
        "The values that a task ended with, its failure, or NIL.",
        &["(cpl:top-level (cpl:with-tags (:tag a 5) (cpl:result a))) => 5"],
        |image, args| Ok(task(image, &args[0])?.get().result.borrow().clone()),
    ),
    pure(
        "TASK-PATH",
        "task",
        "A task's path in the task tree, innermost part first.",
        &[
            "(cpl:top-level (cpl:with-tags (:tag a 5) (cpl:task-path a))) => ((CRAM-LANGUAGE-IMPLEMENTATION:TAGGED A))",
        ],
        |image, args| Ok(task(image, &args[0])?.get().node.path.clone()),
    ),
    pure(
        "TASK-ALIVE",
        "task",
        "A fluent that is true while the task has not ended.",
        &["(cpl:top-level (cpl:with-tags (:tag a 5) (cpl:value (cpl:task-alive a)))) => NIL"],
        |image, args| {
            let plan = Plan::of(image);
            let task = task(image, &args[0])?;
            Ok(status_net(image, &plan, &task, plan.names.alive).value())
        },
    ),
    pure(
        "TASK-DEAD",
        "task",
        "A fluent that is true when the task has ended.",
        &[
            "(cpl:top-level (cpl:with-tags (:tag a 5) (cpl:wait-for (cpl:task-dead a)) :ended)) => :ENDED",
        ],
        |image, args| {
            let plan = Plan::of(image);
            let task = task(image, &args[0])?;
            Ok(status_net(image, &plan, &task, plan.names.dead).value())
        },
    ),
    pure(
        "TASK-RUNNING-P",
        "task",
        "Has the task not ended?",
        &["(cpl:top-level (cpl:with-tags (:tag a 5) (cpl:task-running-p a))) => NIL"],
        |image, args| status_in(image, &args[0], |plan| plan.names.alive),
    ),
    pure(
        "TASK-DEAD-P",
        "task",
        "Has the task ended?",
        &[
            "(cpl:top-level (cpl:with-tags (:tag a 5) (cpl:task-dead-p a))) => (:SUCCEEDED :EVAPORATED)",
        ],
        |image, args| status_in(image, &args[0], |plan| plan.names.dead),
    ),
    pure(
        "TASK-DONE-P",
        "task",
        "Has the task ended without a failure?",
        &[
            "(cpl:top-level (cpl:with-tags (:tag a 5) (cpl:task-done-p a))) => (:SUCCEEDED :EVAPORATED)",
        ],
        |image, args| status_in(image, &args[0], |plan| plan.names.done),
    ),
    pure(
        "TASK-FAILED-P",
        "task",
        "Has the task ended with a failure?",
        &["(cpl:top-level (cpl:with-tags (:tag a 5) (cpl:task-failed-p a))) => NIL"],
        |image, args| {
            let status = task(image, &args[0])?.get().status();
            Ok(Value::bool(status == Status::Failed))
        },
    ),
    control(
        "EVAPORATE",
        "task &key reason sync",
        "Ends a task and all below it, running their cleanup forms; waits for that unless SYNC is NIL.",
        &[
            "(cpl:top-level (cpl:with-tags (cpl:par (:tag a (cpl:sleep 9) :a) (cpl:evaporate a)) (cpl:value (cpl:status a)))) => :EVAPORATED",
        ],
        evaporate,
    ),
    control(
        "SUSPEND",
        "task &key reason sync",
        "Lets a task and all below it hold still.",
        &[],
        |m, args| {
            let task = told(m, &args)?;
            Ok(Step::request(Request::Suspend(task)))
        },
    ),
    control(
        "WAKE-UP",
        "task &key reason sync",
        "Lets a suspended task and all below it go on.",
        &[],
        |m, args| {
            let task = told(m, &args)?;
            Ok(Step::request(Request::WakeUp(task)))
        },
    ),
    control(
        "JOIN-TASK",
        "task",
        "Waits for a task's end; returns its values or fails with its failure.",
        &["(cpl:top-level (cpl:with-tags (:tag a 5) (cpl:join-task a))) => 5"],
        |m, args| {
            let task = task(m.image, &args[0])?;
            Ok(Step::request(Request::Join(task)))
        },
    ),
    pure(
        "CURRENT-TASK",
        "",
        "The task that runs; NIL at the prompt.",
        &["(cpl:current-task) => NIL"],
        |image, _| Ok(image.special(Plan::of(image).names.current_task).clone()),
    ),
    control(
        "SLEEP*",
        "seconds",
        "Waits for so many simulated seconds.",
        &["(cpl:sleep* 1) => NIL"],
        |_, args| super::arithmetic::sleep(&args),
    ),
];

/// Builtins of package `PLAN-SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = &[
    control(
        "PUSH-SUSPENSION-HOOK",
        "function",
        "Calls the function when the current task is suspended.",
        &[],
        |_, args| Ok(Step::request(Request::Hook(args.into_iter().next()))),
    ),
    control(
        "POP-SUSPENSION-HOOK",
        "",
        "Forgets the last hook.",
        &[],
        |_, _| Ok(Step::request(Request::Hook(None))),
    ),
    control(
        "ALLOW-SCHEDULING",
        "change",
        "Allows (1) or forbids (-1) that the current task is disturbed while it waits.",
        &[],
        |_, args| {
            let change = match args[0] {
                Value::Int(n) if n < 0 => -1,
                _ => 1,
            };
            Ok(Step::request(Request::Scheduling(change)))
        },
    ),
    control(
        "WAIT-UNTIL-SUSPENDED",
        "task",
        "Waits until a task is suspended or has ended.",
        &[],
        |m, args| {
            let task = task(m.image, &args[0])?;
            wait_until_suspended(m, task)
        },
    ),
    pure(
        "DEFINE-TASK-VARIABLE",
        "name function",
        "Makes a variable one that each task binds anew.",
        &[],
        define_task_variable,
    ),
];

/// The task given as an argument, or a type error.
pub(super) fn task(image: &Image, value: &Value) -> Result<TaskRef> {
    TaskRef::from_value(value).ok_or_else(|| Raise::type_error(value, Plan::of(image).names.task))
}

/// The tail of a list of keywords from the first argument on.
fn member(_: &mut Image, args: &[Value]) -> Result<Value> {
    let mut rest = args[1].clone();
    while let Value::Cons(cons) = rest.clone() {
        if cons.car().is_eq(&args[0]) {
            return Ok(rest);
        }
        rest = cons.cdr();
    }
    Ok(Value::NIL)
}

/// A fluent that tells whether the status is in the list that a variable contains.
pub(super) fn status_net(image: &Image, plan: &Plan, task: &TaskRef, list: Sym) -> FluentRef {
    let args = vec![task.get().fluent(plan).value(), image.special(list).clone()];
    FluentRef::net(plan, "FN-FL-FUNCALL", Operation::Pure(member), args)
}

fn status_in(image: &mut Image, value: &Value, list: fn(&Plan) -> Sym) -> Result<Value> {
    let plan = Plan::of(image);
    let status = task(image, value)?.get().status().keyword(&plan.names);
    let list = image.special(list(&plan)).clone();
    member(image, &[status.into(), list])
}

/// The task that a request is about, from the arguments `task &key reason sync`.
fn told(machine: &Machine<'_>, args: &[Value]) -> Result<TaskRef> {
    let names = Plan::of(machine.image).names;
    keywords::parse(machine.image, &args[1..], [names.reason, names.sync])?;
    task(machine.image, &args[0])
}

fn evaporate(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step> {
    let names = Plan::of(machine.image).names;
    let [_, sync] = keywords::parse(machine.image, &args[1..], [names.reason, names.sync])?;
    let task = task(machine.image, &args[0])?;
    let sync = sync.is_none_or(|sync| sync.is_true());
    Ok(Step::request(Request::Evaporate { task, sync }))
}

fn wait_until_suspended(machine: &mut Machine<'_>, task: TaskRef) -> Result<Step> {
    let fluent = task.get().fluent(&Plan::of(machine.image)).clone();
    run(machine, "WITH-TASK-SUSPENDED", |calls| async move {
        loop {
            let status = task.get().status();
            if status == Status::Suspended || status.is_dead() {
                return Ok(Value::NIL);
            }
            let fluent = fluent.clone();
            let until = None;
            calls.request(Request::Wait { fluent, until }).await;
        }
    })
}

fn define_task_variable(image: &mut Image, args: &[Value]) -> Result<Value> {
    let Some(name) = args[0].as_symbol() else {
        return Err(Raise::type_error(&args[0], known::SYMBOL));
    };
    let plan = Plan::of(image);
    let init = Some(args[1].clone()).filter(Value::is_true);
    let mut variables = plan.task_variables.borrow_mut();
    variables.retain(|(other, _)| *other != name);
    variables.push((name, init.clone()));
    let inherit = image.function(plan.names.inherit_parent_value).cloned();
    Ok(init.or(inherit.map(Value::Function)).unwrap_or(Value::NIL))
}

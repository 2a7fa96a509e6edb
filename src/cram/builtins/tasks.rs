//! Tasks: status, result, evaporating, suspending.

use super::arithmetic::{self, Seconds};
use crate::Result;
use crate::fluent::{FluentRef, Operation};
use crate::request::Request;
use crate::state::Plan;
use crate::task::{Status, TaskRef};
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::typed::FromValue;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;
use lisp::value::symbol::Sym;
use lisp::vm::calls::run;
use lisp::vm::machine::Machine;
use lisp::vm::step::Step;

/// The fluent of a task's status: :CREATED, :RUNNING, :SUSPENDED, :SUCCEEDED, :FAILED or
/// :EVAPORATED.
///
/// `(cpl:top-level (cpl:value (cpl:status cpl:*current-task*)))` => `:RUNNING`
#[builtin]
fn status(image: &mut Image, task: TaskRef) -> Result<Value> {
    Ok(task.get().fluent(&Plan::of(image)).value())
}

/// The values that a task ended with, its failure, or NIL.
///
/// `(cpl:top-level (cpl:with-tags (:tag a 5) (cpl:result a)))` => `5`
#[builtin]
fn result(task: TaskRef) -> Result<Value> {
    Ok(task.get().result.borrow().clone())
}

/// A task's path in the task tree, innermost part first.
///
/// `(cpl:top-level (cpl:with-tags (:tag a 5) (cpl:task-path a)))` => `((CRAM-LANGUAGE-IMPLEMENTATION:TAGGED A))`
#[builtin]
fn task_path(task: TaskRef) -> Result<Value> {
    Ok(task.get().node.path.clone())
}

/// A fluent that is true while the task has not ended.
///
/// `(cpl:top-level (cpl:with-tags (:tag a 5) (cpl:value (cpl:task-alive a))))` => `NIL`
#[builtin]
fn task_alive(image: &mut Image, task: TaskRef) -> Result<Value> {
    let plan = Plan::of(image);
    Ok(status_net(image, &plan, &task, plan.names.alive).value())
}

/// A fluent that is true when the task has ended.
///
/// `(cpl:top-level (cpl:with-tags (:tag a 5) (cpl:wait-for (cpl:task-dead a)) :ended))` => `:ENDED`
#[builtin]
fn task_dead(image: &mut Image, task: TaskRef) -> Result<Value> {
    let plan = Plan::of(image);
    Ok(status_net(image, &plan, &task, plan.names.dead).value())
}

/// Has the task not ended?
///
/// `(cpl:top-level (cpl:with-tags (:tag a 5) (cpl:task-running-p a)))` => `NIL`
#[builtin]
fn task_running_p(image: &mut Image, task: &Value) -> Result<Value> {
    status_in(image, task, |plan| plan.names.alive)
}

/// Has the task ended?
///
/// `(cpl:top-level (cpl:with-tags (:tag a 5) (cpl:task-dead-p a)))` => `(:SUCCEEDED :EVAPORATED)`
#[builtin]
fn task_dead_p(image: &mut Image, task: &Value) -> Result<Value> {
    status_in(image, task, |plan| plan.names.dead)
}

/// Has the task ended without a failure?
///
/// `(cpl:top-level (cpl:with-tags (:tag a 5) (cpl:task-done-p a)))` => `(:SUCCEEDED :EVAPORATED)`
#[builtin]
fn task_done_p(image: &mut Image, task: &Value) -> Result<Value> {
    status_in(image, task, |plan| plan.names.done)
}

/// Has the task ended with a failure?
///
/// `(cpl:top-level (cpl:with-tags (:tag a 5) (cpl:task-failed-p a)))` => `NIL`
#[builtin]
fn task_failed_p(task: TaskRef) -> bool {
    let status = task.get().status();
    status == Status::Failed
}

/// Lets a task and all below it hold still.
#[builtin]
fn suspend(
    task: TaskRef,
    #[key] _reason: Option<&Value>,
    #[key] _sync: Option<&Value>,
) -> Result<Step> {
    Ok(Step::request(Request::Suspend(task)))
}

/// Lets a suspended task and all below it go on.
#[builtin]
fn wake_up(
    task: TaskRef,
    #[key] _reason: Option<&Value>,
    #[key] _sync: Option<&Value>,
) -> Result<Step> {
    Ok(Step::request(Request::WakeUp(task)))
}

/// Waits for a task's end; returns its values or fails with its failure.
///
/// `(cpl:top-level (cpl:with-tags (:tag a 5) (cpl:join-task a)))` => `5`
#[builtin]
fn join_task(task: TaskRef) -> Result<Step> {
    Ok(Step::request(Request::Join(task)))
}

/// The task that runs; NIL at the prompt.
///
/// `(cpl:current-task)` => `NIL`
#[builtin(_, "")]
fn current_task(image: &mut Image) -> Result<Value> {
    Ok(image.special(Plan::of(image).names.current_task).clone())
}

/// Waits for so many simulated seconds.
///
/// `(cpl:sleep* 1)` => `NIL`
#[builtin("SLEEP*")]
fn sleep(seconds: Seconds) -> Result<Step> {
    arithmetic::sleep(seconds)
}

/// Calls the function when the current task is suspended.
#[builtin]
fn push_suspension_hook(function: Value) -> Result<Step> {
    Ok(Step::request(Request::Hook(Some(function))))
}

/// Forgets the last hook.
#[builtin(_, "")]
fn pop_suspension_hook() -> Result<Step> {
    Ok(Step::request(Request::Hook(None)))
}

/// Allows (1) or forbids (-1) that the current task is disturbed while it waits.
#[builtin]
fn allow_scheduling(change: &Value) -> Result<Step> {
    let change = match change {
        Value::Int(n) if *n < 0 => -1,
        _ => 1,
    };
    Ok(Step::request(Request::Scheduling(change)))
}

/// Waits until a task is suspended or has ended.
#[builtin("WAIT-UNTIL-SUSPENDED")]
fn wait_until_suspended_builtin(machine: &mut Machine<'_>, task: TaskRef) -> Result<Step> {
    wait_until_suspended(machine, task)
}

impl FromValue<'_> for TaskRef {
    fn from_value(image: &mut Image, value: &Value) -> Result<Self> {
        task(image, value)
    }
}

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

/// Ends a task and all below it, running their cleanup forms; waits for that unless SYNC is NIL.
///
/// `(cpl:top-level (cpl:with-tags (cpl:par (:tag a (cpl:sleep 9) :a) (cpl:evaporate a)) (cpl:value (cpl:status a))))` => `:EVAPORATED`
#[builtin]
fn evaporate(
    task: TaskRef,
    #[key] _reason: Option<&Value>,
    #[key] sync: Option<bool>,
) -> Result<Step> {
    let sync = sync.unwrap_or(true);
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

/// Makes a variable one that each task binds anew.
#[builtin]
fn define_task_variable(image: &mut Image, name: &Value, function: Value) -> Result<Value> {
    let Some(name) = name.as_symbol() else {
        return Err(Raise::type_error(name, known::SYMBOL));
    };
    let plan = Plan::of(image);
    let init = Some(function).filter(Value::is_true);
    let mut variables = plan.task_variables.borrow_mut();
    variables.retain(|(other, _)| *other != name);
    variables.push((name, init.clone()));
    let inherit = image.function(plan.names.inherit_parent_value).cloned();
    Ok(init.or(inherit.map(Value::Function)).unwrap_or(Value::NIL))
}

/// The builtins.
pub(crate) static TABLE: &[Builtin] = builtins![
    status,
    result,
    task_path,
    task_alive,
    task_dead,
    task_running_p,
    task_dead_p,
    task_done_p,
    task_failed_p,
    evaporate,
    suspend,
    wake_up,
    join_task,
    current_task,
    sleep,
];

/// Builtins of package `PLAN-SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![
    push_suspension_hook,
    pop_suspension_hook,
    allow_scheduling,
    wait_until_suspended_builtin,
    define_task_variable,
];

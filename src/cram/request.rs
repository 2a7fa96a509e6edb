//! What builtins of the plan language request from the scheduler.

use super::fluent::FluentRef;
use super::task::TaskRef;
use lisp::value::Value;
use lisp::value::symbol::Sym;

/// A function and its arguments.
pub(crate) type Call = (Value, Vec<Value>);

/// A request to the scheduler.
pub(crate) enum Request {
    /// Wait for this many simulated seconds; the answer is `NIL`.
    Sleep(f64),
    /// Wait until the fluent is pulsed (the answer is `T`) or until a time (`NIL`).
    Wait {
        fluent: FluentRef,
        until: Option<f64>,
    },
    /// Start a plan and wait for its values.
    TopLevel { name: Option<Sym>, function: Value },
    /// Run functions in separate tasks, and wait for the result of the group.
    Group {
        kind: GroupKind,
        functions: Vec<Call>,
        /// The name of the form.
        name: &'static str,
    },
    /// Run a function in a task that has not begun, and wait for its values.
    Run { task: TaskRef, function: Value },
    /// Wait for the end of a task; the answer is its values or its failure.
    Join(TaskRef),
    /// Evaporate a task; with `sync`, wait until it has ended.
    Evaporate { task: TaskRef, sync: bool },
    /// Suspend a task and all below it until it is woken up.
    Suspend(TaskRef),
    /// Wake up a suspended task.
    WakeUp(TaskRef),
    /// Add a function to call when the current task is suspended, or remove the last one.
    Hook(Option<Value>),
    /// The hooks have been called: resume the interrupted wait.
    HooksDone,
    /// Forbid (-1), allow again, or allow temporarily (+1) that the current task is suspended or
    /// evaporated while it waits.
    Scheduling(i32),
    /// Describe, as a text, the tasks that are alive and those of the last plan that have ended.
    Overview,
}

/// When a group of tasks has ended, and how.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum GroupKind {
    /// All must succeed.
    All,
    /// The first to succeed decides; any failure fails the group.
    First,
    /// The first to succeed decides; the group fails only if all fail.
    Any,
}

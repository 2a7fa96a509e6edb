//! The functions of the plan language, by topic.

mod arithmetic;
mod combinators;
mod common;
mod failures;
mod fluents;
mod goals;
mod networks;
mod policies;
mod tasks;
mod tree;

pub(super) use goals::is_variable;

use crate::lisp::builtin::Builtin;
use crate::lisp::value::Value;
use crate::lisp::value::function::Function;
use crate::lisp::value::symbol::Sym;
use crate::lisp::vm::step::Step;

use super::request::{Call, Request};
use super::state::Plan;
use super::step::{call_then, request_then};

/// Functions of package `CRAM-LANGUAGE-IMPLEMENTATION`, which `CRAM-LANGUAGE` exports, too.
pub(crate) static FUNCTIONS: &[&[Builtin]] = &[
    failures::TABLE,
    fluents::TABLE,
    networks::TABLE,
    policies::TABLE,
    tasks::TABLE,
    tree::TABLE,
    goals::TABLE,
];

/// Functions of package `CRAM-LANGUAGE` itself: those that stand in for Common Lisp's.
pub(crate) static LANGUAGE: &[&[Builtin]] = &[arithmetic::TABLE];

/// Functions of package `PLAN-SYSTEM`.
pub(crate) static SYSTEM: &[&[Builtin]] = &[
    combinators::SYSTEM_TABLE,
    failures::SYSTEM_TABLE,
    goals::SYSTEM_TABLE,
    policies::SYSTEM_TABLE,
    tasks::SYSTEM_TABLE,
    tree::SYSTEM_TABLE,
];

/// What `setf` calls for places of the plan language.
pub(crate) static SETTERS: &[&[Builtin]] = &[fluents::SETTERS];

/// Functions of package `COMMON-LISP` that need the scheduler.
pub(crate) static COMMON_LISP: &[Builtin] = common::TABLE;

/// A function that waits for fluents, one after the other, and then calls another one.
pub(super) fn constrained(plan: &Plan, call: Call, constraints: Vec<Value>) -> Value {
    let wait_for = plan.names.wait_for;
    Value::Function(Function::made_control(
        plan.names.sys_run_constrained,
        (0, Some(0)),
        move |_, _| Ok(wait_for_all(wait_for, constraints.clone(), call.clone())),
    ))
}

fn wait_for_all(wait_for: Sym, mut constraints: Vec<Value>, call: Call) -> Step {
    match constraints.pop() {
        Some(constraint) => call_then("WAIT-FOR", wait_for, vec![constraint], move |_, _| {
            Ok(wait_for_all(wait_for, constraints, call))
        }),
        // If what it waited for has failed, its parent comes first and ends it.
        None => request_then("SLEEP", Request::Sleep(0.0), |_, _| Ok(tail_call(call))),
    }
}

fn tail_call((function, args): Call) -> Step {
    Step::TailCall { function, args }
}

/// A variable, the function that computes its value for a task, and its arguments.
pub(super) type Initialiser = (Sym, Value, Vec<Value>);

/// A function that sets task variables to what functions compute, and then calls another
/// one.
pub(super) fn initialised(plan: &Plan, call: Call, initialisers: Vec<Initialiser>) -> Value {
    Value::Function(Function::made_control(
        plan.names.sys_run_constrained,
        (0, Some(0)),
        move |_, _| Ok(initialise_all(initialisers.clone(), call.clone())),
    ))
}

fn initialise_all(mut initialisers: Vec<Initialiser>, call: Call) -> Step {
    match initialisers.pop() {
        Some((variable, init, args)) => {
            call_then("INITIALISE", init, args, move |machine, value| {
                machine.image.set_special(variable, value);
                Ok(initialise_all(initialisers, call))
            })
        }
        None => tail_call(call),
    }
}

/// A function that calls a suspended task's hooks, innermost first, and then waits on.
pub(super) fn hook_runner(plan: &Plan, hooks: Vec<Value>) -> Value {
    Value::Function(Function::made_control(
        plan.names.sys_hook,
        (0, Some(0)),
        move |_, _| Ok(run_hooks(hooks.clone())),
    ))
}

fn run_hooks(mut hooks: Vec<Value>) -> Step {
    match hooks.pop() {
        Some(hook) => call_then("ON-SUSPENSION", hook, Vec::new(), |_, _| {
            Ok(run_hooks(hooks))
        }),
        None => request_then("ON-SUSPENSION", Request::HooksDone, |_, value| {
            Ok(Step::Return(value))
        }),
    }
}

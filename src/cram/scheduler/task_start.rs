//! Functions that wrap what a task calls: waiting for constraints, setting task variables, running
//! hooks.

use crate::request::{Call, Request};
use crate::state::Plan;
use lisp::value::Value;
use lisp::value::function::Function;
use lisp::value::symbol::Sym;
use lisp::vm::calls::{Args, run};
use lisp::vm::step::Step;

/// A function that waits for fluents, one after another, and then calls another function.
pub(super) fn constrained(plan: &Plan, call: Call, constraints: Vec<Value>) -> Value {
    let wait_for = Value::from(plan.names.wait_for);
    Value::Function(Function::made_control(
        plan.names.sys_run_constrained,
        (0, Some(0)),
        move |machine, _| {
            let (function, args) = call.clone();
            let (wait_for, constraints) = (wait_for.clone(), constraints.clone());
            run(machine, "WAIT-FOR", |calls| async move {
                for constraint in constraints.into_iter().rev() {
                    calls.call1(&wait_for, constraint).await;
                }
                // If a task that it waited for has failed, the parent runs first and ends it.
                calls.request(Request::Sleep(0.0)).await;
                Ok(Step::tail_call(function, args))
            })
        },
    ))
}

/// A variable, the function that computes its value for a task, and its arguments.
pub(super) type Initialiser = (Sym, Value, Vec<Value>);

/// A function that sets task variables to the values computed by functions, and then calls another
/// function.
pub(super) fn initialised(plan: &Plan, call: Call, initialisers: Vec<Initialiser>) -> Value {
    Value::Function(Function::made_control(
        plan.names.sys_run_constrained,
        (0, Some(0)),
        move |machine, _| {
            let (function, args) = call.clone();
            let initialisers = initialisers.clone();
            run(machine, "INITIALISE", |calls| async move {
                for (variable, init, args) in initialisers.into_iter().rev() {
                    let value = calls.call(&init, Args::Many(args)).await;
                    calls
                        .with(move |machine| machine.image.set_special(variable, value))
                        .await;
                }
                Ok(Step::tail_call(function, args))
            })
        },
    ))
}

/// A function that calls a suspended task's hooks, innermost first, and then resumes the wait.
pub(super) fn hook_runner(plan: &Plan, hooks: Vec<Value>) -> Value {
    Value::Function(Function::made_control(
        plan.names.sys_hook,
        (0, Some(0)),
        move |machine, _| {
            let hooks = hooks.clone();
            run(machine, "ON-SUSPENSION", |calls| async move {
                for hook in hooks.into_iter().rev() {
                    calls.call(&hook, Args::Many(Vec::new())).await;
                }
                Ok(calls.request(Request::HooksDone).await)
            })
        },
    ))
}

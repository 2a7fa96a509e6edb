//! Restarts: finding those that apply, and invoking them.

use std::cell::RefCell;

use crate::builtin::Builtin;
use crate::evaluator::restart::Restart;
use crate::print;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;
use crate::vm::calls::{Args, Calls};
use crate::vm::step::Step;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Lets restarts belong to a condition; the condition.
#[builtin]
fn associate_restarts(condition: &Value, restarts: &Value) -> Result<Value> {
    change_conditions(condition, restarts, |conditions, condition| {
        conditions.push(condition)
    })
}

/// Ends that restarts belong to a condition; the condition.
#[builtin]
fn dissociate_restarts(condition: &Value, restarts: &Value) -> Result<Value> {
    change_conditions(condition, restarts, |conditions, condition| {
        if let Some(at) = conditions.iter().rposition(|c| c.is_eq(&condition)) {
            conditions.remove(at);
        }
    })
}

/// The restarts in force that apply to a condition, or to none in particular (`NIL`), innermost
/// first: a restart that belongs to conditions applies to no others, and its test has to hold.
async fn applicable(calls: &Calls, condition: Value) -> Vec<Value> {
    let all = calls.with(|machine| machine.restarts()).await;
    let mut applicable = Vec::new();
    for restart in all {
        let Some(known) = restart.as_foreign::<Restart>() else {
            continue;
        };
        if !known.may_apply_to(&condition) {
            continue;
        }
        let holds =
            known.test.is_nil() || calls.call1(&known.test, condition.clone()).await.is_true();
        if holds {
            applicable.push(restart.clone());
        }
    }
    applicable
}

/// All restarts in force that apply to the condition, innermost first.
///
/// `(restart-case (restart-name (first (compute-restarts))) (r () 1))` => `R`
#[builtin]
async fn compute_restarts(calls: Calls, #[default(Value::NIL)] condition: Value) -> Result<Value> {
    Ok(Value::list(applicable(&calls, condition).await))
}

/// The innermost restart of a name that applies to the condition, or NIL.
///
/// `(restart-case (restart-name (find-restart 'r)) (r () 1))` => `R`
#[builtin]
async fn find_restart(
    calls: Calls,
    restart: Value,
    #[default(Value::NIL)] condition: Value,
) -> Result<Value> {
    Ok(found(&calls, &restart, condition).await.into())
}

/// The restart that a designator means: the object itself if it is in force, or the innermost one of
/// that name that applies.
async fn found(calls: &Calls, designator: &Value, condition: Value) -> Option<Value> {
    let Some(name) = designator.as_symbol() else {
        let all = calls.with(|machine| machine.restarts()).await;
        return all.into_iter().find(|restart| restart.is_eq(designator));
    };
    let all = applicable(calls, condition).await;
    all.into_iter().find(|restart| {
        let restart = restart.as_foreign::<Restart>();
        restart.is_some_and(|restart| restart.name == name && name != known::NIL)
    })
}

async fn active(calls: &Calls, designator: Value) -> Result<Value> {
    if let Some(restart) = found(calls, &designator, Value::NIL).await {
        return Ok(restart);
    }
    let shown = calls.with(move |machine| print::to_string(machine.image, &designator, true));
    let shown = shown.await;
    Err(Raise::control(format!("No restart {shown} is active.")))
}

/// Calls the function of a restart.
///
/// `(restart-case (invoke-restart 'r 1) (r (x) x))` => `1`
#[builtin]
async fn invoke_restart(calls: Calls, restart: Value, arguments: Vec<Value>) -> Result<Step> {
    let restart = active(&calls, restart).await?;
    Ok(call_restart(&restart, arguments))
}

/// Calls the function of a restart with the arguments that its :interactive function returns.
///
/// `(restart-case (invoke-restart-interactively 'r) (r (x) :interactive (lambda () (list 1)) x))` => `1`
#[builtin]
async fn invoke_restart_interactively(calls: Calls, restart: Value) -> Result<Step> {
    let restart = active(&calls, restart).await?;
    let asks = restart.as_foreign::<Restart>();
    let asks = asks.map_or(Value::NIL, |restart| restart.interactive.clone());
    if asks.is_nil() {
        return Ok(call_restart(&restart, Vec::new()));
    }
    let args = calls.call(&asks, Args::Many(Vec::new())).await;
    let args = args
        .list_to_vec()
        .ok_or_else(|| Raise::type_error(&args, known::LIST))?;
    Ok(call_restart(&restart, args))
}

fn call_restart(restart: &Value, args: Vec<Value>) -> Step {
    let function = restart
        .as_foreign::<Restart>()
        .map_or(Value::NIL, |r| r.function.clone());
    Step::TailCall { function, args }
}

/// The name of a restart.
///
/// `(restart-case (restart-name (find-restart 'r)) (r () 1))` => `R`
#[builtin(_, "restart")]
fn restart_name(restart_value: &Value) -> Result<Value> {
    match restart_value.as_foreign::<Restart>() {
        Some(restart) => Ok(restart.name.into()),
        None => Err(Raise::type_error(restart_value, known::RESTART)),
    }
}

/// A restart object.
#[builtin]
fn make_restart(
    name: Sym,
    function: Value,
    report: Value,
    interactive: Value,
    #[default(Value::NIL)] test: Value,
) -> Value {
    Value::foreign(Restart {
        name,
        function,
        report,
        interactive,
        test,
        conditions: RefCell::default(),
    })
}

fn change_conditions(
    condition: &Value,
    restarts: &Value,
    change: fn(&mut Vec<Value>, Value),
) -> Result<Value> {
    for restart in restarts.iter_list() {
        let known = restart
            .as_foreign::<Restart>()
            .ok_or_else(|| Raise::type_error(&restart, known::RESTART))?;
        change(&mut known.conditions.borrow_mut(), condition.clone());
    }
    Ok(condition.clone())
}

/// Builtins of package `COMMON-LISP`.
pub(crate) static TABLE: &[Builtin] = builtins![
    invoke_restart,
    invoke_restart_interactively,
    find_restart,
    compute_restarts,
    restart_name,
];

/// Builtins of package `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] =
    builtins![make_restart, associate_restarts, dissociate_restarts,];

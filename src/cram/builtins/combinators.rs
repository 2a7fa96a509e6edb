//! What the parallel forms expand into.

use crate::Result;
use crate::fluent::FluentRef;
use crate::request::{Call, GroupKind, Request};
use crate::scheduler;
use crate::state::Plan;
use crate::task::TaskRef;
use lisp::builtin::Builtin;
use lisp::evaluator::signal::Declined;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::raise::Raise;
use lisp::vm::machine::Machine;
use lisp::vm::step::Step;

/// Calls functions in parallel; the values of the first.
#[builtin]
fn par(machine: &mut Machine<'_>, functions: Vec<Value>) -> Result<Step> {
    group(machine, "PAR", GroupKind::All, thunks(functions))
}

/// Calls functions in parallel until one returns.
#[builtin]
fn pursue(machine: &mut Machine<'_>, functions: Vec<Value>) -> Result<Step> {
    group(machine, "PURSUE", GroupKind::First, thunks(functions))
}

/// Calls functions in parallel until one succeeds.
#[builtin]
fn try_all(machine: &mut Machine<'_>, functions: Vec<Value>) -> Result<Step> {
    group(machine, "TRY-ALL", GroupKind::Any, thunks(functions))
}

/// Signals an error unless inside a plan.
#[builtin("CHECK-PLAN")]
fn check_plan_builtin(machine: &mut Machine<'_>, name: &Value) -> Result<Step> {
    check_plan(machine, &name.as_text().unwrap_or_default())?;
    Ok(Step::Return(Value::NIL))
}

/// Fails with a failure that holds others.
#[builtin]
fn all_failed(machine: &mut Machine<'_>, failures: &Value) -> Result<Step> {
    let plan = Plan::of(machine.image);
    let failures = failures.iter_list().collect();
    let failure = scheduler::composite(&plan, machine.image, failures)?;
    machine.signal(failure, Declined::Stop)
}

fn thunks(functions: Vec<Value>) -> Vec<Call> {
    functions.into_iter().map(|f| (f, Vec::new())).collect()
}

/// Fails unless the running code is part of a plan.
pub(super) fn check_plan(machine: &Machine<'_>, name: &str) -> Result<()> {
    let current = Plan::of(machine.image).names.current_task;
    if machine.image.special(current).is_nil() {
        return Err(scheduler::outside_a_plan(name));
    }
    Ok(())
}

fn group(
    machine: &mut Machine<'_>,
    name: &'static str,
    kind: GroupKind,
    functions: Vec<Call>,
) -> Result<Step> {
    check_plan(machine, name)?;
    Ok(Step::request(Request::Group {
        kind,
        functions,
        name,
    }))
}

/// The report of a plan that is begun in a plan.
pub const NESTED: &str = "top-level calls cannot be nested.";

/// Runs a function in the outermost task of a plan.
#[builtin(_, "name function")]
fn start(machine: &mut Machine<'_>, name_value: &Value, function_value: Value) -> Result<Step> {
    let current = Plan::of(machine.image).names.current_task;
    if machine.image.special(current).is_true() {
        return Err(Raise::simple(NESTED));
    }
    Ok(Step::request(Request::TopLevel {
        name: name_value.as_symbol().filter(|_| name_value.is_true()),
        function: function_value,
    }))
}

/// Calls a function on each element in parallel.
#[builtin]
fn par_loop(machine: &mut Machine<'_>, function: Value, list: &Value) -> Result<Step> {
    check_plan(machine, "PAR-LOOP")?;
    let Some(items) = list.list_to_vec() else {
        return Err(Raise::type_error(list, lisp::value::known::LIST));
    };
    if items.is_empty() {
        return Ok(Step::Return(Value::NIL));
    }
    let calls = items.into_iter().map(|i| (function.clone(), vec![i]));
    let calls = calls.collect();
    group(machine, "PAR-LOOP", GroupKind::All, calls)
}

/// Calls functions in parallel; tasks begin as lists of two tasks, the earlier one first, say.
#[builtin]
fn partial_order(machine: &mut Machine<'_>, orders: &Value, functions: Vec<Value>) -> Result<Step> {
    check_plan(machine, "PARTIAL-ORDER")?;
    let plan = Plan::of(machine.image);
    let mut edges: Vec<(TaskRef, TaskRef)> = Vec::new();
    for order in orders.iter_list() {
        let (first, second) = (order.car_or_nil(), order.cdr_or_nil().car_or_nil());
        let task = |value: &Value| {
            TaskRef::from_value(value).ok_or_else(|| Raise::type_error(value, plan.names.task))
        };
        let later = task(&second)?;
        let constraint = match FluentRef::from_value(&first) {
            Some(fluent) => FluentRef::pulses(&plan, &fluent, crate::fluent::Missed::Once),
            None => {
                let earlier = task(&first)?;
                edges.push((earlier.clone(), later.clone()));
                super::tasks::status_net(machine.image, &plan, &earlier, plan.names.dead)
            }
        };
        later
            .get()
            .constraints
            .borrow_mut()
            .push(constraint.value());
    }
    if let Some(circle) = circle(&edges) {
        for (_, later) in &edges {
            later.get().constraints.borrow_mut().clear();
        }
        return Err(Raise::simple(format!("The order is circular: {circle}.")));
    }
    group(machine, "PARTIAL-ORDER", GroupKind::All, thunks(functions))
}

/// A cycle among the orderings, in words, if there is one.
fn circle(edges: &[(TaskRef, TaskRef)]) -> Option<String> {
    // Repeatedly remove the orderings whose earlier task waits for none: if no ordering remains,
    // there is no cycle.
    let mut left: Vec<&(TaskRef, TaskRef)> = edges.iter().collect();
    loop {
        let before = left.len();
        let kept: Vec<_> = left
            .iter()
            .filter(|(earlier, _)| left.iter().any(|(_, later)| later.is(earlier)))
            .copied()
            .collect();
        left = kept;
        if left.len() == before {
            break;
        }
    }
    let (start, _) = left.first()?;
    // Each remaining task waits for another one, so following them leads around a cycle.
    let mut path = vec![start];
    while let Some((earlier, _)) = left
        .iter()
        .find(|(_, later)| path.last().is_some_and(|task| later.is(task)))
    {
        let seen = path.iter().position(|task| task.is(earlier));
        path.push(earlier);
        if let Some(seen) = seen {
            let names = path[seen..].iter().rev();
            let names: Vec<String> = names.map(|t| t.get().name.to_string()).collect();
            return Some(names.join(" before "));
        }
    }
    None
}

/// Builtins of package `PLAN-SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![
    start,
    par,
    pursue,
    try_all,
    par_loop,
    partial_order,
    check_plan_builtin,
    all_failed,
];

//! What the parallel forms expand into.

use crate::Result;
use crate::fluent::FluentRef;
use crate::request::{Call, GroupKind, Request};
use crate::scheduler;
use crate::state::Plan;
use crate::task::TaskRef;
use lisp::builtin::{Builtin, control};
use lisp::evaluator::signal::Declined;
use lisp::value::Value;
use lisp::value::raise::Raise;
use lisp::vm::machine::Machine;
use lisp::vm::step::Step;

/// Builtins of package `PLAN-SYSTEM`.
pub static SYSTEM_TABLE: &[Builtin] = &[
    control(
        "START",
        "name function",
        "Runs a function in the outermost task of a plan.",
        &[],
        start,
    ),
    control(
        "PAR",
        "&rest functions",
        "Calls functions in parallel; the values of the first.",
        &[],
        |m, args| group(m, "PAR", GroupKind::All, thunks(args)),
    ),
    control(
        "PURSUE",
        "&rest functions",
        "Calls functions in parallel until one returns.",
        &[],
        |m, args| group(m, "PURSUE", GroupKind::First, thunks(args)),
    ),
    control(
        "TRY-ALL",
        "&rest functions",
        "Calls functions in parallel until one succeeds.",
        &[],
        |m, args| group(m, "TRY-ALL", GroupKind::Any, thunks(args)),
    ),
    control(
        "PAR-LOOP",
        "function list",
        "Calls a function on each element in parallel.",
        &[],
        par_loop,
    ),
    control(
        "PARTIAL-ORDER",
        "orders &rest functions",
        "Calls functions in parallel; tasks begin as lists of two tasks, the earlier one first, say.",
        &[],
        partial_order,
    ),
    control(
        "CHECK-PLAN",
        "name",
        "Signals an error unless inside a plan.",
        &[],
        |m, args| {
            check_plan(m, &args[0].as_text().unwrap_or_default())?;
            Ok(Step::Return(Value::NIL))
        },
    ),
    control(
        "ALL-FAILED",
        "failures",
        "Fails with a failure that holds others.",
        &[],
        |m, args| {
            let plan = Plan::of(m.image);
            let failures = args[0].iter_list().collect();
            let failure = scheduler::composite(&plan, m.image, failures)?;
            m.signal(failure, Declined::Stop)
        },
    ),
];

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

fn start(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step> {
    let current = Plan::of(machine.image).names.current_task;
    if machine.image.special(current).is_true() {
        return Err(Raise::simple(NESTED));
    }
    Ok(Step::request(Request::TopLevel {
        name: args[0].as_symbol().filter(|_| args[0].is_true()),
        function: args[1].clone(),
    }))
}

fn par_loop(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step> {
    check_plan(machine, "PAR-LOOP")?;
    let Some(items) = args[1].list_to_vec() else {
        return Err(Raise::type_error(&args[1], lisp::value::known::LIST));
    };
    if items.is_empty() {
        return Ok(Step::Return(Value::NIL));
    }
    let calls = items.into_iter().map(|i| (args[0].clone(), vec![i]));
    let calls = calls.collect();
    group(machine, "PAR-LOOP", GroupKind::All, calls)
}

fn partial_order(machine: &mut Machine<'_>, mut args: Vec<Value>) -> Result<Step> {
    check_plan(machine, "PARTIAL-ORDER")?;
    let plan = Plan::of(machine.image);
    let orders = args.remove(0);
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
    group(machine, "PARTIAL-ORDER", GroupKind::All, thunks(args))
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

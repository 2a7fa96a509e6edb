//! Turning a loop's plan into a form.

use super::assign;
use super::plan::{Accumulator, Assignment, Building, Plan, Step};
use crate::image::Image;
use crate::value::Value;
use crate::value::known;

fn call(function: impl Into<Value>, args: impl IntoIterator<Item = Value>) -> Value {
    let args: Vec<Value> = args.into_iter().collect();
    Value::cons(function.into(), Value::list(args))
}

/// The form of a whole loop.
pub(crate) fn form(image: &mut Image, mut plan: Plan) -> Value {
    let next_tag = image.gensym("NEXT");
    let first_steps = steps(image, &mut plan, |plan| std::mem::take(&mut plan.first));
    let next_steps = steps(image, &mut plan, |plan| std::mem::take(&mut plan.next));
    let mut tagbody = std::mem::take(&mut plan.initially);
    tagbody.extend(first_steps);
    tagbody.push(next_tag.clone());
    tagbody.append(&mut plan.body);
    tagbody.extend(next_steps);
    tagbody.push(call(known::GO, [next_tag]));
    tagbody.push(plan.end_tag.clone());
    tagbody.append(&mut plan.finally);
    tagbody.push(call(known::RETURN_FROM, [plan.name.clone(), result(&plan)]));

    let go_end = call(known::GO, [plan.end_tag.clone()]);
    let finish = Value::list([
        known::LOOP_FINISH.into(),
        Value::NIL,
        call(known::QUOTE, [go_end]),
    ]);
    let mut form = call(known::TAGBODY, tagbody);
    form = call(known::MACROLET, [Value::list([finish]), form]);
    form = bind_accumulators(&plan, form);
    for group in plan.bindings.iter().rev() {
        if !group.is_empty() {
            form = call(known::LET, [bindings(group), form]);
        }
    }
    call(known::BLOCK, [plan.name, form])
}

/// Bindings of a group. Clauses that `and` does not join form groups of their own, but the
/// hidden variables of a clause do not refer to each other, so one `let` binds them all.
fn bindings(group: &[Assignment]) -> Value {
    Value::list(
        group
            .iter()
            .map(|(variable, form)| Value::list([variable.clone(), form.clone()])),
    )
}

fn bind_accumulators(plan: &Plan, body: Value) -> Value {
    let mut group: Vec<Assignment> = plan
        .scratch
        .iter()
        .map(|variable| (variable.clone(), Value::NIL))
        .collect();
    let mut tails = Vec::new();
    for accumulator in &plan.accumulators {
        let Accumulator {
            variable,
            front,
            tail,
            ..
        } = accumulator;
        match accumulator.building {
            Building::List => {
                group.push((front.clone(), call(known::LIST, [Value::NIL])));
                tails.push((tail.clone(), front.clone()));
                if accumulator.into.is_some() {
                    group.push((variable.clone(), Value::NIL));
                }
            }
            Building::Total => group.push((variable.clone(), Value::Int(0))),
            Building::Extreme => {
                group.push((variable.clone(), Value::NIL));
                group.push((tail.clone(), Value::NIL));
            }
        }
    }
    group.extend(tails);
    if group.is_empty() {
        return body;
    }
    call(known::LET_STAR, [bindings(&group), body])
}

/// What the loop returns when its last iteration is over.
fn result(plan: &Plan) -> Value {
    match plan.accumulators.iter().find(|a| a.into.is_none()) {
        Some(a) if a.building == Building::List => call(known::CDR, [a.front.clone()]),
        Some(a) => a.variable.clone(),
        None => Value::bool(plan.default_true),
    }
}

fn steps(
    image: &mut Image,
    plan: &mut Plan,
    take: impl FnOnce(&mut Plan) -> Vec<Step>,
) -> Vec<Value> {
    let mut forms = Vec::new();
    for step in take(plan) {
        ends(&step.tests, plan, &mut forms);
        assignments(image, plan, step.sets, &mut forms);
        ends(&step.tests_after, plan, &mut forms);
        assignments(image, plan, step.advances, &mut forms);
    }
    forms
}

fn ends(tests: &[Value], plan: &Plan, forms: &mut Vec<Value>) {
    for test in tests {
        let end = call(known::GO, [plan.end_tag.clone()]);
        forms.push(call(known::WHEN, [test.clone(), end]));
    }
}

/// Assigns variables in parallel, and then destructures the values of trees of variables.
fn assignments(image: &mut Image, plan: &mut Plan, sets: Vec<Assignment>, forms: &mut Vec<Value>) {
    let mut pairs = Vec::new();
    let mut parts = Vec::new();
    for (tree, form) in sets {
        if matches!(&tree, Value::Symbol(sym, ..) if *sym != known::NIL) {
            pairs.extend([tree, form]);
        } else {
            let whole = image.gensym("WHOLE");
            plan.scratch.push(whole.clone());
            for (variable, part) in assign::parts(&tree, &whole) {
                parts.extend([variable, part]);
            }
            pairs.extend([whole, form]);
        }
    }
    if !pairs.is_empty() {
        let operator = if pairs.len() > 2 {
            known::PSETQ
        } else {
            known::SETQ
        };
        forms.push(call(operator, pairs));
    }
    if !parts.is_empty() {
        forms.push(call(known::SETQ, parts));
    }
}

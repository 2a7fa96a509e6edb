//! Goals: plans that are chosen by matching the arguments of a call against patterns.

use crate::lisp::builtin::{Builtin, control, pure};
use crate::lisp::image::Image;
use crate::lisp::print;
use crate::lisp::value::Value;
use crate::lisp::value::equality;
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;
use crate::lisp::value::symbol::Sym;
use crate::lisp::vm::machine::Machine;
use crate::lisp::vm::step::Step;
use crate::plan::Result;
use crate::plan::state::{Goal, Plan};

/// The builtins.
pub(crate) static TABLE: &[Builtin] = &[pure(
    "DESCRIBE-GOAL",
    "goal",
    "The documentation of the goal with a pattern, or NIL.",
    &[],
    |image, args| {
        let plan = Plan::of(image);
        let goals = plan.goals.borrow();
        let found = name_of(&args[0].car_or_nil())
            .and_then(|name| goals.get(&name))
            .and_then(|goals| {
                let pattern = args[0].cdr_or_nil();
                goals.iter().find(|g| equality::equal(&g.pattern, &pattern))
            });
        Ok(found.map_or(Value::NIL, |goal| goal.doc.clone()))
    },
)];

/// Builtins of package `PLAN-SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = &[
    pure(
        "DECLARE-GOAL",
        "name",
        "Forgets all goals of a name.",
        &[],
        |image, args| {
            let Some(name) = name_of(&args[0]) else {
                return Err(Raise::type_error(&args[0], known::SYMBOL));
            };
            Plan::of(image).goals.borrow_mut().insert(name, Vec::new());
            Ok(args[0].clone())
        },
    ),
    pure(
        "REGISTER-GOAL",
        "name pattern variables function doc",
        "Adds a goal; one with the same pattern is replaced.",
        &[],
        register,
    ),
    control(
        "CALL-GOAL",
        "name arguments",
        "Calls the first goal whose pattern matches.",
        &[],
        call_goal,
    ),
];

fn name_of(value: &Value) -> Option<Sym> {
    value.as_symbol()
}

fn register(image: &mut Image, args: &[Value]) -> Result<Value> {
    let Some(name) = name_of(&args[0]) else {
        return Err(Raise::type_error(&args[0], known::SYMBOL));
    };
    let goal = Goal {
        pattern: args[1].clone(),
        variables: args[2].iter_list().filter_map(|v| v.as_symbol()).collect(),
        function: args[3].clone(),
        doc: args[4].clone(),
    };
    let plan = Plan::of(image);
    let mut goals = plan.goals.borrow_mut();
    let goals = goals.entry(name).or_default();
    let same = goals
        .iter_mut()
        .find(|other| equality::equal(&other.pattern, &goal.pattern));
    match same {
        Some(other) => *other = goal,
        None => goals.push(goal),
    }
    Ok(args[0].clone())
}

fn call_goal(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step> {
    let plan = Plan::of(machine.image);
    let goals = plan.goals.borrow();
    let candidates = name_of(&args[0]).and_then(|name| goals.get(&name));
    for goal in candidates.into_iter().flatten() {
        if let Some(values) = matches(machine.image, goal, &args[1]) {
            return Ok(Step::TailCall {
                function: goal.function.clone(),
                args: values,
            });
        }
    }
    let shown = |v: &Value| print::to_string(machine.image, v, false);
    Err(Raise::simple(format!(
        "No goal found that matches arguments: {} {}",
        shown(&args[0]),
        shown(&args[1])
    )))
}

/// The values of the goal's variables if its pattern matches the arguments.
fn matches(image: &Image, goal: &Goal, args: &Value) -> Option<Vec<Value>> {
    let mut bindings: Vec<(Sym, Value)> = Vec::new();
    let mut pending = vec![(goal.pattern.clone(), args.clone())];
    while let Some((pattern, value)) = pending.pop() {
        match (&pattern, &value) {
            (Value::Symbol(sym), _) if is_variable(image, *sym) => {
                if image.name(*sym) == "?_" {
                    continue;
                }
                match bindings.iter().find(|(s, _)| s == sym) {
                    Some((_, bound)) if !equality::equal(bound, &value) => return None,
                    Some(_) => {}
                    None => bindings.push((*sym, value)),
                }
            }
            (Value::Cons(p), Value::Cons(v)) => {
                pending.push((p.cdr(), v.cdr()));
                pending.push((p.car(), v.car()));
            }
            _ if equality::equal(&pattern, &value) => {}
            _ => return None,
        }
    }
    let value_of = |sym: &Sym| {
        let found = bindings.iter().find(|(s, _)| s == sym);
        found.map_or(Value::NIL, |(_, value)| value.clone())
    };
    Some(goal.variables.iter().map(value_of).collect())
}

/// Is a symbol a variable of patterns: does its name begin with `?`?
pub(crate) fn is_variable(image: &Image, sym: Sym) -> bool {
    image.name(sym).starts_with('?')
}

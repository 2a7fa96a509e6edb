//! `reference` and `next-solution`: what a designator stands for.
//!
//! Rules defined by plans (`action-grounding`, `motion-grounding`) come first, then the schema. For
//! the sampling and validation of locations, see [`crate::designator::location`].

use super::failure;
use super::failure::Unresolved;
use super::ground;
use super::ground::Refusal;
use super::location;
use super::value;
use super::value::{Class, Designator};
use crate::prolog::builtins::solve;
use crate::prolog::engine::Engine;
use crate::prolog::facts;
use crate::{Result, packages};
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::print;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;
use lisp::value::symbol::Sym;
use lisp::vm::calls::{Calls, run};
use lisp::vm::machine::Machine;
use lisp::vm::step::Step;

/// Maximum number of groundings of one designator that are searched for.
const MAX_GROUNDINGS: usize = 64;

/// What the designator stands for: an action's plan with its arguments, a motion's command, a
/// location's pose, what is known of a perceived object.
///
/// `(desig:reference (desig:an action (type parking-arms)))` => `(CRAM-MOBILE-PICK-PLACE-PLANS::PARKING-ARMS)`
#[builtin("REFERENCE")]
fn reference_builtin(machine: &mut Machine<'_>, designator: Value) -> Result<Step> {
    run(machine, "REFERENCE", |calls| async move {
        reference(&calls, &designator).await
    })
}

/// A designator like this one with the next thing that it may stand for, equated; NIL if there is
/// none.
///
/// `(desig:next-solution (desig:an object))` => `NIL`
#[builtin("NEXT-SOLUTION")]
fn next_solution_builtin(machine: &mut Machine<'_>, designator: Value) -> Result<Step> {
    run(machine, "NEXT-SOLUTION", |calls| async move {
        next_solution(&calls, &designator).await
    })
}

/// Resolves a designator.
pub async fn reference(calls: &Calls, designator: &Value) -> Result<Value> {
    let subject = designator.clone();
    let known = calls.with(move |machine| {
        let found = value::designator(machine.image, &subject)?;
        let data = found.data.borrow().clone();
        Ok::<_, Box<Raise>>((found.class, data))
    });
    let (class, data) = known.await?;
    if let Some(data) = data {
        return Ok(data);
    }
    match class {
        Class::Location => location::reference(calls, designator).await,
        Class::Action | Class::Motion => {
            let found = groundings(calls, designator, 1).await?;
            let subject = designator.clone();
            calls
                .with(move |machine| resolved(machine.image, &subject, &found))
                .await
        }
        Class::Object | Class::Human => {
            let subject = designator.clone();
            let error = calls.with(move |machine| unknown(machine.image, &subject, class));
            Err(error.await)
        }
    }
}

/// The error for an object or a person about which nothing is known.
fn unknown(image: &mut Image, designator: &Value, class: Class) -> Box<Raise> {
    let shown = print::to_string(image, designator, false);
    let (kind, why) = match class {
        Class::Human => ("human", ""),
        _ => ("object", "It must be detected first."),
    };
    let text = format!("Designator `{shown}' does not reference an {kind}.");
    failure::designator_error(image, designator, &text, &Unresolved::new(why))
}

/// The list of the first groundings that rules give for an action or a motion. Of those after them nothing is
/// known: they are not searched for.
pub(crate) async fn groundings(calls: &Calls, designator: &Value, most: usize) -> Result<Value> {
    let is_action = value::as_class(designator, Class::Action).is_some();
    let name = if is_action {
        "ACTION-GROUNDING"
    } else {
        "MOTION-GROUNDING"
    };
    let functor = calls
        .with(|machine| packages::symbol(machine.image, "CRAM-DESIGNATORS", name))
        .await;
    some_solutions_of(calls, functor, None, designator, most).await
}

/// The list of values given by rules `(functor designator ?value)`, restricted to those for which
/// `(condition ?value)` holds if there are rules about the condition.
pub(crate) async fn solutions_of(
    calls: &Calls,
    functor: Sym,
    condition: Option<Sym>,
    designator: &Value,
) -> Result<Value> {
    some_solutions_of(calls, functor, condition, designator, MAX_GROUNDINGS).await
}

/// The list of the first of these values.
async fn some_solutions_of(
    calls: &Calls,
    functor: Sym,
    condition: Option<Sym>,
    designator: &Value,
    most: usize,
) -> Result<Value> {
    let subject = designator.clone();
    let query = calls.with(move |machine| query(machine.image, functor, condition, subject));
    let Some((engine, variable)) = query.await? else {
        return Ok(Value::NIL);
    };
    let solutions = solve(calls, engine, most).await?;
    let values: Vec<Value> = solutions
        .iter_list()
        .filter_map(|bindings| {
            bindings
                .iter_list()
                .find(|pair| pair.car_or_nil().as_symbol() == Some(variable))
                .map(|pair| pair.cdr_or_nil())
        })
        .collect();
    Ok(Value::list(values))
}

/// The query for those values, and its variable; `None` if there are no rules about the functor.
fn query(
    image: &mut Image,
    functor: Sym,
    condition: Option<Sym>,
    designator: Value,
) -> Result<Option<(Engine, Sym)>> {
    if !facts::of(image).knows(functor) {
        return Ok(None);
    }
    let id = packages::ensure(image, "CRAM-DESIGNATORS", &["DESIG"]);
    let variable = image.intern(id, "?GROUNDING");
    let mut query = Value::list([functor.into(), designator, variable.into()]);
    if let Some(condition) = condition.filter(|c| facts::of(image).knows(*c)) {
        let condition = Value::list([condition.into(), variable.into()]);
        query = Value::list([known::AND.into(), query, condition]);
    }
    Ok(Some((Engine::new(image, &query)?, variable)))
}

/// The first grounding by rules, or else the one by the schema.
fn resolved(image: &mut Image, designator: &Value, found: &Value) -> Result<Value> {
    let target = value::designator(image, designator)?;
    if let Value::Cons(cons) = found {
        value::note_changed(designator);
        *target.data.borrow_mut() = Some(cons.car());
        *target.solutions.borrow_mut() = Some(Value::Int(1));
        return Ok(cons.car());
    }
    match ground::ground(image, target) {
        Ok(grounding) if target.class == Class::Action => {
            let (plan, args) = ground::plan_call(image, &grounding);
            Ok(Value::list_with_tail([plan], Value::list(args)))
        }
        Ok(grounding) => {
            let command = image.keyword(&grounding.row.name);
            let values: Vec<Value> = grounding.properties.into_iter().map(|(_, v)| v).collect();
            Ok(Value::list_with_tail([command.into()], Value::list(values)))
        }
        Err(Refusal::Error(raise)) => Err(raise),
        Err(Refusal::UnknownType(why) | Refusal::Incomplete(why)) => {
            Err(unresolved(image, designator, target, &why))
        }
    }
}

fn unresolved(
    image: &mut Image,
    designator: &Value,
    target: &Designator,
    why: &Unresolved,
) -> Box<Raise> {
    let kind = target.class.name().to_lowercase();
    let shown = print::to_string(image, designator, false);
    let text = format!("Cannot resolve {kind} designator {shown}.");
    failure::designator_error(image, designator, &text, why)
}

/// A designator for the next solution of a designator; `NIL` if there is none.
async fn next_solution(calls: &Calls, designator: &Value) -> Result<Value> {
    let subject = designator.clone();
    let class =
        calls.with(move |machine| value::designator(machine.image, &subject).map(|d| d.class));
    match class.await? {
        Class::Location => location::next_solution(calls, designator).await,
        Class::Object | Class::Human => Ok(Value::NIL),
        Class::Action | Class::Motion => {
            reference(calls, designator).await?;
            let taken = value::as_designator(designator).and_then(taken);
            let found = match taken {
                Some(taken) if taken < MAX_GROUNDINGS => {
                    groundings(calls, designator, taken + 1).await?
                }
                _ => Value::NIL,
            };
            let next = found.iter_list().nth(taken.unwrap_or(0));
            let subject = designator.clone();
            calls
                .with(move |machine| next_grounding(machine.image, &subject, next))
                .await
        }
    }
}

/// How many groundings have been used up to a designator; `None` if it has none, or has a successor already.
fn taken(target: &Designator) -> Option<usize> {
    if target.successor.borrow().is_some() {
        return None;
    }
    match &*target.solutions.borrow() {
        Some(Value::Int(taken)) => usize::try_from(*taken).ok(),
        _ => None,
    }
}

/// The designator for the next solution of an action or a motion.
fn next_grounding(image: &mut Image, designator: &Value, next: Option<Value>) -> Result<Value> {
    let target = value::designator(image, designator)?;
    if let Some(next) = target.successor.borrow().clone() {
        return Ok(next);
    }
    let Some(next) = next else {
        return Ok(Value::NIL);
    };
    let taken = taken(target).unwrap_or(0) + 1;
    let other = same_description(image, target);
    value::equate(designator, &other);
    if let Some(new) = value::as_designator(&other) {
        value::note_changed(&other);
        *new.data.borrow_mut() = Some(next);
        let taken = i64::try_from(taken).unwrap_or(i64::MAX);
        *new.solutions.borrow_mut() = Some(Value::Int(taken));
    }
    Ok(other)
}

/// A designator with the same description.
pub(crate) fn same_description(image: &mut Image, target: &Designator) -> Value {
    let description = target.description.borrow().clone();
    let new = Designator::new(image, target.class, target.quantifier, description);
    Value::foreign(new)
}

/// Like REFERENCE; a plan failure if the designator stands for nothing.
// `reference` with plan failures instead of designator errors.
#[builtin("TRY-REFERENCE-DESIGNATOR", "designator &optional message")]
fn try_reference(
    machine: &mut Machine<'_>,
    designator: Value,
    message_value: Option<&Value>,
) -> Result<Step> {
    let message = message_value.and_then(Value::as_text).unwrap_or_default();
    let class = value::designator(machine.image, &designator)?.class;
    run(machine, "REFERENCE", |calls| async move {
        // The search for a location signals the same failure itself.
        if class == Class::Location {
            return location::try_reference(&calls, &designator, message).await;
        }
        match reference(&calls, &designator).await {
            Ok(value) => Ok(value),
            Err(raise) => {
                let failure = calls
                    .with(move |machine| as_failure(machine.image, &designator, raise, &message));
                Err(failure.await)
            }
        }
    })
}

/// Converts a designator error to a plan failure; returns other errors unchanged.
pub(crate) fn as_failure(
    image: &mut Image,
    designator: &Value,
    raise: Box<Raise>,
    message: &str,
) -> Box<Raise> {
    let error = packages::symbol(image, "CRAM-DESIGNATORS", "DESIGNATOR-ERROR");
    match raise.as_ref() {
        Raise::Make { class, .. } if *class == error => {
            let why = Unresolved::new(message);
            failure::reference_failure(image, designator, &why)
        }
        _ => raise,
    }
}

/// Functions of package `CRAM-DESIGNATORS`.
pub(crate) static TABLE: &[Builtin] = builtins![reference_builtin, next_solution_builtin,];

/// Functions of package `CRAM-EXECUTIVE`.
pub(crate) static EXECUTIVE_TABLE: &[Builtin] = builtins![try_reference,];

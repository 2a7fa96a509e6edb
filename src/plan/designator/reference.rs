//! `reference` and `next-solution`: what a designator stands for.
//!
//! Rules of plans (`action-grounding`, `motion-grounding`) come first, then the schema.
//! Locations are sampled and validated, see [`crate::plan::designator::location`].

use super::continuation::{Next, Result, done};
use super::failure;
use super::failure::Unresolved;
use super::ground;
use super::ground::Refusal;
use super::location;
use super::value;
use super::value::{Class, Designator};
use crate::lisp::builtin::{Builtin, control};
use crate::lisp::image::Image;
use crate::lisp::print;
use crate::lisp::value::Value;
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;
use crate::lisp::value::symbol::Sym;
use crate::lisp::vm::machine::Machine;
use crate::lisp::vm::step::Step;
use crate::plan::packages;
use crate::plan::prolog::builtins::solve;
use crate::plan::prolog::engine::Engine;
use crate::plan::prolog::facts;

/// Groundings of one designator that are looked for.
const MOST_GROUNDINGS: usize = 64;

/// Functions of package `CRAM-DESIGNATORS`.
pub(crate) static TABLE: &[Builtin] = &[
    control(
        "REFERENCE",
        "designator",
        "What the designator stands for: an action's plan with its arguments, a motion's command, a location's pose, what is known of a perceived object.",
        &[
            "(desig:reference (desig:an action (type parking-arms))) => (CRAM-MOBILE-PICK-PLACE-PLANS::PARKING-ARMS)",
        ],
        |machine, args| reference(machine, &args[0], done()),
    ),
    control(
        "NEXT-SOLUTION",
        "designator",
        "A designator like this one with the next thing that it may stand for, equated; NIL if there is none.",
        &["(desig:next-solution (desig:an object)) => NIL"],
        |machine, args| next_solution(machine, &args[0]),
    ),
];

/// Functions of package `CRAM-EXECUTIVE`.
pub(crate) static EXECUTIVE_TABLE: &[Builtin] = &[control(
    "TRY-REFERENCE-DESIGNATOR",
    "designator &optional message",
    "Like REFERENCE; a plan failure if the designator stands for nothing.",
    &[],
    try_reference,
)];

/// Resolves a designator and goes on with what it stands for.
pub(crate) fn reference(machine: &mut Machine<'_>, designator: &Value, next: Next) -> Result<Step> {
    let found = value::designator(machine.image, designator)?;
    if let Some(data) = found.data.borrow().clone() {
        return next(machine, data);
    }
    let image = &mut *machine.image;
    let shown = || print::to_string(image, designator, false);
    let (text, why) = match found.class {
        Class::Location => return location::reference(machine, designator, next),
        Class::Action | Class::Motion => {
            let designator = designator.clone();
            return groundings(
                machine,
                &designator.clone(),
                Box::new(move |machine, found| resolved(machine, &designator, &found, next)),
            );
        }
        Class::Object => (
            format!("Designator `{}' does not reference an object.", shown()),
            "It must be detected first.",
        ),
        Class::Human => (
            format!("Designator `{}' does not reference an human.", shown()),
            "",
        ),
    };
    let why = Unresolved::new(why);
    Err(failure::designator_error(image, designator, &text, &why))
}

/// Goes on with the list of groundings that rules of plans give an action or a motion.
pub(crate) fn groundings(
    machine: &mut Machine<'_>,
    designator: &Value,
    next: Next,
) -> Result<Step> {
    let is_action = value::as_class(designator, Class::Action).is_some();
    let name = if is_action {
        "ACTION-GROUNDING"
    } else {
        "MOTION-GROUNDING"
    };
    let functor = packages::symbol(machine.image, "CRAM-DESIGNATORS", name);
    solutions_of(machine, functor, None, designator, next)
}

/// Goes on with the list of values that rules `(functor designator ?value)` give, and of
/// which `(condition ?value)` holds if rules speak of that.
pub(crate) fn solutions_of(
    machine: &mut Machine<'_>,
    functor: Sym,
    condition: Option<Sym>,
    designator: &Value,
    next: Next,
) -> Result<Step> {
    let image = &mut *machine.image;
    if !facts::of(image).knows(functor) {
        return next(machine, Value::NIL);
    }
    let id = packages::ensure(image, "CRAM-DESIGNATORS", &["DESIG"]);
    let variable = image.intern(id, "?GROUNDING");
    let mut query = Value::list([functor.into(), designator.clone(), variable.into()]);
    if let Some(condition) = condition.filter(|c| facts::of(image).knows(*c)) {
        let condition = Value::list([condition.into(), variable.into()]);
        query = Value::list([known::AND.into(), query, condition]);
    }
    let engine = Engine::new(image, &query)?;
    let finish = Box::new(move |machine: &mut Machine<'_>, solutions: Value| {
        let values: Vec<Value> = solutions
            .iter_list()
            .filter_map(|bindings| {
                bindings
                    .iter_list()
                    .find(|pair| pair.car_or_nil().as_symbol() == Some(variable))
                    .map(|pair| pair.cdr_or_nil())
            })
            .collect();
        next(machine, Value::list(values))
    });
    solve(engine, MOST_GROUNDINGS, finish).go_on(machine)
}

/// The first grounding by rules, or what the schema says.
fn resolved(
    machine: &mut Machine<'_>,
    designator: &Value,
    found: &Value,
    next: Next,
) -> Result<Step> {
    let target = value::designator(machine.image, designator)?;
    if let Value::Cons(cons) = found {
        *target.data.borrow_mut() = Some(cons.car());
        *target.solutions.borrow_mut() = Some(cons.cdr());
        return next(machine, cons.car());
    }
    let command = match ground::ground(machine.image, target) {
        Ok(grounding) if target.class == Class::Action => {
            let (plan, args) = ground::plan_call(machine.image, &grounding);
            Value::list_with_tail([plan], Value::list(args))
        }
        Ok(grounding) => {
            let command = machine.image.keyword(grounding.row.name);
            let values: Vec<Value> = grounding.properties.into_iter().map(|(_, v)| v).collect();
            Value::list_with_tail([command.into()], Value::list(values))
        }
        Err(Refusal::Error(raise)) => return Err(raise),
        Err(Refusal::UnknownType(why) | Refusal::Incomplete(why)) => {
            return Err(unresolved(machine.image, designator, target, &why));
        }
    };
    next(machine, command)
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

fn next_solution(machine: &mut Machine<'_>, designator: &Value) -> Result<Step> {
    let target = value::designator(machine.image, designator)?;
    match target.class {
        Class::Location => location::next_solution(machine, designator),
        Class::Object | Class::Human => Ok(Step::Return(Value::NIL)),
        Class::Action | Class::Motion => {
            let designator = designator.clone();
            reference(
                machine,
                &designator.clone(),
                Box::new(move |machine, _| {
                    let target = value::designator(machine.image, &designator)?;
                    if let Some(next) = target.successor.borrow().clone() {
                        return Ok(Step::Return(next));
                    }
                    let rest = target.solutions.borrow().clone().unwrap_or(Value::NIL);
                    let Value::Cons(rest) = rest else {
                        return Ok(Step::Return(Value::NIL));
                    };
                    let other = same_description(machine.image, target);
                    value::equate(&designator, &other);
                    if let Some(new) = value::as_designator(&other) {
                        *new.data.borrow_mut() = Some(rest.car());
                        *new.solutions.borrow_mut() = Some(rest.cdr());
                    }
                    Ok(Step::Return(other))
                }),
            )
        }
    }
}

/// A designator with the same description.
pub(crate) fn same_description(image: &mut Image, target: &Designator) -> Value {
    let description = target.description.borrow().clone();
    let new = Designator::new(image, target.class, target.quantifier, description);
    Value::foreign(new)
}

/// `reference` with plan failures in place of errors of designators.
fn try_reference(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step> {
    let designator = args[0].clone();
    let message = args.get(1).and_then(Value::as_text).unwrap_or_default();
    let target = value::designator(machine.image, &designator)?;
    // Locations end their search in the same failure.
    let class = target.class;
    if class == Class::Location {
        return location::try_reference(machine, &designator, message, done());
    }
    match reference(machine, &designator, done()) {
        Ok(step) => Ok(step),
        Err(raise) => Err(as_failure(machine.image, &designator, raise, &message)),
    }
}

/// An error of a designator as a plan failure; other errors as they are.
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

//! `perform`: an action calls its plan, a motion becomes a request to whoever runs the plan.

use super::continuation::{Next, Result, call, call_for, done};
use super::failure;
use super::failure::Unresolved;
use super::ground;
use super::ground::Refusal;
use super::location;
use super::reference::{groundings, solutions_of};
use super::request::MotionRequest;
use super::value;
use super::value::{Class, Designator};
use crate::lisp::builtin::{Builtin, control};
use crate::lisp::image::Image;
use crate::lisp::print;
use crate::lisp::value::Value;
use crate::lisp::value::function::Body;
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;
use crate::lisp::value::symbol::FunctionCell;
use crate::lisp::vm::machine::Machine;
use crate::lisp::vm::step::Step;
use crate::plan::packages;

/// Functions of package `CRAM-EXECUTIVE`.
pub(crate) static TABLE: &[Builtin] = &[control(
    "PERFORM",
    "designator",
    "Carries out an action or motion; only inside a plan, as in (with-simulated-robot (perform (an action (type going) (target ?location)))).",
    &[],
    |machine, args| perform(machine, &args[0]),
)];

/// Is a plan running: is this fiber a task?
fn is_in_plan(image: &mut Image) -> bool {
    let task = packages::symbol(image, "CRAM-LANGUAGE-IMPLEMENTATION", "*CURRENT-TASK*");
    let value = image.special(task);
    !value.is_unbound() && value.is_true()
}

fn perform(machine: &mut Machine<'_>, argument: &Value) -> Result<Step> {
    let image = &mut *machine.image;
    let class = match value::as_designator(argument) {
        Some(d) if matches!(d.class, Class::Action | Class::Motion) => d.class,
        _ => return Err(not_performable(image, argument)),
    };
    if !is_in_plan(image) {
        let expected = packages::symbol(image, "CRAM-LANGUAGE-IMPLEMENTATION", "TASK-TREE-NODE");
        let text = "There is no plan for PERFORM to be a part of: \
                    write it inside (with-simulated-robot …).";
        return Err(Raise::new(known::SIMPLE_TYPE_ERROR, text)
            .with(known::K_DATUM, Value::NIL)
            .with(known::K_EXPECTED_TYPE, expected.into()));
    }
    match class {
        Class::Action => perform_action(machine, argument),
        _ => perform_motion(machine, argument),
    }
}

fn not_performable(image: &mut Image, argument: &Value) -> Box<Raise> {
    let shown = print::to_string(image, argument, true);
    let generic = packages::symbol(image, "CRAM-EXECUTIVE", "GENERIC-PERFORM");
    let text = format!(
        "There is no applicable method for the generic function {} when called with arguments ({shown}): an action or a motion was expected.",
        print::to_string(image, &generic.into(), true)
    );
    let k_arguments = image.keyword("ARGUMENTS");
    Raise::new(known::NO_APPLICABLE_METHOD_ERROR, text)
        .with(k_arguments, Value::list([argument.clone()]))
}

/// With a goal: nothing if it holds already, and a failure if it does not hold afterwards.
fn perform_action(machine: &mut Machine<'_>, designator: &Value) -> Result<Step> {
    let image = &mut *machine.image;
    let goal = crate::plan::designator::property(image, designator, "GOAL");
    let holds = packages::symbol(image, "CRAM-OCCASIONS-EVENTS", "HOLDS");
    let goal = goal.filter(|_| image.function(holds).is_some());
    let Some(goal) = goal else {
        return run_action(machine, designator, done());
    };
    let designator = designator.clone();
    let question = vec![goal.clone()];
    Ok(call(
        holds.into(),
        question.clone(),
        "PERFORM",
        Box::new(move |machine, holding| {
            let shown = print::to_string(machine.image, &goal, true);
            if holding.is_true() {
                let output = &mut machine.image.output;
                output.fresh_line();
                output.write(&format!(
                    "WARNING: Action goal `{shown}' already achieved.\n"
                ));
                return Ok(Step::Return(Value::NIL));
            }
            let action = designator.clone();
            let after: Next = Box::new(move |_, _| {
                Ok(call(
                    holds.into(),
                    question,
                    "PERFORM",
                    Box::new(move |machine, holding| {
                        if holding.is_true() {
                            return Ok(Step::Return(Value::NIL));
                        }
                        let action = print::to_string(machine.image, &action, false);
                        Err(failure::simple_failure(
                            machine.image,
                            format!("Goal `{shown}' of action `{action}' was not achieved."),
                        ))
                    }),
                ))
            });
            run_action(machine, &designator, after)
        }),
    ))
}

/// Resolves an action and calls its plan.
fn run_action(machine: &mut Machine<'_>, designator: &Value, next: Next) -> Result<Step> {
    let designator = designator.clone();
    let target = value::designator(machine.image, &designator)?;
    let known = target.data.borrow().clone();
    if let Some(Value::Cons(command)) = known {
        return run_command(machine, &designator, command.car(), command.cdr(), next);
    }
    groundings(
        machine,
        &designator.clone(),
        Box::new(move |machine, found| {
            let target = value::designator(machine.image, &designator)?;
            if let Value::Cons(cons) = &found {
                *target.data.borrow_mut() = Some(cons.car());
                *target.solutions.borrow_mut() = Some(cons.cdr());
                let command = cons.car();
                let (plan, args) = (command.car_or_nil(), command.cdr_or_nil());
                return run_command(machine, &designator, plan, args, next);
            }
            match ground::ground(machine.image, target) {
                Ok(grounding) => {
                    let (plan, args) = ground::plan_call(machine.image, &grounding);
                    call_plan(machine, &designator, plan, args, next)
                }
                Err(refusal) => {
                    let why = refusal.reason()?;
                    Err(failure::reference_failure(machine.image, &designator, &why))
                }
            }
        }),
    )
}

/// Calls what a rule says: `(plan argument…)`. A plan that takes keywords and is given
/// nothing but an action gets that action's properties.
fn run_command(
    machine: &mut Machine<'_>,
    designator: &Value,
    plan: Value,
    args: Value,
    next: Next,
) -> Result<Step> {
    let args: Vec<Value> = args.iter_list().collect();
    if let [only] = args.as_slice()
        && let Some(action) = value::as_class(only, Class::Action)
        && takes_keywords(machine.image, &plan)
    {
        let mut keywords = Vec::new();
        for (key, values) in action.properties() {
            keywords.push(key);
            keywords.push(values.car_or_nil());
        }
        return call_plan(machine, designator, plan, keywords, next);
    }
    call_plan(machine, designator, plan, args, next)
}

/// Does the function take keyword arguments and nothing else?
fn takes_keywords(image: &Image, plan: &Value) -> bool {
    let Ok(function) = image.coerce_to_function(plan) else {
        return false;
    };
    match &function.body {
        Body::Closure { code, .. } => {
            let p = &code.parameters;
            p.required == 0 && p.optional == 0 && (p.allow_other_keys || !p.keys.is_empty())
        }
        _ => false,
    }
}

/// Calls the function of a plan.
fn call_plan(
    machine: &mut Machine<'_>,
    designator: &Value,
    plan: Value,
    args: Vec<Value>,
    next: Next,
) -> Result<Step> {
    let image = &mut *machine.image;
    if let Some(name) = plan.as_symbol()
        && !matches!(image.symbol(name).function, FunctionCell::Function(_))
    {
        let shown = print::to_string(image, designator, false);
        let name = image.name(name).to_owned();
        return Err(failure::simple_failure(
            image,
            format!(
                "Action designator `{shown}' resolved to cram function `{name}', but it isn't defined. Cannot perform action."
            ),
        ));
    }
    let action = (designator.clone(), image.motions);
    Ok(call_for(action, plan, args, next))
}

/// A process module of the plan's own, or a request to whoever runs the plan.
fn perform_motion(machine: &mut Machine<'_>, designator: &Value) -> Result<Step> {
    let motion = designator.clone();
    let symbol = |image: &mut Image, name| packages::symbol(image, "CRAM-PROCESS-MODULES", name);
    let matching = symbol(machine.image, "MATCHING-PROCESS-MODULE");
    let available = symbol(machine.image, "AVAILABLE-PROCESS-MODULE");
    let execute = symbol(machine.image, "PM-EXECUTE");
    solutions_of(
        machine,
        matching,
        Some(available),
        designator,
        Box::new(move |machine, modules| {
            let module = modules.iter_list().find(|module| {
                let name = module.as_symbol();
                name.is_some_and(|s| machine.image.function(s).is_some())
            });
            match module {
                Some(module) => {
                    let args = vec![module, motion];
                    Ok(call(execute.into(), args, "PERFORM", done()))
                }
                None => request_motion(machine, &motion),
            }
        }),
    )
}

fn request_motion(machine: &mut Machine<'_>, designator: &Value) -> Result<Step> {
    let image = &mut *machine.image;
    let motion = value::designator(image, designator)?;
    let grounding = match ground::ground(image, motion) {
        Ok(grounding) => grounding,
        Err(Refusal::Error(raise)) => return Err(raise),
        Err(Refusal::UnknownType(why)) => return Err(no_module(image, designator, &why)),
        Err(Refusal::Incomplete(why)) => {
            // Modules of the grippers accept only motions that name a gripper.
            if matches!(
                motion.type_name(image).as_deref(),
                Some("OPENING" | "CLOSING")
            ) {
                return Err(no_module(image, designator, &why));
            }
            let why = Unresolved {
                reason: format!("Cannot perform motion.\n{}", why.reason),
                ..why
            };
            return Err(failure::reference_failure(image, designator, &why));
        }
    };
    let request = MotionRequest {
        designator: designator.clone(),
        motion_type: grounding.row.name.to_owned(),
        properties: grounding.properties,
    };
    resolve_places(machine, request, 0)
}

fn no_module(image: &mut Image, designator: &Value, why: &Unresolved) -> Box<Raise> {
    let shown = print::to_string(image, designator, false);
    failure::no_process_module(image, &format!("{shown}\n{}", why.reason))
}

/// Puts poses in place of locations that must be searched for, then makes the request.
fn resolve_places(
    machine: &mut Machine<'_>,
    mut request: MotionRequest,
    index: usize,
) -> Result<Step> {
    let Some((_, place)) = request.properties.get(index).cloned() else {
        return Ok(Step::Request(Box::new(request)));
    };
    let is_symbolic = value::as_class(&place, Class::Location)
        .is_some_and(|location| location.property_named(machine.image, "POSE").is_none());
    if !is_symbolic {
        return resolve_places(machine, request, index + 1);
    }
    let message = "The location is not known.".to_owned();
    location::try_reference(
        machine,
        &place.clone(),
        message,
        Box::new(move |machine, pose| {
            let found = value::make(machine.image, Class::Location, &[("POSE", pose)]);
            if let Some(property) = request.properties.get_mut(index) {
                property.1 = found.clone();
            }
            if let Some(motion) = value::as_designator(&request.designator) {
                request.designator = with_place(machine.image, motion, &place, &found);
            }
            resolve_places(machine, request, index + 1)
        }),
    )
}

/// The motion with another location in place of one.
fn with_place(image: &mut Image, motion: &Designator, old: &Value, new: &Value) -> Value {
    let properties: Vec<Value> = motion
        .properties()
        .into_iter()
        .map(|(key, values)| match values.car_or_nil().is_eq(old) {
            true => Value::list([key, new.clone()]),
            false => Value::cons(key, values),
        })
        .collect();
    let description = Value::list(properties);
    let resolved = Designator::new(image, motion.class, motion.quantifier, description);
    Value::foreign(resolved)
}

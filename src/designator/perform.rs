//! `perform`: an action calls its plan, a motion becomes a request to whoever runs the plan.

use super::failure::{self, Unresolved};
use super::ground::{self, Refusal};
use super::packages;
use super::request::MotionRequest;
use super::value::{self, Class, Designator};
use crate::lisp::builtin::{Builtin, control};
use crate::lisp::image::Image;
use crate::lisp::known;
use crate::lisp::print;
use crate::lisp::raise::Raise;
use crate::lisp::symbol::FunctionCell;
use crate::lisp::value::Value;
use crate::lisp::vm::machine::Machine;
use crate::lisp::vm::step::Step;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Functions of package `CRAM-EXECUTIVE`.
pub static TABLE: &[Builtin] = &[control(
    "PERFORM",
    "designator",
    "Carries out an action or motion; only inside a plan, as in (with-simulated-robot (perform (an action (type going) (target ?location)))).",
    &[],
    perform,
)];

/// Is a plan running: is this fiber a task?
fn is_in_plan(image: &mut Image) -> bool {
    let task = packages::symbol(image, "CRAM-LANGUAGE-IMPLEMENTATION", "*CURRENT-TASK*");
    let value = image.special(task);
    !value.is_unbound() && value.is_true()
}

fn perform(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step> {
    let image = &mut *machine.image;
    let designator = match value::as_designator(&args[0]) {
        Some(d) if matches!(d.class, Class::Action | Class::Motion) => d,
        _ => return Err(not_performable(image, &args[0])),
    };
    if !is_in_plan(image) {
        let expected = packages::symbol(image, "CRAM-LANGUAGE-IMPLEMENTATION", "TASK-TREE-NODE");
        let text = "There is no plan for PERFORM to be a part of: \
                    write it inside (with-simulated-robot …).";
        return Err(Raise::new(known::SIMPLE_TYPE_ERROR, text)
            .with(known::K_DATUM, Value::NIL)
            .with(known::K_EXPECTED_TYPE, expected.into()));
    }
    match designator.class {
        Class::Action => perform_action(machine, &args[0], designator),
        _ => perform_motion(machine, &args[0], designator),
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

fn perform_action(
    machine: &mut Machine<'_>,
    designator: &Value,
    action: &Designator,
) -> Result<Step> {
    let grounding = match ground::ground(machine.image, action) {
        Ok(grounding) => grounding,
        Err(refusal) => {
            let why = refusal.reason()?;
            return Err(failure::reference_failure(machine.image, designator, &why));
        }
    };
    let (plan, args) = ground::plan_call(machine.image, &grounding);
    call_plan(machine, designator, plan, args)
}

/// Calls the function of a plan.
fn call_plan(
    machine: &mut Machine<'_>,
    designator: &Value,
    plan: Value,
    args: Vec<Value>,
) -> Result<Step> {
    if let Some(name) = plan.as_symbol()
        && !matches!(
            machine.image.symbol(name).function,
            FunctionCell::Function(_)
        )
    {
        let shown = print::to_string(machine.image, designator, false);
        let name = machine.image.name(name).to_owned();
        return Err(failure::simple_failure(
            machine.image,
            format!(
                "Action designator `{shown}' resolved to cram function `{name}', but it isn't defined. Cannot perform action."
            ),
        ));
    }
    Ok(Step::TailCall {
        function: plan,
        args,
    })
}

fn perform_motion(
    machine: &mut Machine<'_>,
    designator: &Value,
    motion: &Designator,
) -> Result<Step> {
    let image = &mut *machine.image;
    let grounding = match ground::ground(image, motion) {
        Ok(grounding) => grounding,
        Err(Refusal::Error(raise)) => return Err(raise),
        Err(Refusal::UnknownType(why)) => {
            let shown = print::to_string(image, designator, false);
            let shown = format!("{shown}\n{}", why.reason);
            return Err(failure::no_process_module(image, &shown));
        }
        Err(Refusal::Incomplete(why)) => {
            let why = Unresolved {
                reason: format!("Cannot perform motion.\n{}", why.reason),
                ..why
            };
            return Err(failure::reference_failure(image, designator, &why));
        }
    };
    Ok(Step::Request(Box::new(MotionRequest {
        designator: designator.clone(),
        motion_type: grounding.row.name.to_owned(),
        properties: grounding.properties,
    })))
}

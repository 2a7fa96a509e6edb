//! Signalling failures.

use crate::Result;
use crate::state::Plan;
use lisp::builtin::Builtin;
use lisp::builtins::signalling;
use lisp::condition;
use lisp::evaluator::signal::Declined;
use lisp::image::Image;
use lisp::print;
use lisp::typed::{self, builtin, builtins};
use lisp::types::parse::near_type;
use lisp::value::Value;
use lisp::value::class::ClassKind;
use lisp::value::known;
use lisp::value::raise::Raise;
use lisp::vm::machine::Machine;
use lisp::vm::step::Step;

/// Fails: with a text and its arguments, with the name of a condition class and initargs, with a
/// condition object, or just so.
///
/// `(cpl:with-failure-handling ((cpl:plan-failure (e) (return (princ-to-string e)))) (cpl:fail "no ~a" 'cup))` => `"no CUP"`
#[builtin]
fn fail(machine: &mut Machine<'_>, failure: Vec<Value>) -> Result<Step> {
    let plan = Plan::of(machine.image);
    let simple = plan.names.simple_plan_failure;
    let condition = match failure.first() {
        None => {
            let initargs = [known::K_FORMAT_CONTROL.into(), "Plan failure.".into()];
            condition::make_condition(machine.image, simple, &initargs)?
        }
        Some(Value::Str(_)) => {
            let initargs = [
                known::K_FORMAT_CONTROL.into(),
                failure[0].clone(),
                known::K_FORMAT_ARGUMENTS.into(),
                Value::list(failure[1..].iter().cloned()),
            ];
            condition::make_condition(machine.image, simple, &initargs)?
        }
        Some(Value::Symbol(class, ..)) => {
            let is_condition = machine
                .image
                .class(*class)
                .is_some_and(|c| c.kind == ClassKind::Condition);
            if !is_condition {
                return Err(no_condition_class(machine.image, &failure[0]));
            }
            let draft = condition::draft(machine.image, *class, &failure[1..])?;
            if !draft.pending.is_empty() {
                // An initial value must be computed.
                return signalling::signal_with(machine, failure, simple, Declined::Stop);
            }
            Value::Instance(draft.condition)
        }
        Some(Value::Instance(instance)) if instance.is_a(known::CONDITION) => {
            if failure.len() > 1 {
                return Err(Raise::simple(
                    "The assertion (NULL CRAM-LANGUAGE-IMPLEMENTATION::ARGUMENTS) failed: a condition object takes no arguments.",
                ));
            }
            failure[0].clone()
        }
        Some(Value::Class(class)) => {
            let mut failure = failure.clone();
            failure[0] = class.name.into();
            return fail(machine, failure);
        }
        Some(other) => return Err(no_failure(machine.image, other)),
    };
    let place = machine.place();
    machine.note_place(&condition, place);
    let breaks = machine.image.special(plan.names.break_on_failures).clone();
    let at_prompt = machine.image.special(plan.names.current_task).is_nil();
    if breaks.is_true()
        && at_prompt
        && lisp::evaluator::matching::is_of_type(machine.image, &condition, &breaks)?
    {
        return Ok(Step::Unhandled(condition));
    }
    machine.signal(condition, Declined::Stop)
}

fn no_condition_class(image: &Image, name: &Value) -> Box<Raise> {
    let shown = |value: &Value| print::to_string(image, value, true);
    let mut text = format!("{} does not designate a condition class", shown(name));
    match name.as_symbol().and_then(|name| near_type(image, name)) {
        Some(near) => text.push_str(&format!("; did you mean {}?", shown(&near.into()))),
        None => text.push('.'),
    }
    Raise::new(known::SIMPLE_TYPE_ERROR, text)
        .with(known::K_DATUM, name.clone())
        .with(known::K_EXPECTED_TYPE, known::CONDITION.into())
}

fn no_failure(image: &Image, value: &Value) -> Box<Raise> {
    let shown = print::to_string(image, value, true);
    let wanted = [known::CONDITION, known::SYMBOL, known::STRING].map(Value::from);
    let expected = Value::cons(known::OR.into(), Value::list(wanted));
    Raise::new(
        known::CASE_FAILURE,
        format!(
            "{shown} fell through ETYPECASE expression.\nWanted one of (CONDITION SYMBOL STRING)."
        ),
    )
    .with(known::K_DATUM, value.clone())
    .with(known::K_EXPECTED_TYPE, expected)
}

/// The builtins.
pub(crate) static TABLE: &[Builtin] = builtins![fail,];

//! Signalling conditions, and throwing.

use crate::builtin::Builtin;
use crate::evaluator::signal::Declined;
use crate::image::Image;
use crate::print;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;
use crate::vm::calls::{Args, Calls, run};
use crate::vm::machine::Machine;
use crate::vm::step::Step;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Signals a condition; NIL if every handler declines.
///
/// `(signal "nothing happens")` => `NIL`
#[builtin(_, "datum &rest arguments")]
fn signal(machine: &mut Machine<'_>, arguments: Vec<Value>) -> Result<Step> {
    signal_with(
        machine,
        arguments,
        known::SIMPLE_CONDITION,
        Declined::Return,
    )
}

/// Signals an error: a condition object, the name of a class with initargs, or a format control
/// with arguments.
///
/// `(handler-case (error "no ~a" 1) (error (e) (princ-to-string e)))` => `"no 1"`
#[builtin(_, "datum &rest arguments")]
fn error(machine: &mut Machine<'_>, arguments: Vec<Value>) -> Result<Step> {
    signal_with(machine, arguments, known::SIMPLE_ERROR, Declined::Stop)
}

/// Stops with a condition.
#[builtin]
fn invoke_debugger(condition: Value) -> Result<Step> {
    Ok(Step::Unhandled(condition))
}

/// Stops with a text.
#[builtin("BREAK", "&optional control &rest arguments")]
fn lisp_break(machine: &mut Machine<'_>, arguments: Vec<Value>) -> Result<Step> {
    signal_break(machine, &arguments)
}

/// The condition that a datum and arguments designate.
async fn designated_condition(calls: &Calls, args: Vec<Value>, default: Sym) -> Result<Value> {
    let mut args = args.into_iter();
    let datum = args.next().unwrap_or(Value::NIL);
    let mut initargs: Vec<Value>;
    match &datum {
        Value::Str(_) | Value::Function(_) => {
            initargs = vec![
                Value::symbol(default),
                known::K_FORMAT_CONTROL.into(),
                datum.clone(),
                known::K_FORMAT_ARGUMENTS.into(),
                Value::list(args),
            ];
        }
        Value::Symbol(..) | Value::Class(_) => {
            initargs = vec![datum.clone()];
            initargs.extend(args);
        }
        Value::Instance(i) if i.is_a(known::CONDITION) => return Ok(datum),
        other => return Err(Raise::type_error(other, known::CONDITION)),
    }
    let make = known::MAKE_CONDITION.into();
    Ok(calls.call(&make, Args::Many(initargs)).await)
}

/// Makes the condition that arguments designate and signals it.
pub fn signal_with(
    machine: &mut Machine<'_>,
    args: Vec<Value>,
    default: Sym,
    declined: Declined,
) -> Result<Step> {
    if let Some(Value::Instance(i)) = args.first()
        && i.is_a(known::CONDITION)
    {
        // The arguments of a condition were given when it was made.
        if args.len() > 1 {
            let arguments = Value::list(args[1..].to_vec());
            return Err(Raise::type_error(&arguments, known::NULL));
        }
        return signal_here(
            machine,
            args.into_iter().next().unwrap_or_default(),
            declined,
        );
    }
    run(machine, "SIGNAL", |calls| async move {
        let condition = designated_condition(&calls, args, default).await?;
        calls
            .with(move |machine| signal_here(machine, condition, declined))
            .await
    })
}

fn signal_here(machine: &mut Machine<'_>, condition: Value, declined: Declined) -> Result<Step> {
    let place = machine.place();
    machine.note_place(&condition, place);
    machine.signal(condition, declined)
}

fn signal_break(machine: &mut Machine<'_>, args: &[Value]) -> Result<Step> {
    let mut args = args.to_vec();
    if args.is_empty() {
        args.push("break".into());
    }
    run(machine, "BREAK", |calls| async move {
        let condition = designated_condition(&calls, args, known::SIMPLE_CONDITION).await?;
        Ok(Step::Unhandled(condition))
    })
}

/// The error of ECASE and its kin.
#[builtin]
fn case_failed(
    machine: &mut Machine<'_>,
    key: &Value,
    operator: &Value,
    wanted: &Value,
) -> Result<Step> {
    let image = &mut *machine.image;
    let show = |v: &Value| print::to_string(image, v, true);
    let report = format!(
        "{} fell through {} expression.\nWanted one of {}.",
        show(key),
        show(operator),
        show(wanted)
    );
    let is_by_type = matches!(
        operator.as_symbol(),
        Some(known::ETYPECASE | known::CTYPECASE)
    );
    let kind = if is_by_type { known::OR } else { known::MEMBER };
    let expected = Value::cons(kind.into(), wanted.clone());
    Err(Raise::new(known::TYPE_ERROR, report)
        .with(known::K_DATUM, key.clone())
        .with(known::K_EXPECTED_TYPE, expected))
}

/// The error of CHECK-TYPE.
#[builtin]
fn check_type_failed(
    image: &mut Image,
    value: &Value,
    place: &Value,
    type_: &Value,
    string: &Value,
) -> Result<Value> {
    let show = |v: &Value| print::to_string(image, v, true);
    let wanted = match string.as_text() {
        Some(text) => text,
        None => format!("of type {}", show(type_)),
    };
    let report = format!(
        "The value of {} is {}, which is not {wanted}.",
        show(place),
        show(value)
    );
    Err(Raise::new(known::SIMPLE_TYPE_ERROR, report)
        .with(known::K_DATUM, value.clone())
        .with(known::K_EXPECTED_TYPE, type_.clone()))
}

/// Builtins of package `COMMON-LISP`.
pub(crate) static TABLE: &[Builtin] = builtins![signal, error, invoke_debugger, lisp_break,];

/// Builtins of package `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![case_failed, check_type_failed,];

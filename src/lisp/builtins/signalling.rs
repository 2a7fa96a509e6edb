//! Signalling conditions, restarts, and throwing.

use crate::lisp::builtin::{Builtin, control, pure};
use crate::lisp::evaluator::restart::Restart;
use crate::lisp::evaluator::signal::Declined;
use crate::lisp::image::Image;
use crate::lisp::print;
use crate::lisp::value::Value;
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;
use crate::lisp::value::symbol::Sym;
use crate::lisp::vm::calls::{Args, Calls, run};
use crate::lisp::vm::machine::Machine;
use crate::lisp::vm::step::Step;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `COMMON-LISP`.
pub(crate) static TABLE: &[Builtin] = &[
    control(
        "SIGNAL",
        "datum &rest arguments",
        "Signals a condition; NIL if every handler declines.",
        &["(signal \"nothing happens\") => NIL"],
        |m, args| signal_with(m, args, known::SIMPLE_CONDITION, Declined::Return),
    ),
    control(
        "ERROR",
        "datum &rest arguments",
        "Signals an error: a condition object, the name of a class with initargs, or a format control with arguments.",
        &["(handler-case (error \"no ~a\" 1) (error (e) (princ-to-string e))) => \"no 1\""],
        |m, args| signal_with(m, args, known::SIMPLE_ERROR, Declined::Stop),
    ),
    control(
        "INVOKE-RESTART",
        "restart &rest arguments",
        "Calls the function of a restart.",
        &["(restart-case (invoke-restart 'r 1) (r (x) x)) => 1"],
        invoke_restart,
    ),
    control(
        "INVOKE-RESTART-INTERACTIVELY",
        "restart",
        "Calls the function of a restart with the arguments that its :interactive function returns.",
        &[
            "(restart-case (invoke-restart-interactively 'r) (r (x) :interactive (lambda () (list 1)) x)) => 1",
        ],
        invoke_restart_interactively,
    ),
    control(
        "INVOKE-DEBUGGER",
        "condition",
        "Stops with a condition.",
        &[],
        |_, args| Ok(Step::Unhandled(args[0].clone())),
    ),
    control(
        "BREAK",
        "&optional control &rest arguments",
        "Stops with a text.",
        &[],
        |m, args| signal_break(m, &args),
    ),
    control(
        "FIND-RESTART",
        "restart &optional condition",
        "The innermost restart of a name, or NIL.",
        &["(restart-case (restart-name (find-restart 'r)) (r () 1)) => R"],
        |m, args| Ok(Step::Return(m.find_restart(&args[0]).unwrap_or(Value::NIL))),
    ),
    control(
        "COMPUTE-RESTARTS",
        "&optional condition",
        "All restarts in force, innermost first.",
        &["(restart-case (restart-name (first (compute-restarts))) (r () 1)) => R"],
        |m, _| Ok(Step::Return(Value::list(m.restarts()))),
    ),
    pure(
        "RESTART-NAME",
        "restart",
        "The name of a restart.",
        &["(restart-case (restart-name (find-restart 'r)) (r () 1)) => R"],
        restart_name,
    ),
];

/// Builtins of package `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = &[
    control(
        "THROW-VALUES",
        "tag &rest values",
        "Leaves the innermost CATCH of the tag with the values.",
        &["(catch 'x (system:throw-values 'x 1 2)) => 1 ; 2"],
        |m, args| m.throw(&args[0], Value::values(args[1..].to_vec())),
    ),
    pure(
        "MAKE-RESTART",
        "name function report interactive",
        "A restart object.",
        &[],
        make_restart,
    ),
    control(
        "CASE-FAILED",
        "key operator wanted",
        "The error of ECASE and its kin.",
        &[],
        case_failed,
    ),
    pure(
        "CHECK-TYPE-FAILED",
        "value place type string",
        "The error of CHECK-TYPE.",
        &[],
        check_type_failed,
    ),
];

/// The condition that a datum and arguments designate.
async fn designated_condition(calls: &Calls, args: Vec<Value>, default: Sym) -> Result<Value> {
    let mut args = args.into_iter();
    let datum = args.next().unwrap_or(Value::NIL);
    let mut initargs: Vec<Value>;
    match &datum {
        Value::Str(_) | Value::Function(_) => {
            initargs = vec![
                Value::Symbol(default),
                known::K_FORMAT_CONTROL.into(),
                datum.clone(),
                known::K_FORMAT_ARGUMENTS.into(),
                Value::list(args),
            ];
        }
        Value::Symbol(_) | Value::Class(_) => {
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
pub(crate) fn signal_with(
    machine: &mut Machine<'_>,
    args: Vec<Value>,
    default: Sym,
    declined: Declined,
) -> Result<Step> {
    if let Some(Value::Instance(i)) = args.first()
        && i.is_a(known::CONDITION)
    {
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

fn invoke_restart(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step> {
    let restart = active_restart(machine, &args[0])?;
    Ok(call_restart(&restart, args[1..].to_vec()))
}

fn invoke_restart_interactively(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step> {
    let restart = active_restart(machine, &args[0])?;
    let asks = restart.as_foreign::<Restart>();
    let asks = asks.map_or(Value::NIL, |restart| restart.interactive.clone());
    if asks.is_nil() {
        return Ok(call_restart(&restart, Vec::new()));
    }
    run(
        machine,
        "INVOKE-RESTART-INTERACTIVELY",
        |calls| async move {
            let args = calls.call(&asks, Args::Many(Vec::new())).await;
            let args = args
                .list_to_vec()
                .ok_or_else(|| Raise::type_error(&args, known::LIST))?;
            Ok(call_restart(&restart, args))
        },
    )
}

fn active_restart(machine: &mut Machine<'_>, designator: &Value) -> Result<Value> {
    machine.find_restart(designator).ok_or_else(|| {
        let shown = print::to_string(machine.image, designator, true);
        Raise::control(format!("No restart {shown} is active."))
    })
}

fn call_restart(restart: &Value, args: Vec<Value>) -> Step {
    let function = restart
        .as_foreign::<Restart>()
        .map_or(Value::NIL, |r| r.function.clone());
    Step::TailCall { function, args }
}

fn restart_name(_: &mut Image, args: &[Value]) -> Result<Value> {
    match args[0].as_foreign::<Restart>() {
        Some(restart) => Ok(restart.name.into()),
        None => Err(Raise::type_error(&args[0], known::RESTART)),
    }
}

fn make_restart(_: &mut Image, args: &[Value]) -> Result<Value> {
    let Some(name) = args[0].as_symbol() else {
        return Err(Raise::type_error(&args[0], known::SYMBOL));
    };
    Ok(Value::foreign(Restart {
        name,
        function: args[1].clone(),
        report: args[2].clone(),
        interactive: args[3].clone(),
    }))
}

fn case_failed(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step> {
    let image = &mut *machine.image;
    let show = |v: &Value| print::to_string(image, v, true);
    let report = format!(
        "{} fell through {} expression.\nWanted one of {}.",
        show(&args[0]),
        show(&args[1]),
        show(&args[2])
    );
    let expected = Value::cons(known::MEMBER.into(), args[2].clone());
    Err(Raise::new(known::TYPE_ERROR, report)
        .with(known::K_DATUM, args[0].clone())
        .with(known::K_EXPECTED_TYPE, expected))
}

fn check_type_failed(image: &mut Image, args: &[Value]) -> Result<Value> {
    let show = |v: &Value| print::to_string(image, v, true);
    let wanted = match args[3].as_text() {
        Some(text) => text,
        None => format!("of type {}", show(&args[2])),
    };
    let report = format!(
        "The value of {} is {}, which is not {wanted}.",
        show(&args[1]),
        show(&args[0])
    );
    Err(Raise::new(known::SIMPLE_TYPE_ERROR, report)
        .with(known::K_DATUM, args[0].clone())
        .with(known::K_EXPECTED_TYPE, args[2].clone()))
}

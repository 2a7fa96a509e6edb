//! Networks of fluents: `fl-and`, `fl-funcall` and the like.

use crate::Result;
use crate::fluent::{self, FluentRef, Missed, Operation};
use crate::state::Plan;
use lisp::builtin::Builtin;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;
use lisp::vm::calls::run;
use lisp::vm::machine::Machine;
use lisp::vm::step::Step;

/// The last value, or NIL if one is NIL; a fluent if a value is one.
///
/// `(cpl:fl-and)` => `T`
/// `(cpl:fl-and 1 2 3)` => `3`
#[builtin]
fn fl_and(machine: &mut Machine<'_>, values: Vec<Value>) -> Result<Step> {
    operate(machine, "FN-FL-AND", Operation::And, values)
}

/// The first value that is not NIL; a fluent if a value is one.
///
/// `(cpl:fl-or nil 2)` => `2`
/// `(cpl:fl-or)` => `NIL`
#[builtin]
fn fl_or(machine: &mut Machine<'_>, values: Vec<Value>) -> Result<Step> {
    operate(machine, "FN-FL-OR", Operation::Or, values)
}

/// A fluent that is true once per pulse: per pulse since its creation (:NEVER), once for all missed
/// ones (:ONCE), or for each (:ALWAYS).
///
/// `(let* ((f (cpl:make-fluent)) (p (cpl:pulsed f))) (cpl:pulse f) (list (cpl:value p) (cpl:value p)))` => `(T NIL)`
#[builtin("PULSED")]
fn pulsed_builtin(
    machine: &mut Machine<'_>,
    fluent: FluentRef,
    #[key] handle_missed_pulses: Option<&Value>,
) -> Result<Step> {
    pulsed(machine, fluent, handle_missed_pulses)
}

/// The tail of a list that begins with the item; a fluent if an argument is one.
///
/// `(cpl:value (cpl-impl:fl-member (cpl:make-fluent :value 2) '(1 2 3)))` => `(2 3)`
#[builtin(_, "item list")]
fn fl_member(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step> {
    operate(
        machine,
        "FN-FL-MEMBER",
        Operation::Call(known::MEMBER.into()),
        args,
    )
}

/// Whether there is a fluent among the values.
fn has_fluent(args: &[Value]) -> bool {
    args.iter().any(|a| FluentRef::from_value(a).is_some())
}

/// A network over the arguments, or just its value if there is no fluent among them.
pub(super) fn operate(
    machine: &mut Machine<'_>,
    prefix: &'static str,
    operation: Operation,
    args: Vec<Value>,
) -> Result<Step> {
    if has_fluent(&args) {
        return make(machine, prefix, operation, args);
    }
    Ok(match operation {
        Operation::Pure(function) => Step::Return(function(machine.image, &args)?),
        Operation::And => Step::Return(match args.iter().find(|a| a.is_nil()) {
            Some(_) => Value::NIL,
            None => args.last().cloned().unwrap_or(Value::T),
        }),
        Operation::Or => {
            let found = args.into_iter().find(Value::is_true);
            Step::Return(found.unwrap_or(Value::NIL))
        }
        Operation::Call(function) | Operation::Apply(function) => Step::TailCall { function, args },
    })
}

/// A network, with its initial value.
fn make(
    machine: &mut Machine<'_>,
    prefix: &'static str,
    operation: Operation,
    args: Vec<Value>,
) -> Result<Step> {
    let net = FluentRef::net(&Plan::of(machine.image), prefix, operation, args);
    if !net.get().is_cacheable() {
        return Ok(Step::Return(net.value()));
    }
    let value = net.value();
    run(machine, "VALUE", |calls| async move {
        fluent::value(&calls, &net).await?;
        Ok(value)
    })
}

/// Calls the function; with a fluent among the arguments, a fluent of its value.
///
/// `(cpl:value (cpl:fl-funcall #'list (cpl:make-fluent :value 1) 2))` => `(1 2)`
#[builtin]
fn fl_funcall(machine: &mut Machine<'_>, function: Value, arguments: Vec<Value>) -> Result<Step> {
    operate(
        machine,
        "FN-FL-FUNCALL",
        Operation::Call(function),
        arguments,
    )
}

/// Applies the function to arguments and a list at the end, fluents among which make the result a
/// fluent.
///
/// `(cpl:value (cpl-impl:fl-apply #'list 1 (list (cpl:make-fluent :value 2))))` => `(1 (2))`
#[builtin]
fn fl_apply(machine: &mut Machine<'_>, function: Value, arguments: Vec<Value>) -> Result<Step> {
    let last: Vec<Value> = arguments
        .last()
        .map(|l| l.iter_list().collect())
        .unwrap_or_default();
    if has_fluent(&arguments) || has_fluent(&last) {
        return make(
            machine,
            "FN-FL-APPLY",
            Operation::Apply(function),
            arguments,
        );
    }
    Ok(Step::TailCall {
        function,
        args: arguments,
    })
}

/// A fluent that is true once per pulse: per pulse since its creation (:NEVER), once for all missed
/// ones (:ONCE), or for each (:ALWAYS).
///
/// `(let* ((f (cpl:make-fluent)) (p (cpl-impl:fl-pulsed f))) (cpl:pulse f) (list (cpl:value p) (cpl:value p)))` => `(T NIL)`
#[builtin("FL-PULSED")]
fn pulsed(
    machine: &mut Machine<'_>,
    fluent: FluentRef,
    #[key] handle_missed_pulses: Option<&Value>,
) -> Result<Step> {
    let plan = Plan::of(machine.image);
    let names = &plan.names;
    let mode = match handle_missed_pulses {
        None => Missed::Once,
        Some(mode) => match mode.as_symbol() {
            Some(m) if m == names.never => Missed::Never,
            Some(m) if m == names.once => Missed::Once,
            Some(m) if m == names.always => Missed::Always,
            _ => {
                let expected = [known::MEMBER, names.never, names.once, names.always];
                return Err(Raise::type_error(
                    mode,
                    Value::list(expected.map(Value::from)),
                ));
            }
        },
    };
    run(machine, "VALUE", |calls| async move {
        // The pulses of a network are counted relative to its present value.
        fluent::value(&calls, &fluent).await?;
        Ok(FluentRef::pulses(&plan, &fluent, mode).value())
    })
}

/// A fluent that is true once after each change of the other's value.
///
/// `(let* ((f (cpl:make-fluent :value 1)) (c (cpl:fl-value-changed f))) (list (cpl:value c) (setf (cpl:value f) 2) (cpl:value c) (cpl:value c)))` => `(NIL 2 T NIL)`
#[builtin("FL-VALUE-CHANGED")]
fn value_changed(
    machine: &mut Machine<'_>,
    fluent: FluentRef,
    #[key] test: Option<Value>,
    #[key] key: Option<Value>,
) -> Result<Step> {
    let plan = Plan::of(machine.image);
    let (test, key) = (test.unwrap_or(Value::NIL), key.unwrap_or(Value::NIL));
    run(machine, "FL-VALUE-CHANGED", |calls| async move {
        let mut old = fluent::value(&calls, &fluent).await?;
        if key.is_true() {
            old = calls.call1(&key, old).await;
        }
        Ok(FluentRef::change(&plan, &fluent, test, key, old).value())
    })
}

/// The builtins.
pub(crate) static TABLE: &[Builtin] = builtins![
    fl_and,
    fl_or,
    fl_funcall,
    fl_apply,
    pulsed,
    pulsed_builtin,
    value_changed,
    fl_member,
];

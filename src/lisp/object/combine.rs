//! Running the methods of a call: around, before, primary, after; or combined by an operator.

use std::rc::Rc;

use super::effective::applicable_methods;
use super::method::{generic_named, method_value};
use crate::image::Image;
use crate::value::Value;
use crate::value::dispatch::{Effective, Shape};
use crate::value::function::Function;
use crate::value::generic::{Combination, Method};
use crate::value::known;
use crate::value::raise::Raise;
use crate::vm::calls::{Args, run as run_calls};
use crate::vm::machine::Machine;
use crate::vm::step::Step;

/// How far a call has progressed.
#[derive(Clone, Copy)]
pub enum Stage {
    /// At the around method of this number.
    Around(usize),
    /// At the primary method of this number.
    Primary(usize),
}

/// The start of a call.
pub const START: Stage = Stage::Around(0);

/// The call of a method by a program's own combination; `next` is the function that
/// `call-next-method` calls, or `NIL`.
pub(crate) fn invoke_method(method: &Method, mut args: Vec<Value>, next: Value) -> Step {
    if method.takes_next {
        args.insert(0, next);
    }
    Step::TailCall {
        function: Value::Function(method.function.clone()),
        args,
    }
}

/// Runs a call from the given stage.
pub fn run(
    machine: &mut Machine<'_>,
    effective: &Rc<Effective>,
    stage: Stage,
    args: Vec<Value>,
) -> Result<Step, Box<Raise>> {
    let (around, before, primary, after, combination) = match &effective.shape {
        Shape::Combined {
            around,
            before,
            primary,
            after,
            combination,
        } => (around, before, primary, after, *combination),
        Shape::Single(method) | Shape::Read(_, method) | Shape::Write(_, method) => {
            return Ok(invoke(effective, method, None, args));
        }
        // The callers handle this case.
        Shape::NotApplicable => return Err(nothing_to_run()),
    };
    match stage {
        Stage::Around(i) => {
            if let Some(method) = around.get(i) {
                let next = Stage::Around(i + 1);
                return Ok(invoke(effective, method, Some(next), args));
            }
            if !combination.is_standard() {
                return operate(machine, effective, combination, primary, args);
            }
            if before.is_empty() && after.is_empty() {
                return run(machine, effective, Stage::Primary(0), args);
            }
            standard(machine, effective.clone(), args)
        }
        Stage::Primary(i) => match primary.get(i) {
            Some(method) => {
                let next = (i + 1 < primary.len()).then_some(Stage::Primary(i + 1));
                Ok(invoke(effective, method, next, args))
            }
            None => Err(nothing_to_run()),
        },
    }
}

/// The error for `call-next-method` without a next method.
pub(crate) fn no_next_method(image: &Image, name: &Value) -> Box<Raise> {
    let shown = crate::print::qualified(image, name);
    let report = format!("There is no next method for the generic function {shown}.");
    Raise::new(known::NO_NEXT_METHOD_ERROR, report).with(known::K_METHOD, name.clone())
}

/// The error for an effective method without methods to run, which the callers rule out.
fn nothing_to_run() -> Box<Raise> {
    Raise::new(known::NO_NEXT_METHOD_ERROR, "There is no next method.")
}

/// The call of one method; `next` is the stage at which `call-next-method` continues.
fn invoke(
    effective: &Rc<Effective>,
    method: &Rc<Method>,
    next: Option<Stage>,
    args: Vec<Value>,
) -> Step {
    let (function, args) = invocation(effective, method, next, args);
    Step::TailCall { function, args }
}

/// The function of a method and the arguments that it is called with.
fn invocation(
    effective: &Rc<Effective>,
    method: &Rc<Method>,
    next: Option<Stage>,
    mut args: Vec<Value>,
) -> (Value, Vec<Value>) {
    if method.takes_next {
        let next = match next {
            Some(stage) => Value::Function(next_function(effective.clone(), stage, args.clone())),
            None => Value::NIL,
        };
        args.insert(0, next);
    }
    (Value::Function(method.function.clone()), args)
}

/// The function behind `call-next-method`: without arguments it uses those of the call.
fn next_function(effective: Rc<Effective>, stage: Stage, args: Vec<Value>) -> Rc<Function> {
    Function::made_control(known::CALL_NEXT_METHOD, (0, None), move |machine, given| {
        if given.is_empty() {
            return run(machine, &effective, stage, args.clone());
        }
        check_same_methods(machine.image, &effective, &args, &given)?;
        run(machine, &effective, stage, given)
    })
}

/// Checks that the methods for other arguments are those for the ones of the call, in the same order.
fn check_same_methods(
    image: &Image,
    effective: &Effective,
    args: &[Value],
    others: &[Value],
) -> Result<(), Box<Raise>> {
    let Shape::Combined {
        around, primary, ..
    } = &effective.shape
    else {
        return Ok(());
    };
    let Some(method) = around.first().or(primary.first()) else {
        return Ok(());
    };
    let required = method.specializers.len();
    if others.len() < required {
        return Err(Raise::program(format!(
            "CALL-NEXT-METHOD takes no arguments or those of the generic function, at least {required}, not {}.",
            others.len()
        )));
    }
    let mut pairs = args.iter().zip(others).take(required);
    if pairs.all(|(one, other)| one.is_eq(other)) {
        return Ok(());
    }
    let Some(function) = generic_named(image, &method.name) else {
        return Ok(());
    };
    let Some(generic) = function.as_generic() else {
        return Ok(());
    };
    let before = applicable_methods(image, generic, args);
    let after = applicable_methods(image, generic, others);
    let is_same = |(one, other): (&Rc<Method>, &Rc<Method>)| Rc::ptr_eq(one, other);
    if before.len() == after.len() && before.iter().zip(&after).all(is_same) {
        return Ok(());
    }
    Err(Raise::simple(format!(
        "CALL-NEXT-METHOD is called with arguments for which {} has other methods than for those of the call.",
        crate::print::qualified(image, &method.name)
    )))
}

/// Runs before methods, the primary method, after methods; the values are those of the
/// primary one.
fn standard(
    machine: &mut Machine<'_>,
    effective: Rc<Effective>,
    args: Vec<Value>,
) -> Result<Step, Box<Raise>> {
    run_calls(machine, "CALL-METHOD", |calls| async move {
        let Shape::Combined {
            before,
            primary,
            after,
            ..
        } = &effective.shape
        else {
            return Err(nothing_to_run());
        };
        for method in before {
            let (function, args) = invocation(&effective, method, None, args.clone());
            calls.call(&function, Args::Many(args)).await;
        }
        let Some(main) = primary.first() else {
            return Err(nothing_to_run());
        };
        let next = (primary.len() > 1).then_some(Stage::Primary(1));
        let (function, main_args) = invocation(&effective, main, next, args.clone());
        let values = calls.call_for_values(&function, main_args).await;
        for method in after {
            let (function, args) = invocation(&effective, method, None, args.clone());
            calls.call(&function, Args::Many(args)).await;
        }
        Ok(values)
    })
}

/// Runs all methods of an operator combination and combines their values.
fn operate(
    machine: &mut Machine<'_>,
    effective: &Rc<Effective>,
    combination: Combination,
    methods: &[Rc<Method>],
    args: Vec<Value>,
) -> Result<Step, Box<Raise>> {
    if combination.is_long() {
        let methods = Value::list(methods.iter().map(method_value));
        let arguments = vec![combination.name.into(), methods, Value::list(args)];
        return Ok(Step::tail_call(combination.operator, arguments));
    }
    if let [only] = methods
        && combination.is_identity
    {
        return Ok(invoke(effective, only, None, args));
    }
    let (effective, methods) = (effective.clone(), methods.to_vec());
    run_calls(machine, "CALL-METHOD", |calls| async move {
        let mut values = Vec::new();
        for method in &methods {
            let (function, args) = invocation(&effective, method, None, args.clone());
            let value = calls.call(&function, Args::Many(args)).await;
            let decided = match combination.operator {
                known::AND => value.is_nil(),
                known::OR => value.is_true(),
                _ => false,
            };
            if decided {
                return Ok(Step::Return(value));
            }
            values.push(value);
        }
        Ok(match combination.operator {
            known::PROGN | known::AND | known::OR => {
                Step::Return(values.pop().unwrap_or(Value::NIL))
            }
            operator => Step::tail_call(operator, values),
        })
    })
}

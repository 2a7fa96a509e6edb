//! Arithmetic and comparison that also work on fluents: with a fluent among the arguments, the
//! result is a network.

use crate::builtins::networks::operate;
use crate::fluent::Operation;
use crate::request::Request;
use lisp::builtin::{Builtin, control};
use lisp::image::Image;
use lisp::native::{NativeCall, PureFn};
use lisp::value::Value;
use lisp::value::function::Body;
use lisp::value::known;
use lisp::value::number;
use lisp::value::raise::Raise;
use lisp::value::symbol::Sym;
use lisp::vm::machine::Machine;
use lisp::vm::step::Step;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// The builtins.
pub(crate) static TABLE: &[Builtin] = &[
    control(
        "+",
        "&rest numbers",
        "The sum; a fluent of the sum if a number is a fluent.",
        &[
            "(cpl:+ 1 2) => 3",
            "(cpl:value (cpl:+ 1 (cpl:make-fluent :value 2))) => 3",
        ],
        |m, args| apply(m, "FN-FL+", known::PLUS, args),
    ),
    control(
        "-",
        "number &rest numbers",
        "The difference, or the negated number; a fluent if a number is one.",
        &["(cpl:value (cpl:- (cpl:make-fluent :value 2))) => -2"],
        |m, args| apply(m, "FN-FL-", known::MINUS, args),
    ),
    control(
        "*",
        "&rest numbers",
        "The product; a fluent if a number is one.",
        &["(cpl:value (cpl:* 2 (cpl:make-fluent :value 2))) => 4"],
        |m, args| apply(m, "FN-FL*", known::TIMES, args),
    ),
    control(
        "/",
        "number &rest numbers",
        "The quotient, or the reciprocal; a fluent if a number is one.",
        &["(cpl:value (cpl:/ (cpl:make-fluent :value 5) 2)) => 5/2"],
        |m, args| apply(m, "FN-FL/", known::DIVIDE, args),
    ),
    control(
        "<",
        "number &rest numbers",
        "Do the numbers grow? A fluent if a number is one.",
        &["(cpl:value (cpl:< (cpl:make-fluent :value 1) 2)) => T"],
        |m, args| apply(m, "FN-FL<", known::LESS, args),
    ),
    control(
        ">",
        "number &rest numbers",
        "Do the numbers fall? A fluent if a number is one.",
        &["(cpl:value (cpl:> (cpl:make-fluent :value 1) 2)) => NIL"],
        |m, args| apply(m, "FN-FL>", known::GREATER, args),
    ),
    control(
        "=",
        "number &rest numbers",
        "Are the numbers equal? A fluent if a number is one.",
        &["(cpl:value (cpl:= (cpl:make-fluent :value 1) 1)) => T"],
        |m, args| apply(m, "FN-FL=", known::NUM_EQUAL, args),
    ),
    control(
        "EQ",
        "a b",
        "Are the objects identical? A fluent if one is a fluent.",
        &["(cpl:value (cpl:eq (cpl:make-fluent :value :x) :x)) => T"],
        |m, args| apply(m, "FN-FL-EQ", known::EQ, args),
    ),
    control(
        "EQL",
        "a b",
        "Are the objects identical or equal numbers of one type? A fluent if one is a fluent.",
        &["(cpl:value (cpl:eql (cpl:make-fluent :value 1) 1)) => T"],
        |m, args| apply(m, "FN-FL-EQL", known::EQL, args),
    ),
    control(
        "NOT",
        "object",
        "T for NIL; a fluent of that if the object is a fluent.",
        &["(cpl:value (cpl:not (cpl:make-fluent))) => T"],
        |m, args| apply(m, "FN-FL-NOT", known::NOT, args),
    ),
    control(
        "SLEEP",
        "seconds",
        "Waits for so many simulated seconds.",
        &["(cpl:sleep 3600) => NIL"],
        |_, args| sleep(&args),
    ),
];

/// The step that sleeps for the given time.
pub(super) fn sleep(args: &[Value]) -> Result<Step> {
    let seconds = seconds(&args[0])?;
    Ok(Step::request(Request::Sleep(seconds)))
}

/// A non-negative number of seconds.
pub(super) fn seconds(value: &Value) -> Result<f64> {
    match number::to_f64(value) {
        Some(seconds) if seconds >= 0.0 && seconds.is_finite() => Ok(seconds),
        _ => Err(Raise::type_error(
            value,
            Value::list([known::REAL.into(), Value::Int(0)]),
        )),
    }
}

/// Applies a Common Lisp function to the arguments; if there is a fluent among them, returns a
/// network that does so.
fn apply(
    machine: &mut Machine<'_>,
    prefix: &'static str,
    name: Sym,
    args: Vec<Value>,
) -> Result<Step> {
    let function = pure_function(machine.image, name)?;
    if !args.iter().any(|a| matches!(a, Value::Foreign(_))) {
        return function(machine.image, &args).map(Step::Return);
    }
    operate(machine, prefix, Operation::Pure(function), args)
}

/// The Common Lisp function with that name, which programs cannot redefine.
fn pure_function(image: &Image, name: Sym) -> Result<PureFn> {
    if let Some(function) = image.function(name)
        && let Body::Native(native) = &function.body
        && let NativeCall::Pure(function) = image.native_call(native)
    {
        return Ok(function);
    }
    Err(Raise::undefined_function(name.into()))
}

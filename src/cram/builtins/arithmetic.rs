//! Arithmetic and comparison that also work on fluents: with a fluent among the arguments, the
//! result is a network.

use crate::builtins::networks::operate;
use crate::fluent::Operation;
use crate::request::Request;
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::native::{NativeCall, PureFn};
use lisp::typed::FromValue;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::function::Body;
use lisp::value::known;
use lisp::value::number;
use lisp::value::raise::Raise;
use lisp::value::symbol::Sym;
use lisp::vm::machine::Machine;
use lisp::vm::step::Step;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// The sum; a fluent of the sum if a number is a fluent.
///
/// `(cpl:+ 1 2)` => `3`
/// `(cpl:value (cpl:+ 1 (cpl:make-fluent :value 2)))` => `3`
#[builtin("+")]
fn add(machine: &mut Machine<'_>, numbers: Vec<Value>) -> Result<Step> {
    apply(machine, "FN-FL+", known::PLUS, numbers)
}

/// The difference, or the negated number; a fluent if a number is one.
///
/// `(cpl:value (cpl:- (cpl:make-fluent :value 2)))` => `-2`
#[builtin("-", "number &rest numbers")]
fn subtract(machine: &mut Machine<'_>, numbers: Vec<Value>) -> Result<Step> {
    apply(machine, "FN-FL-", known::MINUS, numbers)
}

/// The product; a fluent if a number is one.
///
/// `(cpl:value (cpl:* 2 (cpl:make-fluent :value 2)))` => `4`
#[builtin("*")]
fn multiply(machine: &mut Machine<'_>, numbers: Vec<Value>) -> Result<Step> {
    apply(machine, "FN-FL*", known::TIMES, numbers)
}

/// The quotient, or the reciprocal; a fluent if a number is one.
///
/// `(cpl:value (cpl:/ (cpl:make-fluent :value 5) 2))` => `5/2`
#[builtin("/", "number &rest numbers")]
fn divide(machine: &mut Machine<'_>, numbers: Vec<Value>) -> Result<Step> {
    apply(machine, "FN-FL/", known::DIVIDE, numbers)
}

/// Do the numbers grow? A fluent if a number is one.
///
/// `(cpl:value (cpl:< (cpl:make-fluent :value 1) 2))` => `T`
#[builtin("<", "number &rest numbers")]
fn less(machine: &mut Machine<'_>, numbers: Vec<Value>) -> Result<Step> {
    apply(machine, "FN-FL<", known::LESS, numbers)
}

/// Do the numbers fall? A fluent if a number is one.
///
/// `(cpl:value (cpl:> (cpl:make-fluent :value 1) 2))` => `NIL`
#[builtin(">", "number &rest numbers")]
fn greater(machine: &mut Machine<'_>, numbers: Vec<Value>) -> Result<Step> {
    apply(machine, "FN-FL>", known::GREATER, numbers)
}

/// Are the numbers equal? A fluent if a number is one.
///
/// `(cpl:value (cpl:= (cpl:make-fluent :value 1) 1))` => `T`
#[builtin("=", "number &rest numbers")]
fn equal_numbers(machine: &mut Machine<'_>, numbers: Vec<Value>) -> Result<Step> {
    apply(machine, "FN-FL=", known::NUM_EQUAL, numbers)
}

/// Are the objects identical? A fluent if one is a fluent.
///
/// `(cpl:value (cpl:eq (cpl:make-fluent :value :x) :x))` => `T`
#[builtin(_, "a b")]
fn eq(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step> {
    apply(machine, "FN-FL-EQ", known::EQ, args)
}

/// Are the objects identical or equal numbers of one type? A fluent if one is a fluent.
///
/// `(cpl:value (cpl:eql (cpl:make-fluent :value 1) 1))` => `T`
#[builtin(_, "a b")]
fn eql(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step> {
    apply(machine, "FN-FL-EQL", known::EQL, args)
}

/// T for NIL; a fluent of that if the object is a fluent.
///
/// `(cpl:value (cpl:not (cpl:make-fluent)))` => `T`
#[builtin(_, "object")]
fn not(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step> {
    apply(machine, "FN-FL-NOT", known::NOT, args)
}

/// Waits for so many simulated seconds.
///
/// `(cpl:sleep 3600)` => `NIL`
#[builtin]
pub(super) fn sleep(seconds: Seconds) -> Result<Step> {
    Ok(Step::request(Request::Sleep(seconds.0)))
}

/// A non-negative number of seconds.
pub(super) struct Seconds(pub(super) f64);

impl FromValue<'_> for Seconds {
    fn from_value(_: &mut Image, value: &Value) -> Result<Self> {
        match number::to_f64(value) {
            Some(seconds) if seconds >= 0.0 && seconds.is_finite() => Ok(Seconds(seconds)),
            _ => Err(Raise::type_error(
                value,
                Value::list([known::REAL.into(), Value::Int(0)]),
            )),
        }
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

/// The builtins.
pub(crate) static TABLE: &[Builtin] = builtins![
    add,
    subtract,
    multiply,
    divide,
    less,
    greater,
    equal_numbers,
    eq,
    eql,
    not,
    sleep,
];

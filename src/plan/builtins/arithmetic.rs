//! Arithmetic and comparison that works on fluents, too: with a fluent among the arguments
//! the result is a network.

use crate::lisp::builtin::{Builtin, control};
use crate::lisp::image::Image;
use crate::lisp::native::PureFn;
use crate::lisp::value::Value;
use crate::lisp::value::known;
use crate::lisp::value::number;
use crate::lisp::value::raise::Raise;
use crate::lisp::vm::machine::Machine;
use crate::lisp::vm::step::Step;
use crate::plan::builtins::networks::operate;
use crate::plan::fluent::Operation;
use crate::plan::request::Request;

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
        |m, args| apply(m, "FN-FL+", add, args),
    ),
    control(
        "-",
        "number &rest numbers",
        "The difference, or the negated number; a fluent if a number is one.",
        &["(cpl:value (cpl:- (cpl:make-fluent :value 2))) => -2"],
        |m, args| apply(m, "FN-FL-", subtract, args),
    ),
    control(
        "*",
        "&rest numbers",
        "The product; a fluent if a number is one.",
        &["(cpl:value (cpl:* 2 (cpl:make-fluent :value 2))) => 4"],
        |m, args| apply(m, "FN-FL*", multiply, args),
    ),
    control(
        "/",
        "number &rest numbers",
        "The quotient, or the reciprocal; a fluent if a number is one.",
        &["(cpl:value (cpl:/ (cpl:make-fluent :value 5) 2)) => 5/2"],
        |m, args| apply(m, "FN-FL/", divide, args),
    ),
    control(
        "<",
        "number &rest numbers",
        "Do the numbers grow? A fluent if a number is one.",
        &["(cpl:value (cpl:< (cpl:make-fluent :value 1) 2)) => T"],
        |m, args| apply(m, "FN-FL<", less, args),
    ),
    control(
        ">",
        "number &rest numbers",
        "Do the numbers fall? A fluent if a number is one.",
        &["(cpl:value (cpl:> (cpl:make-fluent :value 1) 2)) => NIL"],
        |m, args| apply(m, "FN-FL>", greater, args),
    ),
    control(
        "=",
        "number &rest numbers",
        "Are the numbers equal? A fluent if a number is one.",
        &["(cpl:value (cpl:= (cpl:make-fluent :value 1) 1)) => T"],
        |m, args| apply(m, "FN-FL=", equal, args),
    ),
    control(
        "EQ",
        "a b",
        "Are the objects identical? A fluent if one is a fluent.",
        &["(cpl:value (cpl:eq (cpl:make-fluent :value :x) :x)) => T"],
        |m, args| apply(m, "FN-FL-EQ", eq, args),
    ),
    control(
        "EQL",
        "a b",
        "Are the objects identical or equal numbers of one type? A fluent if one is a fluent.",
        &["(cpl:value (cpl:eql (cpl:make-fluent :value 1) 1)) => T"],
        |m, args| apply(m, "FN-FL-EQL", eql, args),
    ),
    control(
        "NOT",
        "object",
        "T for NIL; a fluent of that if the object is a fluent.",
        &["(cpl:value (cpl:not (cpl:make-fluent))) => T"],
        |m, args| apply(m, "FN-FL-NOT", not, args),
    ),
    control(
        "SLEEP",
        "seconds",
        "Waits for so many simulated seconds.",
        &["(cpl:sleep 3600) => NIL"],
        |_, args| sleep(&args),
    ),
];

/// The step that sleeps.
pub(super) fn sleep(args: &[Value]) -> Result<Step> {
    let seconds = seconds(&args[0])?;
    Ok(Step::request(Request::Sleep(seconds)))
}

/// A number of seconds that is not negative.
pub(super) fn seconds(value: &Value) -> Result<f64> {
    match number::to_f64(value) {
        Some(seconds) if seconds >= 0.0 && seconds.is_finite() => Ok(seconds),
        _ => Err(Raise::type_error(
            value,
            Value::list([known::REAL.into(), Value::Int(0)]),
        )),
    }
}

fn apply(
    machine: &mut Machine<'_>,
    prefix: &'static str,
    function: PureFn,
    args: Vec<Value>,
) -> Result<Step> {
    if !args.iter().any(|a| matches!(a, Value::Foreign(_))) {
        return function(machine.image, &args).map(Step::Return);
    }
    operate(machine, prefix, Operation::Pure(function), args)
}

pub(super) fn add(_: &mut Image, args: &[Value]) -> Result<Value> {
    let mut sum = Value::Int(0);
    for arg in args {
        sum = number::add(&sum, arg)?;
    }
    Ok(sum)
}

pub(super) fn subtract(_: &mut Image, args: &[Value]) -> Result<Value> {
    let [first, rest @ ..] = args else {
        return Ok(Value::Int(0));
    };
    if rest.is_empty() {
        return number::negate(first);
    }
    let mut difference = first.clone();
    for arg in rest {
        difference = number::sub(&difference, arg)?;
    }
    Ok(difference)
}

pub(super) fn multiply(_: &mut Image, args: &[Value]) -> Result<Value> {
    let mut product = Value::Int(1);
    for arg in args {
        product = number::mul(&product, arg)?;
    }
    Ok(product)
}

pub(super) fn divide(_: &mut Image, args: &[Value]) -> Result<Value> {
    let [first, rest @ ..] = args else {
        return Ok(Value::Int(1));
    };
    if rest.is_empty() {
        return number::div(&Value::Int(1), first);
    }
    let mut quotient = first.clone();
    for arg in rest {
        quotient = number::div(&quotient, arg)?;
    }
    Ok(quotient)
}

/// Does the relation hold between each number and the next? All must be numbers.
fn chain(args: &[Value], holds: fn(&Value, &Value) -> Result<bool>) -> Result<Value> {
    if let [only] = args {
        // Comparing with itself checks the type.
        holds(only, only)?;
        return Ok(Value::T);
    }
    let mut all = true;
    for pair in args.windows(2) {
        all &= holds(&pair[0], &pair[1])?;
    }
    Ok(Value::bool(all))
}

pub(super) fn less(_: &mut Image, args: &[Value]) -> Result<Value> {
    chain(args, number::less)
}

pub(super) fn greater(_: &mut Image, args: &[Value]) -> Result<Value> {
    chain(args, |a, b| number::less(b, a))
}

pub(super) fn equal(_: &mut Image, args: &[Value]) -> Result<Value> {
    chain(args, number::number_equal)
}

pub(super) fn eq(_: &mut Image, args: &[Value]) -> Result<Value> {
    Ok(Value::bool(args[0].is_eq(&args[1])))
}

pub(super) fn eql(_: &mut Image, args: &[Value]) -> Result<Value> {
    Ok(Value::bool(args[0].is_eql(&args[1])))
}

pub(super) fn not(_: &mut Image, args: &[Value]) -> Result<Value> {
    Ok(Value::bool(args[0].is_nil()))
}

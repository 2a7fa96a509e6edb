//! Arithmetic, comparison, and division with rounding.

use crate::builtin::Builtin;
use crate::image::Image;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::known;
use crate::value::number;
use crate::value::number::Rounding;
use crate::value::raise::Raise;

type Outcome = Result<Value, Box<Raise>>;

/// The sum of the numbers; 0 of none.
///
/// `(+ 1 2 3)` => `6`
/// `(+ 1/2 0.5)` => `1.0`
/// `(+)` => `0`
#[builtin("+")]
fn add(numbers: &[Value]) -> Outcome {
    fold(numbers, Value::Int(0), number::add)
}

/// The product of the numbers; 1 of none.
///
/// `(* 2 3 4)` => `24`
/// `(* 1/2 4)` => `2`
#[builtin("*")]
fn multiply(numbers: &[Value]) -> Outcome {
    fold(numbers, Value::Int(1), number::mul)
}

/// The first number less the others; its negative if it is the only one.
///
/// `(- 10 1 2)` => `7`
/// `(- 5)` => `-5`
#[builtin("-", "number &rest numbers")]
fn subtract(numbers: &[Value]) -> Outcome {
    match numbers {
        [only] => number::negate(only),
        _ => reduce(numbers, number::sub),
    }
}

/// The first number divided by the others; its reciprocal if it is the only one.
///
/// `(/ 6 4)` => `3/2`
/// `(/ 2)` => `1/2`
/// `(/ 1.0 4)` => `0.25`
#[builtin("/", "number &rest numbers")]
fn divide_builtin(numbers: &[Value]) -> Outcome {
    match numbers {
        [only] => number::div(&Value::Int(1), only),
        _ => reduce(numbers, number::div),
    }
}

/// The number plus one.
///
/// `(1+ 5)` => `6`
#[builtin("1+")]
fn increment(number: &Value) -> Outcome {
    number::increment(number)
}

/// The number minus one.
///
/// `(1- 5)` => `4`
#[builtin("1-")]
fn decrement(number: &Value) -> Outcome {
    number::decrement(number)
}

/// Are all numbers equal in value?
///
/// `(= 1 1.0)` => `T`
/// `(= 1 2)` => `NIL`
#[builtin("=", "number &rest numbers")]
fn equal_numbers(numbers: &[Value]) -> Outcome {
    chain(numbers, number::number_equal)
}

/// Are no two of the numbers equal in value?
///
/// `(/= 1 2 3)` => `T`
/// `(/= 1 2 1)` => `NIL`
#[builtin("/=", "number &rest numbers")]
fn different_numbers(numbers: &[Value]) -> Outcome {
    check_numbers(numbers)?;
    for (i, a) in numbers.iter().enumerate() {
        for b in numbers.iter().skip(i + 1) {
            if number::number_equal(a, b)? {
                return Ok(Value::NIL);
            }
        }
    }
    Ok(Value::T)
}

/// Does each number come before the next one?
///
/// `(< 1 2 3)` => `T`
/// `(< 1 1)` => `NIL`
#[builtin("<", "number &rest numbers")]
fn less(numbers: &[Value]) -> Outcome {
    chain_of_reals(numbers, number::less)
}

/// Does each number come after the next one?
///
/// `(> 3 2 1)` => `T`
#[builtin(">", "number &rest numbers")]
fn greater(numbers: &[Value]) -> Outcome {
    chain_of_reals(numbers, number::greater)
}

/// Is each number at most the next one?
///
/// `(<= 1 1 2)` => `T`
#[builtin("<=", "number &rest numbers")]
fn at_most(numbers: &[Value]) -> Outcome {
    chain_of_reals(numbers, number::less_equal)
}

/// Is each number at least the next one?
///
/// `(>= 3 3 1)` => `T`
#[builtin(">=", "number &rest numbers")]
fn at_least(numbers: &[Value]) -> Outcome {
    chain_of_reals(numbers, number::greater_equal)
}

/// The largest of the numbers.
///
/// `(max 1 3 2)` => `3`
/// `(max 1 2.0)` => `2.0`
#[builtin(_, "number &rest numbers")]
fn max(numbers: &[Value]) -> Outcome {
    check_reals(numbers)?;
    reduce(numbers, number::maximum)
}

/// The smallest of the numbers.
///
/// `(min 1 3 2)` => `1`
#[builtin(_, "number &rest numbers")]
fn min(numbers: &[Value]) -> Outcome {
    check_reals(numbers)?;
    reduce(numbers, number::minimum)
}

/// The magnitude of the number.
///
/// `(abs -5)` => `5`
/// `(abs -0.5d0)` => `0.5d0`
#[builtin]
fn abs(number: &Value) -> Outcome {
    number::abs(number)
}

/// -1, 0 or 1 with the type of the number.
///
/// `(signum -2.5)` => `-1.0`
/// `(signum 0)` => `0`
#[builtin]
fn signum(number: &Value) -> Outcome {
    number::signum(number)
}

/// Is the number zero?
///
/// `(zerop -0.0)` => `T`
#[builtin]
fn zerop(number: &Value) -> Outcome {
    number::is_zero(number).map(Value::bool)
}

/// Is the number greater than zero?
///
/// `(plusp 1)` => `T`
#[builtin]
fn plusp(number: &Value) -> Outcome {
    number::is_plus(number).map(Value::bool)
}

/// Is the number less than zero?
///
/// `(minusp -1)` => `T`
#[builtin]
fn minusp(number: &Value) -> Outcome {
    number::is_minus(number).map(Value::bool)
}

/// Is the integer even?
///
/// `(evenp 2)` => `T`
#[builtin]
fn evenp(integer: &Value) -> Outcome {
    number::is_even(integer).map(Value::bool)
}

/// Is the integer odd?
///
/// `(oddp -3)` => `T`
#[builtin]
fn oddp(integer: &Value) -> Outcome {
    number::is_even(integer).map(|even| Value::bool(!even))
}

/// Is the object a number?
///
/// `(numberp 1/2)` => `T`
/// `(numberp 'a)` => `NIL`
#[builtin]
fn numberp(object: &Value) -> bool {
    number::is_number(object)
}

/// Is the object a real number?
///
/// `(realp 1.5)` => `T`
#[builtin]
fn realp(object: &Value) -> bool {
    number::is_real(object)
}

/// Is the object an integer or a ratio?
///
/// `(rationalp 1/2)` => `T`
/// `(rationalp 0.5)` => `NIL`
#[builtin]
fn rationalp(object: &Value) -> bool {
    number::is_rational(object)
}

/// Is the object an integer?
///
/// `(integerp 5)` => `T`
/// `(integerp 5.0)` => `NIL`
#[builtin]
fn integerp(object: &Value) -> bool {
    number::is_integer(object)
}

/// Is the object a float?
///
/// `(floatp 1.5)` => `T`
#[builtin]
fn floatp(object: &Value) -> bool {
    matches!(object, Value::Single(_) | Value::Double(_))
}

/// Is the object a complex number that is not real?
///
/// `(complexp #c(1 2))` => `T`
/// `(complexp 1)` => `NIL`
#[builtin]
fn complexp(object: &Value) -> bool {
    number::is_complex(object)
}

/// The integer at or below the quotient, and the remainder.
///
/// `(floor -7 2)` => `-4 ; 1`
/// `(floor 7.5)` => `7 ; 0.5`
#[builtin]
fn floor(image: &mut Image, number: &Value, divisor: Option<&Value>) -> Outcome {
    divide(image, number, divisor, Rounding::Floor)
}

/// The integer at or above the quotient, and the remainder.
///
/// `(ceiling 7 2)` => `4 ; -1`
#[builtin]
fn ceiling(image: &mut Image, number: &Value, divisor: Option<&Value>) -> Outcome {
    divide(image, number, divisor, Rounding::Ceiling)
}

/// The quotient without its fraction, and the remainder.
///
/// `(truncate -7 2)` => `-3 ; -1`
#[builtin]
fn truncate(image: &mut Image, number: &Value, divisor: Option<&Value>) -> Outcome {
    divide(image, number, divisor, Rounding::Truncate)
}

/// The integer nearest to the quotient, the even one of two, and the remainder.
///
/// `(round 2.5)` => `2 ; 0.5`
/// `(round 7 2)` => `4 ; -1`
#[builtin]
fn round(image: &mut Image, number: &Value, divisor: Option<&Value>) -> Outcome {
    divide(image, number, divisor, Rounding::Round)
}

/// Like FLOOR with a float as the quotient.
///
/// `(ffloor 7 2)` => `3.0 ; 1`
#[builtin]
fn ffloor(number: &Value, divisor: Option<&Value>) -> Outcome {
    divide_to_float(number, divisor, Rounding::Floor)
}

/// Like CEILING with a float as the quotient.
///
/// `(fceiling 7 2)` => `4.0 ; -1`
#[builtin]
fn fceiling(number: &Value, divisor: Option<&Value>) -> Outcome {
    divide_to_float(number, divisor, Rounding::Ceiling)
}

/// Like TRUNCATE with a float as the quotient.
///
/// `(ftruncate -7 2)` => `-3.0 ; -1`
#[builtin]
fn ftruncate(number: &Value, divisor: Option<&Value>) -> Outcome {
    divide_to_float(number, divisor, Rounding::Truncate)
}

/// Like ROUND with a float as the quotient.
///
/// `(fround 7 2)` => `4.0 ; -1`
#[builtin]
fn fround(number: &Value, divisor: Option<&Value>) -> Outcome {
    divide_to_float(number, divisor, Rounding::Round)
}

/// The remainder with the sign of the divisor.
///
/// `(mod -7 3)` => `2`
/// `(mod 7 -3)` => `-2`
#[builtin("MOD")]
fn lisp_mod(number: &Value, divisor: &Value) -> Outcome {
    number::modulo(number, divisor)
}

/// The remainder with the sign of the number.
///
/// `(rem -7 3)` => `-1`
#[builtin]
fn rem(number: &Value, divisor: &Value) -> Outcome {
    number::remainder(number, divisor)
}

/// A random number from zero up to, but not including, the limit.
///
/// `(random 1)` => `0`
#[builtin]
fn random(image: &mut Image, limit: &Value, random_state: Option<&Value>) -> Outcome {
    let state = random_state.unwrap_or(image.special(known::V_RANDOM_STATE));
    let state = state.clone();
    number::random_from(&mut image.random, limit, &state)
}

/// A copy of a random state, of the current one, or (T) one of its own.
///
/// `(random-state-p (make-random-state t))` => `T`
#[builtin(_, "&optional state")]
fn make_random_state(image: &mut Image, state_value: Option<&Value>) -> Outcome {
    let state = match state_value {
        Some(state) if state.is_true() => state,
        _ => image.special(known::V_RANDOM_STATE),
    };
    let state = state.clone();
    number::make_random_state(&mut image.random, &state)
}

/// Is the object a random state?
///
/// `(random-state-p *random-state*)` => `T`
#[builtin]
fn random_state_p(object: &Value) -> bool {
    object.as_foreign::<number::RandomState>().is_some()
}

fn fold(args: &[Value], start: Value, operate: fn(&Value, &Value) -> Outcome) -> Outcome {
    match args {
        // Combining the only argument with the start checks that it is a number.
        [only] => operate(&start, only),
        [] => Ok(start),
        _ => reduce(args, operate),
    }
}

/// Combines the numbers from left to right. There is at least one.
fn reduce(args: &[Value], operate: fn(&Value, &Value) -> Outcome) -> Outcome {
    let mut rest = args.iter();
    let first = rest.next().cloned().unwrap_or(Value::NIL);
    rest.try_fold(first, |total, number| operate(&total, number))
}

type Comparison = fn(&Value, &Value) -> Result<bool, Box<Raise>>;

fn check_numbers(args: &[Value]) -> Result<(), Box<Raise>> {
    match args.iter().find(|v| !number::is_number(v)) {
        Some(other) => Err(Raise::type_error(other, known::NUMBER)),
        None => Ok(()),
    }
}

fn check_reals(args: &[Value]) -> Result<(), Box<Raise>> {
    match args.iter().find(|v| !number::is_real(v)) {
        Some(other) => Err(Raise::type_error(other, known::REAL)),
        None => Ok(()),
    }
}

fn chain(args: &[Value], holds: Comparison) -> Outcome {
    check_numbers(args)?;
    ordered(args, holds)
}

fn chain_of_reals(args: &[Value], holds: Comparison) -> Outcome {
    check_reals(args)?;
    ordered(args, holds)
}

fn ordered(args: &[Value], holds: Comparison) -> Outcome {
    for pair in args.windows(2) {
        let [a, b] = pair else { continue };
        if !holds(a, b)? {
            return Ok(Value::NIL);
        }
    }
    Ok(Value::T)
}

/// The quotient and the remainder; the divisor is one if it is not given.
fn divide(image: &Image, number: &Value, divisor: Option<&Value>, rounding: Rounding) -> Outcome {
    let divisor = divisor.unwrap_or(&Value::Int(1));
    let (quotient, rest) = number::divide(number, divisor, rounding)?;
    Ok(image.with_second(quotient, || rest))
}

/// The same with a float as the quotient.
fn divide_to_float(number: &Value, divisor: Option<&Value>, rounding: Rounding) -> Outcome {
    let divisor = divisor.unwrap_or(&Value::Int(1));
    Ok(number::divide_to_float(number, divisor, rounding)?.into())
}

/// Builtins of package `COMMON-LISP`.
pub(crate) static TABLE: &[Builtin] = builtins![
    add,
    multiply,
    subtract,
    divide_builtin,
    increment,
    decrement,
    equal_numbers,
    different_numbers,
    less,
    greater,
    at_most,
    at_least,
    max,
    min,
    abs,
    signum,
    zerop,
    plusp,
    minusp,
    evenp,
    oddp,
    numberp,
    realp,
    rationalp,
    integerp,
    floatp,
    complexp,
    floor,
    ceiling,
    truncate,
    round,
    ffloor,
    fceiling,
    ftruncate,
    fround,
    lisp_mod,
    rem,
    random,
    make_random_state,
    random_state_p,
];

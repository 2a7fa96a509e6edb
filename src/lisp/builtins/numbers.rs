//! Arithmetic, comparison, and division with rounding.

use crate::builtin::{Builtin, pure};
use crate::image::Image;
use crate::value::Value;
use crate::value::known;
use crate::value::number;
use crate::value::number::Rounding;
use crate::value::raise::Raise;

type Outcome = Result<Value, Box<Raise>>;

/// Builtins of package `COMMON-LISP`.
pub static TABLE: &[Builtin] = &[
    pure(
        "+",
        "&rest numbers",
        "The sum of the numbers; 0 of none.",
        &["(+ 1 2 3) => 6", "(+ 1/2 0.5) => 1.0", "(+) => 0"],
        |_, args| fold(args, Value::Int(0), number::add),
    ),
    pure(
        "*",
        "&rest numbers",
        "The product of the numbers; 1 of none.",
        &["(* 2 3 4) => 24", "(* 1/2 4) => 2"],
        |_, args| fold(args, Value::Int(1), number::mul),
    ),
    pure(
        "-",
        "number &rest numbers",
        "The first number less the others; its negative if it is the only one.",
        &["(- 10 1 2) => 7", "(- 5) => -5"],
        |_, args| match args {
            [only] => number::negate(only),
            _ => reduce(args, number::sub),
        },
    ),
    pure(
        "/",
        "number &rest numbers",
        "The first number divided by the others; its reciprocal if it is the only one.",
        &["(/ 6 4) => 3/2", "(/ 2) => 1/2", "(/ 1.0 4) => 0.25"],
        |_, args| match args {
            [only] => number::div(&Value::Int(1), only),
            _ => reduce(args, number::div),
        },
    ),
    pure(
        "1+",
        "number",
        "The number plus one.",
        &["(1+ 5) => 6"],
        |_, args| number::increment(&args[0]),
    ),
    pure(
        "1-",
        "number",
        "The number minus one.",
        &["(1- 5) => 4"],
        |_, args| number::decrement(&args[0]),
    ),
    pure(
        "=",
        "number &rest numbers",
        "Are all numbers equal in value?",
        &["(= 1 1.0) => T", "(= 1 2) => NIL"],
        |_, args| chain(args, number::number_equal),
    ),
    pure(
        "/=",
        "number &rest numbers",
        "Are no two of the numbers equal in value?",
        &["(/= 1 2 3) => T", "(/= 1 2 1) => NIL"],
        |_, args| {
            check_numbers(args)?;
            for (i, a) in args.iter().enumerate() {
                for b in args.iter().skip(i + 1) {
                    if number::number_equal(a, b)? {
                        return Ok(Value::NIL);
                    }
                }
            }
            Ok(Value::T)
        },
    ),
    pure(
        "<",
        "number &rest numbers",
        "Does each number come before the next one?",
        &["(< 1 2 3) => T", "(< 1 1) => NIL"],
        |_, args| chain_of_reals(args, number::less),
    ),
    pure(
        ">",
        "number &rest numbers",
        "Does each number come after the next one?",
        &["(> 3 2 1) => T"],
        |_, args| chain_of_reals(args, number::greater),
    ),
    pure(
        "<=",
        "number &rest numbers",
        "Is each number at most the next one?",
        &["(<= 1 1 2) => T"],
        |_, args| chain_of_reals(args, number::less_equal),
    ),
    pure(
        ">=",
        "number &rest numbers",
        "Is each number at least the next one?",
        &["(>= 3 3 1) => T"],
        |_, args| chain_of_reals(args, number::greater_equal),
    ),
    pure(
        "MAX",
        "number &rest numbers",
        "The largest of the numbers.",
        &["(max 1 3 2) => 3", "(max 1 2.0) => 2.0"],
        |_, args| {
            check_reals(args)?;
            reduce(args, number::maximum)
        },
    ),
    pure(
        "MIN",
        "number &rest numbers",
        "The smallest of the numbers.",
        &["(min 1 3 2) => 1"],
        |_, args| {
            check_reals(args)?;
            reduce(args, number::minimum)
        },
    ),
    pure(
        "ABS",
        "number",
        "The magnitude of the number.",
        &["(abs -5) => 5", "(abs -0.5d0) => 0.5d0"],
        |_, args| number::abs(&args[0]),
    ),
    pure(
        "SIGNUM",
        "number",
        "-1, 0 or 1 with the type of the number.",
        &["(signum -2.5) => -1.0", "(signum 0) => 0"],
        |_, args| number::signum(&args[0]),
    ),
    pure(
        "ZEROP",
        "number",
        "Is the number zero?",
        &["(zerop -0.0) => T"],
        |_, args| number::is_zero(&args[0]).map(Value::bool),
    ),
    pure(
        "PLUSP",
        "number",
        "Is the number greater than zero?",
        &["(plusp 1) => T"],
        |_, args| number::is_plus(&args[0]).map(Value::bool),
    ),
    pure(
        "MINUSP",
        "number",
        "Is the number less than zero?",
        &["(minusp -1) => T"],
        |_, args| number::is_minus(&args[0]).map(Value::bool),
    ),
    pure(
        "EVENP",
        "integer",
        "Is the integer even?",
        &["(evenp 2) => T"],
        |_, args| number::is_even(&args[0]).map(Value::bool),
    ),
    pure(
        "ODDP",
        "integer",
        "Is the integer odd?",
        &["(oddp -3) => T"],
        |_, args| number::is_even(&args[0]).map(|even| Value::bool(!even)),
    ),
    pure(
        "NUMBERP",
        "object",
        "Is the object a number?",
        &["(numberp 1/2) => T", "(numberp 'a) => NIL"],
        |_, args| Ok(Value::bool(number::is_number(&args[0]))),
    ),
    pure(
        "REALP",
        "object",
        "Is the object a real number?",
        &["(realp 1.5) => T"],
        |_, args| Ok(Value::bool(number::is_real(&args[0]))),
    ),
    pure(
        "RATIONALP",
        "object",
        "Is the object an integer or a ratio?",
        &["(rationalp 1/2) => T", "(rationalp 0.5) => NIL"],
        |_, args| Ok(Value::bool(number::is_rational(&args[0]))),
    ),
    pure(
        "INTEGERP",
        "object",
        "Is the object an integer?",
        &["(integerp 5) => T", "(integerp 5.0) => NIL"],
        |_, args| Ok(Value::bool(number::is_integer(&args[0]))),
    ),
    pure(
        "FLOATP",
        "object",
        "Is the object a float?",
        &["(floatp 1.5) => T"],
        |_, args| {
            let is_float = matches!(args[0], Value::Single(_) | Value::Double(_));
            Ok(Value::bool(is_float))
        },
    ),
    pure(
        "COMPLEXP",
        "object",
        "Is the object a complex number that is not real?",
        &["(complexp #c(1 2)) => T", "(complexp 1) => NIL"],
        |_, args| Ok(Value::bool(number::is_complex(&args[0]))),
    ),
    pure(
        "FLOOR",
        "number &optional divisor",
        "The integer at or below the quotient, and the remainder.",
        &["(floor -7 2) => -4 ; 1", "(floor 7.5) => 7 ; 0.5"],
        |image, args| divide(image, args, Rounding::Floor),
    ),
    pure(
        "CEILING",
        "number &optional divisor",
        "The integer at or above the quotient, and the remainder.",
        &["(ceiling 7 2) => 4 ; -1"],
        |image, args| divide(image, args, Rounding::Ceiling),
    ),
    pure(
        "TRUNCATE",
        "number &optional divisor",
        "The quotient without its fraction, and the remainder.",
        &["(truncate -7 2) => -3 ; -1"],
        |image, args| divide(image, args, Rounding::Truncate),
    ),
    pure(
        "ROUND",
        "number &optional divisor",
        "The integer nearest to the quotient, the even one of two, and the remainder.",
        &["(round 2.5) => 2 ; 0.5", "(round 7 2) => 4 ; -1"],
        |image, args| divide(image, args, Rounding::Round),
    ),
    pure(
        "FFLOOR",
        "number &optional divisor",
        "Like FLOOR with a float as the quotient.",
        &["(ffloor 7 2) => 3.0 ; 1"],
        |_, args| divide_to_float(args, Rounding::Floor),
    ),
    pure(
        "FCEILING",
        "number &optional divisor",
        "Like CEILING with a float as the quotient.",
        &["(fceiling 7 2) => 4.0 ; -1"],
        |_, args| divide_to_float(args, Rounding::Ceiling),
    ),
    pure(
        "FTRUNCATE",
        "number &optional divisor",
        "Like TRUNCATE with a float as the quotient.",
        &["(ftruncate -7 2) => -3.0 ; -1"],
        |_, args| divide_to_float(args, Rounding::Truncate),
    ),
    pure(
        "FROUND",
        "number &optional divisor",
        "Like ROUND with a float as the quotient.",
        &["(fround 7 2) => 4.0 ; -1"],
        |_, args| divide_to_float(args, Rounding::Round),
    ),
    pure(
        "MOD",
        "number divisor",
        "The remainder with the sign of the divisor.",
        &["(mod -7 3) => 2", "(mod 7 -3) => -2"],
        |_, args| number::modulo(&args[0], &args[1]),
    ),
    pure(
        "REM",
        "number divisor",
        "The remainder with the sign of the number.",
        &["(rem -7 3) => -1"],
        |_, args| number::remainder(&args[0], &args[1]),
    ),
    pure(
        "RANDOM",
        "limit &optional random-state",
        "A random number from zero up to, but not including, the limit.",
        &["(random 1) => 0"],
        |image, args| {
            let state = args.get(1).unwrap_or(image.special(known::V_RANDOM_STATE));
            let state = state.clone();
            number::random_from(&mut image.random, &args[0], &state)
        },
    ),
    pure(
        "MAKE-RANDOM-STATE",
        "&optional state",
        "A copy of a random state, of the current one, or (T) one of its own.",
        &["(random-state-p (make-random-state t)) => T"],
        |image, args| {
            let state = match args.first() {
                Some(state) if state.is_true() => state,
                _ => image.special(known::V_RANDOM_STATE),
            };
            let state = state.clone();
            number::make_random_state(&mut image.random, &state)
        },
    ),
    pure(
        "RANDOM-STATE-P",
        "object",
        "Is the object a random state?",
        &["(random-state-p *random-state*) => T"],
        |_, args| {
            let is_state = args[0].as_foreign::<number::RandomState>().is_some();
            Ok(Value::bool(is_state))
        },
    ),
];

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

fn divisor(args: &[Value]) -> Value {
    args.get(1).cloned().unwrap_or(Value::Int(1))
}

fn divide(image: &Image, args: &[Value], rounding: Rounding) -> Outcome {
    let (quotient, rest) = number::divide(&args[0], &divisor(args), rounding)?;
    Ok(image.with_second(quotient, || rest))
}

fn divide_to_float(args: &[Value], rounding: Rounding) -> Outcome {
    let (quotient, rest) = number::divide_to_float(&args[0], &divisor(args), rounding)?;
    Ok(Value::values(vec![quotient, rest]))
}

/// Constants of numbers, and the variable `*random-state*`.
pub(crate) fn define_constants(image: &mut Image) {
    use crate::value::package::PackageTable;
    let constants: &[(&str, Value)] = &[
        (
            "MOST-POSITIVE-FIXNUM",
            Value::Int(number::MOST_POSITIVE_FIXNUM),
        ),
        (
            "MOST-NEGATIVE-FIXNUM",
            Value::Int(number::MOST_NEGATIVE_FIXNUM),
        ),
        ("MOST-POSITIVE-SINGLE-FLOAT", Value::Single(f32::MAX)),
        ("MOST-NEGATIVE-SINGLE-FLOAT", Value::Single(f32::MIN)),
        ("MOST-POSITIVE-SHORT-FLOAT", Value::Single(f32::MAX)),
        ("MOST-NEGATIVE-SHORT-FLOAT", Value::Single(f32::MIN)),
        ("MOST-POSITIVE-DOUBLE-FLOAT", Value::Double(f64::MAX)),
        ("MOST-NEGATIVE-DOUBLE-FLOAT", Value::Double(f64::MIN)),
        ("MOST-POSITIVE-LONG-FLOAT", Value::Double(f64::MAX)),
        ("MOST-NEGATIVE-LONG-FLOAT", Value::Double(f64::MIN)),
        (
            "LEAST-POSITIVE-SINGLE-FLOAT",
            Value::Single(f32::from_bits(1)),
        ),
        (
            "LEAST-NEGATIVE-SINGLE-FLOAT",
            Value::Single(-f32::from_bits(1)),
        ),
        (
            "LEAST-POSITIVE-SHORT-FLOAT",
            Value::Single(f32::from_bits(1)),
        ),
        (
            "LEAST-NEGATIVE-SHORT-FLOAT",
            Value::Single(-f32::from_bits(1)),
        ),
        (
            "LEAST-POSITIVE-DOUBLE-FLOAT",
            Value::Double(f64::from_bits(1)),
        ),
        (
            "LEAST-NEGATIVE-DOUBLE-FLOAT",
            Value::Double(-f64::from_bits(1)),
        ),
        (
            "LEAST-POSITIVE-LONG-FLOAT",
            Value::Double(f64::from_bits(1)),
        ),
        (
            "LEAST-NEGATIVE-LONG-FLOAT",
            Value::Double(-f64::from_bits(1)),
        ),
        (
            "LEAST-POSITIVE-NORMALIZED-SINGLE-FLOAT",
            Value::Single(f32::MIN_POSITIVE),
        ),
        (
            "LEAST-NEGATIVE-NORMALIZED-SINGLE-FLOAT",
            Value::Single(-f32::MIN_POSITIVE),
        ),
        (
            "LEAST-POSITIVE-NORMALIZED-SHORT-FLOAT",
            Value::Single(f32::MIN_POSITIVE),
        ),
        (
            "LEAST-NEGATIVE-NORMALIZED-SHORT-FLOAT",
            Value::Single(-f32::MIN_POSITIVE),
        ),
        (
            "LEAST-POSITIVE-NORMALIZED-DOUBLE-FLOAT",
            Value::Double(f64::MIN_POSITIVE),
        ),
        (
            "LEAST-NEGATIVE-NORMALIZED-DOUBLE-FLOAT",
            Value::Double(-f64::MIN_POSITIVE),
        ),
        (
            "LEAST-POSITIVE-NORMALIZED-LONG-FLOAT",
            Value::Double(f64::MIN_POSITIVE),
        ),
        (
            "LEAST-NEGATIVE-NORMALIZED-LONG-FLOAT",
            Value::Double(-f64::MIN_POSITIVE),
        ),
        // The smallest floats that change one when added to it or subtracted from it.
        (
            "SINGLE-FLOAT-EPSILON",
            Value::Single(f32::from_bits(0x3380_0001)),
        ),
        (
            "SINGLE-FLOAT-NEGATIVE-EPSILON",
            Value::Single(f32::from_bits(0x3300_0001)),
        ),
        (
            "SHORT-FLOAT-EPSILON",
            Value::Single(f32::from_bits(0x3380_0001)),
        ),
        (
            "SHORT-FLOAT-NEGATIVE-EPSILON",
            Value::Single(f32::from_bits(0x3300_0001)),
        ),
        (
            "DOUBLE-FLOAT-EPSILON",
            Value::Double(f64::from_bits(0x3CA0_0000_0000_0001)),
        ),
        (
            "DOUBLE-FLOAT-NEGATIVE-EPSILON",
            Value::Double(f64::from_bits(0x3C90_0000_0000_0001)),
        ),
        (
            "LONG-FLOAT-EPSILON",
            Value::Double(f64::from_bits(0x3CA0_0000_0000_0001)),
        ),
        (
            "LONG-FLOAT-NEGATIVE-EPSILON",
            Value::Double(f64::from_bits(0x3C90_0000_0000_0001)),
        ),
    ];
    let state = number::RandomState { generator: None };
    image.define_special(known::V_RANDOM_STATE, Value::foreign(state));
    for (name, value) in constants {
        let sym = image.export_symbol(PackageTable::CL, name);
        image.define_constant(sym, value.clone());
    }
}

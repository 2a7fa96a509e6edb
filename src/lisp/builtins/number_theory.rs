//! Integers as numbers and as sequences of bits; exact fractions; the parts of floats.

use std::rc::Rc;

use crate::builtin::Builtin;
use crate::image::Image;
use crate::reader::numeric::parse_integer as read_integer;
use crate::typed::FromValue;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::known;
use crate::value::number;
use crate::value::number::ByteSpecifier;
use crate::value::package::PackageTable;
use crate::value::raise::Raise;
use crate::value::sequence::{Bounds, Sequence};
use crate::value::string::LispString;

type Outcome = Result<Value, Box<Raise>>;

/// The greatest common divisor; 0 of none.
///
/// `(gcd 12 18 27)` => `3`
/// `(gcd)` => `0`
#[builtin]
fn gcd(integers: &[Value]) -> Outcome {
    fold(integers, 0, number::gcd)
}

/// The least common multiple; 1 of none.
///
/// `(lcm 4 6)` => `12`
#[builtin]
fn lcm(integers: &[Value]) -> Outcome {
    fold(integers, 1, number::lcm)
}

/// The largest integer whose square is not above the integer.
///
/// `(isqrt 17)` => `4`
#[builtin]
fn isqrt(integer: &Value) -> Outcome {
    number::isqrt(integer)
}

/// The numerator in lowest terms.
///
/// `(numerator 6/4)` => `3`
#[builtin]
fn numerator(rational: &Value) -> Outcome {
    number::numerator(rational)
}

/// The denominator in lowest terms.
///
/// `(denominator 6/4)` => `2`
#[builtin]
fn denominator(rational: &Value) -> Outcome {
    number::denominator(rational)
}

/// The exact value of the number.
///
/// `(rational 0.5)` => `1/2`
#[builtin]
fn rational(number: &Value) -> Outcome {
    number::rational(number)
}

/// The simplest exact number that is the same float.
///
/// `(rationalize 0.1)` => `1/10`
#[builtin]
fn rationalize(number: &Value) -> Outcome {
    number::rationalize(number)
}

/// The bits that all integers have.
///
/// `(logand 12 10)` => `8`
/// `(logand)` => `-1`
#[builtin]
fn logand(integers: &[Value]) -> Outcome {
    fold(integers, -1, number::and)
}

/// The bits that some of the integers have.
///
/// `(logior 12 10)` => `14`
#[builtin]
fn logior(integers: &[Value]) -> Outcome {
    fold(integers, 0, number::or)
}

/// The bits that an odd number of the integers have.
///
/// `(logxor 12 10)` => `6`
#[builtin]
fn logxor(integers: &[Value]) -> Outcome {
    fold(integers, 0, number::xor)
}

/// The bits in which an even number of the integers differ.
///
/// `(logeqv 12 10)` => `-7`
#[builtin]
fn logeqv(integers: &[Value]) -> Outcome {
    fold(integers, -1, |a, b| number::not(&number::xor(a, b)?))
}

/// The bits that the integer does not have.
///
/// `(lognot 5)` => `-6`
#[builtin]
fn lognot(integer: &Value) -> Outcome {
    number::not(integer)
}

/// The bits that not both have.
///
/// `(lognand 12 10)` => `-9`
#[builtin]
fn lognand(integer1: &Value, integer2: &Value) -> Outcome {
    boole_op(6, integer1, integer2)
}

/// The bits that neither has.
///
/// `(lognor 12 10)` => `-15`
#[builtin]
fn lognor(integer1: &Value, integer2: &Value) -> Outcome {
    boole_op(11, integer1, integer2)
}

/// The bits of the second that the first does not have.
///
/// `(logandc1 12 10)` => `2`
#[builtin]
fn logandc1(integer1: &Value, integer2: &Value) -> Outcome {
    boole_op(12, integer1, integer2)
}

/// The bits of the first that the second does not have.
///
/// `(logandc2 15 5)` => `10`
#[builtin]
fn logandc2(integer1: &Value, integer2: &Value) -> Outcome {
    boole_op(13, integer1, integer2)
}

/// The bits of the second and those that the first does not have.
///
/// `(logorc1 12 10)` => `-5`
#[builtin]
fn logorc1(integer1: &Value, integer2: &Value) -> Outcome {
    boole_op(14, integer1, integer2)
}

/// The bits of the first and those that the second does not have.
///
/// `(logorc2 12 10)` => `-3`
#[builtin]
fn logorc2(integer1: &Value, integer2: &Value) -> Outcome {
    boole_op(15, integer1, integer2)
}

/// Have both integers a bit in common?
///
/// `(logtest 12 4)` => `T`
#[builtin]
fn logtest(integer1: &Value, integer2: &Value) -> Outcome {
    let common = number::and(integer1, integer2)?;
    Ok(Value::bool(!number::is_zero(&common)?))
}

/// Has the integer the bit of that index?
///
/// `(logbitp 0 5)` => `T`
/// `(logbitp 1 5)` => `NIL`
#[builtin]
fn logbitp(index: &Value, integer: &Value) -> Outcome {
    number::is_bit_set(index, integer).map(Value::bool)
}

/// The number of bits that differ from the sign.
///
/// `(logcount 255)` => `8`
#[builtin]
fn logcount(integer: &Value) -> Outcome {
    number::bit_count(integer)
}

/// The number of bits without the sign.
///
/// `(integer-length 255)` => `8`
/// `(integer-length 0)` => `0`
#[builtin]
fn integer_length(integer: &Value) -> Outcome {
    number::bit_length(integer)
}

/// The integer shifted to the left; to the right if the count is negative.
///
/// `(ash 1 10)` => `1024`
/// `(ash -8 -1)` => `-4`
#[builtin]
fn ash(integer: &Value, count: &Value) -> Outcome {
    number::ash(integer, count)
}

/// Combines the bits of two integers by an operation such as BOOLE-AND.
///
/// `(boole boole-and 12 10)` => `8`
#[builtin(_, "operation integer1 integer2")]
fn boole(operation_value: &Value, integer1: &Value, integer2: &Value) -> Outcome {
    match operation_value {
        Value::Int(operation @ 0..=15) => boole_op(*operation, integer1, integer2),
        other => Err(Raise::type_error(
            other,
            Value::list([known::MOD.into(), Value::Int(16)]),
        )),
    }
}

/// Describes so many bits above so many others.
///
/// `(byte 8 0)` => `(8 . 0)`
#[builtin]
fn byte(size: &Value, position: &Value) -> Outcome {
    byte_of(&Value::cons(size.clone(), position.clone()))?;
    Ok(Value::cons(size.clone(), position.clone()))
}

/// How many bits a byte has.
///
/// `(byte-size (byte 8 2))` => `8`
#[builtin(_, "byte")]
fn byte_size(byte_value: &Value) -> Outcome {
    byte_of(byte_value).map(|byte| Value::Int(byte.size.into()))
}

/// How many bits are below a byte.
///
/// `(byte-position (byte 8 2))` => `2`
#[builtin(_, "byte")]
fn byte_position(byte_value: &Value) -> Outcome {
    byte_of(byte_value).map(|byte| Value::Int(byte.position.into()))
}

/// The bits of a byte, as an integer.
///
/// `(ldb (byte 8 0) 511)` => `255`
#[builtin]
fn ldb(byte: ByteSpecifier, integer: &Value) -> Outcome {
    number::extract(byte, integer)
}

/// Is any bit of a byte set?
///
/// `(ldb-test (byte 2 0) 4)` => `NIL`
#[builtin]
fn ldb_test(byte: ByteSpecifier, integer: &Value) -> Outcome {
    let bits = number::extract(byte, integer)?;
    Ok(Value::bool(!number::is_zero(&bits)?))
}

/// The bits of a byte where they are in the integer.
///
/// `(mask-field (byte 4 4) 255)` => `240`
#[builtin]
fn mask_field(byte: ByteSpecifier, integer: &Value) -> Outcome {
    let bits = number::extract(byte, integer)?;
    number::ash(&bits, &Value::Int(byte.position.into()))
}

/// The integer with new bits in a byte.
///
/// `(dpb 15 (byte 4 0) 0)` => `15`
#[builtin]
fn dpb(new: &Value, byte: ByteSpecifier, integer: &Value) -> Outcome {
    number::deposit(new, byte, integer)
}

/// The integer with a byte taken over from another integer.
///
/// `(deposit-field 255 (byte 4 4) 0)` => `240`
#[builtin]
fn deposit_field(new: &Value, byte: ByteSpecifier, integer: &Value) -> Outcome {
    let bits = number::extract(byte, new)?;
    number::deposit(&bits, byte, integer)
}

/// Mantissa, exponent and sign of a float.
///
/// `(decode-float 0.5)` => `0.5 ; 0 ; 1.0`
#[builtin]
fn decode_float(float: &Value) -> Outcome {
    number::decode(float).map(|parts| Value::values(parts.to_vec()))
}

/// Mantissa, exponent and sign of a float as integers.
///
/// `(integer-decode-float 1.0)` => `8388608 ; -23 ; 1`
#[builtin]
fn integer_decode_float(float: &Value) -> Outcome {
    number::integer_decode(float).map(|parts| Value::values(parts.to_vec()))
}

/// The float times two to the power.
///
/// `(scale-float 1.5 2)` => `6.0`
#[builtin]
fn scale_float(float: &Value, power: &Value) -> Outcome {
    number::scale(float, power)
}

/// The base of the float's exponent.
///
/// `(float-radix 1.0)` => `2`
#[builtin]
fn float_radix(float: &Value) -> Outcome {
    number::digits(float).map(|_| Value::Int(2))
}

/// The number of bits of the mantissa.
///
/// `(float-digits 1.0)` => `24`
#[builtin]
fn float_digits(float: &Value) -> Outcome {
    number::digits(float)
}

/// The number of significant bits of the mantissa.
///
/// `(float-precision 1d0)` => `53`
#[builtin]
fn float_precision(float: &Value) -> Outcome {
    number::precision(float)
}

/// The magnitude, or one, with the sign of the float.
///
/// `(float-sign -2.5)` => `-1.0`
/// `(float-sign -1.0 3.0)` => `-3.0`
#[builtin]
fn float_sign(float: &Value, magnitude: Option<&Value>) -> Outcome {
    number::sign_of(float, magnitude)
}

fn fold(args: &[Value], start: i64, operate: fn(&Value, &Value) -> Outcome) -> Outcome {
    args.iter()
        .try_fold(Value::Int(start), |total, n| operate(&total, n))
}

/// Names of the operations of `boole`, in order of their numbers.
const BOOLE: [&str; 16] = [
    "BOOLE-CLR",
    "BOOLE-SET",
    "BOOLE-1",
    "BOOLE-2",
    "BOOLE-C1",
    "BOOLE-C2",
    "BOOLE-NAND",
    "BOOLE-AND",
    "BOOLE-IOR",
    "BOOLE-XOR",
    "BOOLE-EQV",
    "BOOLE-NOR",
    "BOOLE-ANDC1",
    "BOOLE-ANDC2",
    "BOOLE-ORC1",
    "BOOLE-ORC2",
];

fn boole_op(operation: i64, a: &Value, b: &Value) -> Outcome {
    use number::{and, not, or, xor};
    // Both are checked to be integers, whatever the operation.
    let both = and(a, b)?;
    match operation {
        0 => Ok(Value::Int(0)),
        1 => Ok(Value::Int(-1)),
        2 => Ok(a.clone()),
        3 => Ok(b.clone()),
        4 => not(a),
        5 => not(b),
        6 => not(&both),
        7 => Ok(both),
        8 => or(a, b),
        9 => xor(a, b),
        10 => not(&xor(a, b)?),
        11 => not(&or(a, b)?),
        12 => and(&not(a)?, b),
        13 => and(a, &not(b)?),
        14 => or(&not(a)?, b),
        _ => or(a, &not(b)?),
    }
}

/// Defines the constants `BOOLE-AND` and so on.
pub(crate) fn define_constants(image: &mut Image) {
    for (name, number) in BOOLE.iter().zip(0..) {
        let sym = image.export_symbol(PackageTable::CL, name);
        image.define_constant(sym, Value::Int(number));
    }
}

/// A byte: a pair of size and position.
impl FromValue<'_> for ByteSpecifier {
    fn from_value(_: &mut Image, value: &Value) -> Result<Self, Box<Raise>> {
        byte_of(value)
    }
}

fn byte_of(value: &Value) -> Result<ByteSpecifier, Box<Raise>> {
    let part = |part: &Value| match part {
        Value::Int(n) => u32::try_from(*n).ok(),
        _ => None,
    };
    let wrong = || Raise::type_error(value, known::CONS);
    let pair = value.as_cons().ok_or_else(wrong)?;
    match (part(&pair.car()), part(&pair.cdr())) {
        (Some(size), Some(position)) => Ok(ByteSpecifier { size, position }),
        (None, _) => Err(Raise::type_error(&pair.car(), known::UNSIGNED_BYTE)),
        _ => Err(Raise::type_error(&pair.cdr(), known::UNSIGNED_BYTE)),
    }
}

/// The number as a float; as a float of the prototype's type.
///
/// `(float 5)` => `5.0`
/// `(float 1/3 1d0)` => `0.3333333333333333d0`
#[builtin(_, "number &optional prototype")]
fn float(number_value: &Value, prototype_value: Option<&Value>) -> Outcome {
    match (number_value, prototype_value) {
        (Value::Single(_) | Value::Double(_), None) => Ok(number_value.clone()),
        (number, Some(prototype @ (Value::Single(_) | Value::Double(_)))) => {
            number::to_float_like(number, prototype)
        }
        (_, Some(other)) => Err(Raise::type_error(other, known::FLOAT)),
        (number, None) => number::to_single(number),
    }
}

/// The integer that a string stands for, and where it ends.
///
/// `(parse-integer " 42 ")` => `42 ; 4`
/// `(parse-integer "ff" :radix 16)` => `255 ; 2`
#[builtin]
fn parse_integer(
    image: &mut Image,
    string: &Rc<LispString>,
    #[key] start: Option<&Value>,
    #[key] end: Option<&Value>,
    #[key] radix: Option<&Value>,
    #[key] junk_allowed: Option<bool>,
) -> Outcome {
    let sequence = Sequence::Str(string.clone());
    let bounds = Bounds::new(&sequence, start, end)?;
    let radix = match radix {
        None => 10,
        Some(Value::Int(n @ 2..=36)) => u32::try_from(*n).unwrap_or(10),
        Some(other) => {
            let range = [known::INTEGER.into(), Value::Int(2), Value::Int(36)];
            return Err(Raise::type_error(other, Value::list(range)));
        }
    };
    let junk_allowed = junk_allowed == Some(true);
    let text = string.text();
    let chars: Vec<char> = text
        .chars()
        .skip(bounds.start)
        .take(bounds.end.unwrap_or(usize::MAX) - bounds.start)
        .collect();
    let blanks = chars.iter().take_while(|c| c.is_whitespace()).count();
    let signs = usize::from(matches!(chars.get(blanks), Some('+' | '-')));
    let digits = chars
        .iter()
        .skip(blanks + signs)
        .take_while(|c| c.is_digit(radix))
        .count();
    let end_of_number = blanks + signs + digits;
    let rest_is_blank = chars.iter().skip(end_of_number).all(|c| c.is_whitespace());
    let token: String = chars.iter().skip(blanks).take(signs + digits).collect();
    let number = read_integer(&token, radix);
    let position = if junk_allowed {
        end_of_number
    } else {
        chars.len()
    };
    match number {
        Some(number) if rest_is_blank || junk_allowed => Ok(Value::values(vec![
            number,
            Value::from(bounds.start + position),
        ])),
        None if junk_allowed => Ok(Value::values(vec![
            Value::NIL,
            Value::from(bounds.start + position),
        ])),
        None if rest_is_blank => Err(Raise::new(
            known::SIMPLE_PARSE_ERROR,
            format!(
                "no non-whitespace characters in string {}.",
                super::shown::shown(image, &sequence.value())
            ),
        )),
        _ => Err(Raise::new(
            known::SIMPLE_PARSE_ERROR,
            format!(
                "junk in string {}",
                super::shown::shown(image, &sequence.value())
            ),
        )),
    }
}

/// Builtins of package `COMMON-LISP`.
pub(crate) static TABLE: &[Builtin] = builtins![
    gcd,
    lcm,
    isqrt,
    numerator,
    denominator,
    rational,
    rationalize,
    float,
    logand,
    logior,
    logxor,
    logeqv,
    lognot,
    lognand,
    lognor,
    logandc1,
    logandc2,
    logorc1,
    logorc2,
    logtest,
    logbitp,
    logcount,
    integer_length,
    ash,
    boole,
    byte,
    byte_size,
    byte_position,
    ldb,
    ldb_test,
    mask_field,
    dpb,
    deposit_field,
    decode_float,
    integer_decode_float,
    scale_float,
    float_radix,
    float_digits,
    float_precision,
    float_sign,
    parse_integer,
];

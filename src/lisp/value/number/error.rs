//! Conditions of arithmetic.

use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;

/// The result of an operation on numbers.
pub(crate) type NumberResult = Result<Value, Box<Raise>>;

/// `datum` is not a number.
#[cold]
pub(crate) fn not_a_number(datum: &Value) -> Box<Raise> {
    Raise::type_error(datum, known::NUMBER)
}

/// `datum` is not a real number.
#[cold]
pub(crate) fn not_real(datum: &Value) -> Box<Raise> {
    Raise::type_error(datum, known::REAL)
}

/// `datum` is not an integer.
#[cold]
pub(crate) fn not_an_integer(datum: &Value) -> Box<Raise> {
    Raise::type_error(datum, known::INTEGER)
}

/// `datum` is not a float.
#[cold]
pub(crate) fn not_a_float(datum: &Value) -> Box<Raise> {
    Raise::type_error(datum, known::FLOAT)
}

fn arithmetic(class: Sym, operation: Sym, operands: &[&Value]) -> Box<Raise> {
    Box::new(Raise::Make {
        place: crate::source::Place::NONE,
        class,
        report: None,
        initargs: vec![
            (known::K_OPERATION, operation.into()),
            (
                known::K_OPERANDS,
                Value::list(operands.iter().map(|v| (*v).clone())),
            ),
        ],
    })
}

/// A division by zero.
#[cold]
pub(crate) fn division_by_zero(operation: Sym, operands: &[&Value]) -> Box<Raise> {
    arithmetic(known::DIVISION_BY_ZERO, operation, operands)
}

/// A result too large for its float format.
#[cold]
pub(crate) fn overflow(operation: Sym, operands: &[&Value]) -> Box<Raise> {
    arithmetic(known::FLOATING_POINT_OVERFLOW, operation, operands)
}

/// A float operation without a meaningful result.
#[cold]
pub fn invalid(operation: Sym, operands: &[&Value]) -> Box<Raise> {
    arithmetic(known::FLOATING_POINT_INVALID_OPERATION, operation, operands)
}

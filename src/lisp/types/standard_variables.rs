//! The types of the standard's variables: what reads them could do nothing with other values.

use super::{TypeCheck, typep};
use crate::image::Image;
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;

/// The last of the known symbols that can be such a variable: what comes after is not looked at.
const LAST: Sym = known::PI;

/// Checks a value that a variable is about to get; variables of programs take every value.
///
/// # Errors
///
/// A type error for a variable of the standard that never has such a value.
#[inline(always)]
pub(crate) fn check_value(image: &Image, variable: Sym, value: &Value) -> Result<(), Box<Raise>> {
    if variable.0 > LAST.0 {
        return Ok(());
    }
    check_standard(image, variable, value)
}

#[inline(never)]
fn check_standard(image: &Image, variable: Sym, value: &Value) -> Result<(), Box<Raise>> {
    let Some(specifier) = specifier(variable) else {
        return Ok(());
    };
    match (value, typep(image, value, &specifier)?) {
        (Value::Unbound, _) | (_, TypeCheck::Yes) => Ok(()),
        _ => Err(Raise::type_error(value, specifier)),
    }
}

/// The type of a variable's values; none if they can be everything.
fn specifier(variable: Sym) -> Option<Value> {
    let list = |parts: Vec<Value>| Value::list(parts);
    let optional = |specifier: Value| list(vec![known::OR.into(), known::NULL.into(), specifier]);
    let natural = || list(vec![known::INTEGER.into(), Value::Int(0)]);
    let member = |symbols: &[Sym]| {
        let symbols = symbols.iter().map(|sym| Value::from(*sym));
        list(
            std::iter::once(known::MEMBER.into())
                .chain(symbols)
                .collect(),
        )
    };
    Some(match variable {
        known::V_PACKAGE => known::PACKAGE.into(),
        known::V_STANDARD_OUTPUT
        | known::V_STANDARD_INPUT
        | known::V_ERROR_OUTPUT
        | known::V_TERMINAL_IO
        | known::V_QUERY_IO
        | known::V_DEBUG_IO
        | known::V_TRACE_OUTPUT => known::STREAM.into(),
        known::V_PRINT_BASE | known::V_READ_BASE => {
            list(vec![known::INTEGER.into(), Value::Int(2), Value::Int(36)])
        }
        known::V_PRINT_LENGTH
        | known::V_PRINT_LEVEL
        | known::V_PRINT_LINES
        | known::V_PRINT_RIGHT_MARGIN
        | known::V_PRINT_MISER_WIDTH => optional(natural()),
        known::V_PRINT_CASE => member(&[known::K_UPCASE, known::K_DOWNCASE, known::K_CAPITALIZE]),
        known::V_GENSYM_COUNTER => natural(),
        known::V_READ_DEFAULT_FLOAT_FORMAT => member(&[
            known::SINGLE_FLOAT,
            known::DOUBLE_FLOAT,
            known::SHORT_FLOAT,
            known::LONG_FLOAT,
        ]),
        known::V_READTABLE => known::READTABLE.into(),
        known::V_RANDOM_STATE => known::RANDOM_STATE.into(),
        known::V_FEATURES => known::LIST.into(),
        known::V_MACROEXPAND_HOOK | known::V_DEBUGGER_HOOK => list(vec![
            known::OR.into(),
            known::SYMBOL.into(),
            known::FUNCTION.into(),
        ]),
        _ => return None,
    })
}

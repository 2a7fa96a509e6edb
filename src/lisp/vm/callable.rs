//! Values that designate functions.

use std::rc::Rc;

use crate::image::Image;
use crate::value::Value;
use crate::value::function::{Body, Function};
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::{FunctionCell, Sym};

/// The function that a function designator denotes, if it denotes one.
pub(crate) fn function_of<'a>(image: &'a Image, designator: &'a Value) -> Option<&'a Rc<Function>> {
    match designator {
        Value::Function(function) => Some(function),
        Value::Symbol(sym, ..) => image.function(*sym),
        _ => None,
    }
}

/// Checks that a value designates a function, and replaces a symbol by the function that
/// it names.
pub fn callable(image: &Image, designator: &Value) -> Result<Value, Box<Raise>> {
    match designator {
        Value::Function(_) => Ok(designator.clone()),
        Value::Symbol(sym, ..) => match &image.symbol(*sym).function {
            FunctionCell::Function(function) => Ok(Value::Function(function.clone())),
            _ => Err(Raise::undefined_function(designator.clone())),
        },
        _ => Err(Raise::type_error(
            designator,
            Value::list([
                known::OR.into(),
                known::FUNCTION.into(),
                known::SYMBOL.into(),
            ]),
        )),
    }
}

/// The name of the builtin, if a function value is one.
pub fn builtin_name(function: &Value) -> Option<Sym> {
    match function {
        Value::Function(f) => match &f.body {
            Body::Native(native) => Some(native.name),
            _ => None,
        },
        _ => None,
    }
}

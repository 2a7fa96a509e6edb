//! Macro expansion as a service: `macroexpand` and `macroexpand-1`.

use super::analyze::keep_place;
use super::environment;
use super::shape;
use crate::evaluator::nested;
use crate::guard::look_patiently;
use crate::image::Image;
use crate::value::Value;
use crate::value::raise::Raise;
use crate::value::symbol::FunctionCell;

/// Expands a form once with global macros; `None` if it is not a macro call.
pub fn macroexpand_1(image: &mut Image, form: &Value) -> Result<Option<Value>, Box<Raise>> {
    macroexpand_1_in(image, form, &Value::NIL)
}

/// Expands a form once with the macros of an environment, as passed to a macro function.
pub(crate) fn macroexpand_1_in(
    image: &mut Image,
    form: &Value,
    environment: &Value,
) -> Result<Option<Value>, Box<Raise>> {
    if let Some(expansion) = environment::expand_locally(image, form, environment)? {
        return Ok(expansion);
    }
    match form {
        Value::Symbol(name, ..) => Ok(image.symbol(*name).symbol_macro.clone()),
        Value::Cons(cons) => {
            let Some(name) = cons.car().as_symbol() else {
                return Ok(None);
            };
            let expansion = match &image.symbol(name).function {
                FunctionCell::Macro(function) => {
                    let is_of_library = function.as_deferred().is_some();
                    let function = Value::Function(function.clone());
                    let args = vec![form.clone(), environment.clone()];
                    let expansion = nested::call_nested(image, function, args);
                    expansion.map_err(|raise| match is_of_library {
                        true => shape::explained(image, name, form, raise),
                        false => raise,
                    })?
                }
                FunctionCell::Builtin => {
                    let Some(operator) = image.operator(name) else {
                        return Ok(None);
                    };
                    let Some(expand) = operator.expand else {
                        return Ok(None);
                    };
                    shape::check(image, name, operator.lambda_list, form)?;
                    image.expand_with(expand, form, environment.clone())?
                }
                _ => return Ok(None),
            };
            keep_place(form, &expansion);
            Ok(Some(expansion))
        }
        _ => Ok(None),
    }
}

/// Expands a form until it is not a macro call; also returns whether it was one.
pub fn macroexpand(image: &mut Image, form: &Value) -> Result<(Value, bool), Box<Raise>> {
    macroexpand_in(image, form, &Value::NIL)
}

/// Expands a form until it is not a macro call, with the macros of an environment; also returns
/// whether it was one.
pub(crate) fn macroexpand_in(
    image: &mut Image,
    form: &Value,
    environment: &Value,
) -> Result<(Value, bool), Box<Raise>> {
    let mut form = form.clone();
    let mut expanded = false;
    while let Some(expansion) = macroexpand_1_in(image, &form, environment)? {
        look_patiently();
        form = expansion;
        expanded = true;
    }
    Ok((form, expanded))
}

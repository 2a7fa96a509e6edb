//! Environments: what a macro function can find out about the scope of its call.

use super::scope::{FunctionMeaning, Scope, VariableMeaning};
use crate::evaluator::nested;
use crate::image::Image;
use crate::value::Value;
use crate::value::foreign::{Foreign, PrintContext};
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;

/// The scope of a macro call, as a value.
pub(super) struct Environment(Scope);

impl Environment {
    /// The environment of a scope.
    pub(crate) fn value(scope: &Scope) -> Value {
        Value::foreign(Environment(scope.clone()))
    }
}

impl Foreign for Environment {
    fn type_symbol(&self) -> Sym {
        known::ENVIRONMENT
    }

    fn print(&self, _: &dyn PrintContext, _: bool) -> String {
        "#<ENVIRONMENT>".to_owned()
    }
}

/// What a name of a function means in an environment: a local macro's function, `NIL` for a local
/// function, `None` if the environment does not know the name.
pub(crate) fn local_macro(environment: &Value, name: Sym) -> Option<Value> {
    let Environment(scope) = environment.as_foreign::<Environment>()?;
    scope.function(name, false).map(|meaning| match meaning {
        FunctionMeaning::Macro(function) => Value::Function(function.clone()),
        FunctionMeaning::Local(_) => Value::NIL,
    })
}

/// Is the name that of a lexical variable at the macro call that is being expanded?
pub fn is_visible_variable(image: &Image, name: Sym) -> bool {
    let environment = image.environment.as_foreign::<Environment>();
    environment.is_some_and(|Environment(scope)| scope.variable(name).is_some())
}

/// Expands a form with the local definitions of an environment: the expansion for a local macro,
/// `Some(None)` if the name is that of a local function or variable, `None` if the environment does
/// not know the name.
pub(super) fn expand_locally(
    image: &mut Image,
    form: &Value,
    environment: &Value,
) -> Result<Option<Option<Value>>, Box<Raise>> {
    let Some(Environment(scope)) = environment.as_foreign::<Environment>() else {
        return Ok(None);
    };
    match form {
        Value::Symbol(name, ..) => Ok(match scope.variable(*name) {
            Some(VariableMeaning::SymbolMacro(expansion)) => Some(Some(expansion.clone())),
            Some(_) => Some(None),
            None => None,
        }),
        Value::Cons(cons) => {
            let Some(name) = cons.car().as_symbol() else {
                return Ok(Some(None));
            };
            match scope.function(name, false) {
                Some(FunctionMeaning::Macro(function)) => {
                    let function = Value::Function(function.clone());
                    let args = vec![form.clone(), environment.clone()];
                    nested::call_nested(image, function, args).map(|e| Some(Some(e)))
                }
                Some(FunctionMeaning::Local(_)) => Ok(Some(None)),
                None => Ok(None),
            }
        }
        _ => Ok(None),
    }
}

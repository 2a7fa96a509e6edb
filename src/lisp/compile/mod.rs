//! From forms to code: macro expansion, special forms, resolution of names, emission.
//!
//! Compilation happens in two passes. The first turns a form into [`node::Node`]s: it resolves
//! every name, expands every macro, and finds out which variables are captured by inner functions
//! and which are assigned. The second emits code.

mod analyze;
mod binding_forms;
mod body;
mod compiled_macros;
mod control_macros;
mod define_macros;
pub(crate) mod destructure;
mod emit;
mod environment;
mod exits;
mod expand;
mod function_forms;
mod judged;
pub mod lambda_list;
mod locks;
mod node;
mod operators;
mod quasiquote;
mod scope;
pub mod setf;
mod shape;
mod special_forms;
mod toplevel;
mod unread;

use std::rc::Rc;

use self::scope::Scope;
use super::image::Image;
use super::value::Value;
use super::value::code::Code;
use super::value::function::Function;
use super::value::raise::Raise;

pub(crate) use analyze::keep_place;
pub use emit::is_inlined;
pub use environment::is_visible_variable;
pub(crate) use environment::local_macro;
pub use expand::{macroexpand, macroexpand_1};
pub(crate) use expand::{macroexpand_1_in, macroexpand_in};
pub(crate) use judged::compile_judged;
pub(crate) use locks::guarded_definition;
pub use operators::OPERATORS;
pub(crate) use operators::{SPECIAL_FORMS, SYSTEM_FORMS, SYSTEM_OPERATORS};
pub use toplevel::Parts;
pub(crate) use toplevel::is_executed;

/// Compiles a form at top level into the code of a function without parameters.
pub fn compile_form(image: &mut Image, form: &Value) -> Result<Rc<Code>, Box<Raise>> {
    analyze::Compiler::new(image).compile_toplevel(form)
}

/// Compiles a `lambda` expression into a function without free variables.
pub fn compile_lambda(image: &mut Image, form: &Value) -> Result<Rc<Function>, Box<Raise>> {
    compile_macro_function(image, form, &Scope::default())
}

/// The same, within the definitions of macros in a scope.
fn compile_macro_function(
    image: &mut Image,
    form: &Value,
    scope: &Scope,
) -> Result<Rc<Function>, Box<Raise>> {
    let code = analyze::Compiler::new(image).compile_within(form, scope)?;
    // The code of a `(lambda …)` at top level makes exactly that one closure.
    match code.content().and_then(|content| content.inner.first()) {
        Some((inner, _)) => Ok(Rc::new(Function::closure(inner.clone(), Vec::new()))),
        None => Err(Raise::program("a lambda expression was expected")),
    }
}

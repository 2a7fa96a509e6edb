//! The table entry of a builtin: everything that is known about it in one place. Calls,
//! help, completion, the reference manual and the tests of the examples read the same
//! tables.

use super::image::Image;
use super::value::Value;
use super::value::function::{ControlFn, Function, NativeCall, PureFn};
use super::value::raise::Raise;
use super::value::symbol::Sym;

/// One builtin function.
pub(crate) struct Builtin {
    /// The name in upper case; the package is that of its table unless it says
    /// `PACKAGE:NAME`.
    pub(crate) name: &'static str,
    /// The lambda list as the manual shows it (`"function list &rest lists"`). The
    /// number of arguments that a call may have is read from it.
    pub(crate) lambda_list: &'static str,
    /// One or two sentences.
    pub(crate) doc: &'static str,
    /// Examples: `"(1+ 2) => 3"`; each is run as a test. The right side is what the
    /// prompt prints, several values separated by `" ; "`.
    pub(crate) examples: &'static [&'static str],
    /// The Rust function.
    pub(crate) call: BuiltinCall,
}

/// The Rust function of a builtin.
pub(crate) enum BuiltinCall {
    /// Returns at once.
    Pure(PureFn),
    /// May call, wait or unwind.
    Control(ControlFn),
}

/// A pure builtin.
pub(crate) const fn pure(
    name: &'static str,
    lambda_list: &'static str,
    doc: &'static str,
    examples: &'static [&'static str],
    call: PureFn,
) -> Builtin {
    Builtin {
        name,
        lambda_list,
        doc,
        examples,
        call: BuiltinCall::Pure(call),
    }
}

/// A builtin that may call, wait or unwind.
pub(crate) const fn control(
    name: &'static str,
    lambda_list: &'static str,
    doc: &'static str,
    examples: &'static [&'static str],
    call: ControlFn,
) -> Builtin {
    Builtin {
        name,
        lambda_list,
        doc,
        examples,
        call: BuiltinCall::Control(call),
    }
}

impl Builtin {
    /// The function object, under a name.
    pub(crate) fn function(&self, name: Sym) -> Function {
        let (min, max) = self.arity();
        let call = match self.call {
            BuiltinCall::Pure(f) => NativeCall::Pure(f),
            BuiltinCall::Control(f) => NativeCall::Control(f),
        };
        Function::native(name, min, max, call)
    }

    /// Fewest and most arguments, from the lambda list.
    pub(crate) fn arity(&self) -> (u16, Option<u16>) {
        let mut min = 0;
        let mut optional = 0;
        let mut in_optional = false;
        for word in self.lambda_list.split_whitespace() {
            match word {
                "&optional" => in_optional = true,
                "&rest" | "&key" | "&body" => return (min, None),
                _ if in_optional => optional += 1,
                _ => min += 1,
            }
        }
        (min, Some(min + optional))
    }
}

/// Expands a macro call: maps the whole form to the form that takes its place.
pub(crate) type Expander = fn(&mut Image, &Value) -> Result<Value, Box<Raise>>;

/// A macro written in Rust, or a special operator.
pub(crate) struct Operator {
    /// The name in upper case; the package is that of its table.
    pub(crate) name: &'static str,
    /// Shape of a form, after the operator.
    pub(crate) lambda_list: &'static str,
    /// One or two sentences.
    pub(crate) doc: &'static str,
    /// Examples, as for builtins.
    pub(crate) examples: &'static [&'static str],
    /// How it expands; none for a special operator, which the compiler translates itself.
    pub(crate) expand: Option<Expander>,
}

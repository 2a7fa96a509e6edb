//! The table entry of a builtin: everything that is known about it, in one place. Calls, help,
//! completion, the reference manual and the tests of the examples read the same tables.

use std::rc::Rc;

use super::image::Image;
use super::image::definition::{Definition, Kind};
use super::native::BuiltinCall;
use super::value::Value;
use super::value::function::Function;
use super::value::raise::Raise;
use super::value::symbol::Sym;

/// One builtin function.
pub struct Builtin {
    /// The name in upper case; the package is that of its table.
    pub name: &'static str,
    /// The lambda list as the manual shows it (`"function list &rest lists"`). The
    /// number of arguments that a call may have is read from it.
    pub lambda_list: &'static str,
    /// One or two sentences.
    pub doc: &'static str,
    /// Examples: `"(1+ 2) => 3"`; each is run as a test. The right side is what the
    /// prompt prints, several values separated by `" ; "`.
    pub examples: &'static [&'static str],
    /// The Rust function.
    pub call: BuiltinCall,
}

impl Builtin {
    /// A function object, under a name.
    pub fn function(&self, image: &mut Image, name: Sym) -> Rc<Function> {
        image.native(name, self.arity(), self.call)
    }

    /// Fewest and most arguments, from the lambda list.
    pub fn arity(&self) -> (u16, Option<u16>) {
        arity(self.lambda_list)
    }
}

/// Fewest and most arguments of a function with a lambda list, written without its
/// parentheses.
pub fn arity(lambda_list: &str) -> (u16, Option<u16>) {
    let mut min = 0;
    let mut optional = 0;
    let mut in_optional = false;
    let mut depth = 0_usize;
    for word in lambda_list.split_whitespace() {
        let is_parameter = depth == 0;
        depth += word.matches('(').count();
        depth = depth.saturating_sub(word.matches(')').count());
        match word {
            _ if !is_parameter => {}
            "&optional" => in_optional = true,
            "&rest" | "&key" | "&body" => return (min, None),
            "&aux" => break,
            _ if in_optional => optional += 1,
            _ => min += 1,
        }
    }
    (min, Some(min + optional))
}

/// Expands a macro call: maps the whole form to its expansion.
pub(crate) type Expander = fn(&mut Image, &Value) -> Result<Value, Box<Raise>>;

/// A macro written in Rust, or a special operator.
pub struct Operator {
    /// The name in upper case; the package is that of its table.
    pub name: &'static str,
    /// Shape of a form, after the operator.
    pub lambda_list: &'static str,
    /// One or two sentences.
    pub doc: &'static str,
    /// Examples, as for builtins.
    pub examples: &'static [&'static str],
    /// How it expands; none for a special operator, which the compiler translates itself.
    pub expand: Option<Expander>,
}

/// What the tables say about a name: a function or an operator written in Rust, or a definition
/// written in Lisp.
#[derive(Clone, Copy)]
pub enum Entry {
    /// A function written in Rust.
    Builtin(&'static Builtin),
    /// A macro written in Rust or a special operator.
    Operator(&'static Operator),
    /// A function or macro written in Lisp.
    Library(&'static Definition),
}

impl Entry {
    /// What kind of thing it is.
    pub fn kind(self) -> &'static str {
        match self {
            Entry::Builtin(_) => "function",
            Entry::Operator(operator) if operator.expand.is_none() => "special operator",
            Entry::Library(definition) if definition.kind == Kind::Function => "function",
            Entry::Operator(_) | Entry::Library(_) => "macro",
        }
    }

    /// The lambda list, without its parentheses.
    pub fn lambda_list(self) -> &'static str {
        match self {
            Entry::Builtin(builtin) => builtin.lambda_list,
            Entry::Operator(operator) => operator.lambda_list,
            Entry::Library(definition) => &definition.signature().lambda_list,
        }
    }

    /// One or two sentences.
    pub fn doc(self) -> &'static str {
        match self {
            Entry::Builtin(builtin) => builtin.doc,
            Entry::Operator(operator) => operator.doc,
            Entry::Library(definition) => &definition.signature().doc,
        }
    }

    /// Examples: a form, ` => `, and what the prompt prints.
    pub fn examples(self) -> Vec<&'static str> {
        match self {
            Entry::Builtin(builtin) => builtin.examples.to_vec(),
            Entry::Operator(operator) => operator.examples.to_vec(),
            Entry::Library(definition) => {
                let examples = &definition.signature().examples;
                examples.iter().map(String::as_str).collect()
            }
        }
    }

    /// File and line of a definition in Lisp.
    pub fn location(self) -> Option<String> {
        match self {
            Entry::Library(definition) => Some(definition.location()),
            Entry::Builtin(_) | Entry::Operator(_) => None,
        }
    }
}

//! `#[builtin]` makes a Rust function a builtin of the language, and `builtins!` lists the
//! builtins of a file.
//!
//! ```text
//! /// The character of a code, or `NIL`.
//! ///
//! /// `(code-char 65)` => `#\A`
//! #[builtin]
//! fn code_char(code: usize) -> Option<char> { … }
//!
//! pub(crate) static TABLE: &[Builtin] = builtins![code_char];
//! ```
//!
//! The name is the function's, with `-` for `_`; the lambda list is that of its parameters; the
//! documentation and the examples are its doc comment. The code that the macros make names module
//! `typed` of the language: `use …::typed::{self, builtin, builtins}` brings all into scope.

mod attribute;
mod conversion;
mod doc;
mod expand;
mod lambda_list;
mod parameters;

use proc_macro::TokenStream;
use syn::parse::Parser;
use syn::punctuated::Punctuated;
use syn::{Path, Token};

/// Makes a function a builtin.
///
/// - `#[builtin]`: the name is the function's name, the lambda list that of the parameters.
/// - `#[builtin("NAME")]`: with another name.
/// - `#[builtin("NAME", "lambda list")]`: with another lambda list too; `_` for the name leaves it
///   as it is.
/// - `#[builtin(edit)]`, `#[builtin("NAME", edit)]`, `#[builtin("NAME", "lambda list", edit)]`: the
///   function acts on an owner and changes the world otherwise than the robot could, or opens a door to the
///   outside. The host may refuse such a call.
///
/// The first parameters are what the function works on, all others the arguments of a call:
///
/// | Parameter | Meaning |
/// |---|---|
/// | `image: &mut Image`, `image: &Image` | the image |
/// | `machine: &mut Machine<'_>` | the machine; the function returns a `Step` |
/// | `calls: Calls` | of an `async fn`: it calls functions and waits for them |
/// | `owner: &mut T` with another type | a `T: Owner` outside of the image, on which the function acts |
/// | `x: T` | a required argument |
/// | `x: Option<T>` | an optional argument |
/// | `#[default(value)] x: T` | an optional argument with a default value |
/// | `#[key] x: Option<T>`, `#[key] #[default(value)] x: T` | a keyword argument |
/// | `#[key("2nd-x")] x: Option<T>` | a keyword argument with another name than the parameter |
/// | `#[key] _x: Option<&Value>` | one without a meaning, which a lambda list of the attribute may leave out |
/// | `rest: &[Value]`, `rest: Vec<T>` | all further arguments |
///
/// An argument is converted by `FromValue`, the result by `Into<Value>`.
///
/// A function with an owner is not called by the machine: a call of it is a request, which the
/// owner's `Host` carries out. What it returns is the reply; a `Reply` of the host is passed on as it is.
#[proc_macro_attribute]
pub fn builtin(attribute: TokenStream, item: TokenStream) -> TokenStream {
    expand::builtin(attribute.into(), item.into())
        .unwrap_or_else(syn::Error::into_compile_error)
        .into()
}

/// The table of functions that are builtins: `builtins![car, cdr, pairs::nth]`.
#[proc_macro]
pub fn builtins(functions: TokenStream) -> TokenStream {
    Punctuated::<Path, Token![,]>::parse_terminated
        .parse(functions)
        .map(|functions| expand::builtins(functions.into_iter().collect()))
        .unwrap_or_else(|error| error.into_compile_error())
        .into()
}

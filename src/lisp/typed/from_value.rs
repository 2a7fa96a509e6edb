//! The arguments of builtins as Rust values.

use std::rc::Rc;

use super::keywords;
use crate::image::Image;
use crate::stream::Stream;
use crate::value::Value;
use crate::value::class::{Class, Instance};
use crate::value::cons::Cons;
use crate::value::function::Function;
use crate::value::hash_table::HashTable;
use crate::value::known;
use crate::value::number;
use crate::value::raise::Raise;
use crate::value::sequence::{Sequence, character, index};
use crate::value::string::LispString;
use crate::value::symbol::Sym;

/// A type of arguments.
pub trait FromValue<'a>: Sized {
    /// Is `NIL` a value of the type? If not, it stands for an optional argument that is not given.
    const HAS_NIL: bool = false;

    /// The argument; a type error if the value is none of the type.
    fn from_value(image: &mut Image, value: &'a Value) -> Result<Self, Box<Raise>>;
}

/// A required argument.
#[inline]
pub fn required<'a, T: FromValue<'a>>(
    image: &mut Image,
    value: &'a Value,
) -> Result<T, Box<Raise>> {
    T::from_value(image, value)
}

/// An optional argument or a keyword argument.
#[inline]
pub fn optional<'a, T: FromValue<'a>>(
    image: &mut Image,
    value: Option<&'a Value>,
) -> Result<Option<T>, Box<Raise>> {
    match value {
        Some(value) if T::HAS_NIL || value.is_true() => T::from_value(image, value).map(Some),
        _ => Ok(None),
    }
}

/// All further arguments.
pub fn all<'a, T: FromValue<'a>>(
    image: &mut Image,
    values: &'a [Value],
) -> Result<Vec<T>, Box<Raise>> {
    values
        .iter()
        .map(|value| T::from_value(image, value))
        .collect()
}

/// The name of a keyword argument.
#[derive(Clone, Copy)]
pub struct Keyword {
    name: &'static str,
    /// The symbol, if Rust code names it.
    known: Option<Sym>,
}

/// The keyword argument of a name.
pub const fn keyword(name: &'static str) -> Keyword {
    Keyword {
        name,
        known: known::keyword(name),
    }
}

/// The keyword arguments with these names in `args`, which holds nothing but keyword arguments.
#[inline]
pub fn keys<'a, const N: usize>(
    image: &mut Image,
    args: &'a [Value],
    names: [Keyword; N],
) -> Result<[Option<&'a Value>; N], Box<Raise>> {
    if args.is_empty() {
        return Ok([None; N]);
    }
    let names = names.map(|key| key.known.unwrap_or_else(|| image.keyword(key.name)));
    keywords::given(image, args, names)
}

/// The error of a call with fewer or more arguments than the function has. The machine has counted
/// them by the lambda list, which agrees with the function.
#[cold]
pub fn wrong_count() -> Box<Raise> {
    Raise::program("invalid number of arguments")
}

impl<'a> FromValue<'a> for &'a Value {
    const HAS_NIL: bool = true;

    #[inline]
    fn from_value(_: &mut Image, value: &'a Value) -> Result<Self, Box<Raise>> {
        Ok(value)
    }
}

impl FromValue<'_> for Value {
    const HAS_NIL: bool = true;

    #[inline]
    fn from_value(_: &mut Image, value: &Value) -> Result<Self, Box<Raise>> {
        Ok(value.clone())
    }
}

/// A generalised boolean.
impl FromValue<'_> for bool {
    const HAS_NIL: bool = true;

    #[inline]
    fn from_value(_: &mut Image, value: &Value) -> Result<Self, Box<Raise>> {
        Ok(value.is_true())
    }
}

impl FromValue<'_> for char {
    #[inline]
    fn from_value(_: &mut Image, value: &Value) -> Result<Self, Box<Raise>> {
        character(value)
    }
}

/// An index or a size; larger ones than there are count as the largest.
impl FromValue<'_> for usize {
    #[inline]
    fn from_value(_: &mut Image, value: &Value) -> Result<Self, Box<Raise>> {
        index(value)
    }
}

/// A real number.
impl FromValue<'_> for f64 {
    #[inline]
    fn from_value(_: &mut Image, value: &Value) -> Result<Self, Box<Raise>> {
        number::to_f64(value).ok_or_else(|| Raise::type_error(value, known::REAL))
    }
}

impl FromValue<'_> for Sym {
    const HAS_NIL: bool = true;

    #[inline]
    fn from_value(_: &mut Image, value: &Value) -> Result<Self, Box<Raise>> {
        let symbol = value.as_symbol();
        symbol.ok_or_else(|| Raise::type_error(value, known::SYMBOL))
    }
}

impl FromValue<'_> for Sequence {
    const HAS_NIL: bool = true;

    #[inline]
    fn from_value(_: &mut Image, value: &Value) -> Result<Self, Box<Raise>> {
        Sequence::of(value)
    }
}

impl FromValue<'_> for Rc<Function> {
    #[inline]
    fn from_value(image: &mut Image, value: &Value) -> Result<Self, Box<Raise>> {
        <&Rc<Function>>::from_value(image, value).cloned()
    }
}

/// The text that a string designator denotes: a string, a symbol's name or a character.
pub fn designated(image: &Image, value: &Value) -> Result<String, Box<Raise>> {
    match value {
        Value::Str(s) => Ok(s.text()),
        Value::Symbol(s, ..) => Ok(image.name(*s).to_owned()),
        Value::Char(c) => Ok(c.to_string()),
        _ => Err(Raise::type_error(
            value,
            Value::list([
                known::OR.into(),
                known::STRING.into(),
                known::SYMBOL.into(),
                known::CHARACTER.into(),
            ]),
        )),
    }
}

/// The text that a string designator means.
impl FromValue<'_> for String {
    fn from_value(image: &mut Image, value: &Value) -> Result<Self, Box<Raise>> {
        designated(image, value)
    }
}

/// A type whose values are pointers to objects of a kind.
macro_rules! references {
    ($($variant:ident($object:ty) $type_name:ident;)*) => {
        $(impl<'a> FromValue<'a> for &'a Rc<$object> {
            #[inline]
            fn from_value(_: &mut Image, value: &'a Value) -> Result<Self, Box<Raise>> {
                match value {
                    Value::$variant(object) => Ok(object),
                    _ => Err(Raise::type_error(value, known::$type_name)),
                }
            }
        })*
    };
}

references! {
    Cons(Cons) CONS;
    Str(LispString) STRING;
    Hash(HashTable) HASH_TABLE;
    Stream(Stream) STREAM;
    Function(Function) FUNCTION;
    Class(Class) CLASS;
    Instance(Instance) STANDARD_OBJECT;
}

/// A value that is also `NIL`.
impl<'a, T: FromValue<'a>> FromValue<'a> for Option<T> {
    const HAS_NIL: bool = true;

    #[inline]
    fn from_value(image: &mut Image, value: &'a Value) -> Result<Self, Box<Raise>> {
        optional(image, Some(value))
    }
}

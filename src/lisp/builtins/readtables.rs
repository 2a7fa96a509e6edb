//! Readtables: what the reader does with letters, macro characters and parts of symbols.

use crate::builtin::Builtin;
use crate::image::Image;
use crate::reader::readtable::{LetterCase, Readtable};
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Is the object a readtable?
///
/// `(readtablep 1)` => `NIL`
#[builtin]
fn readtablep(object: &Value) -> bool {
    object.as_foreign::<Readtable>().is_some()
}

/// What the reader does with letters that are not escaped: `:upcase`, `:downcase`, `:preserve` or
/// `:invert`.
///
/// `(readtable-case *readtable*)` => `:UPCASE`
/// `(let ((*readtable* (copy-readtable nil))) (setf (readtable-case *readtable*) :preserve) (symbol-name (read-from-string "Cup")))` => `"Cup"`
#[builtin]
fn readtable_case(readtable: &Value) -> Result<Value> {
    match readtable.as_foreign::<Readtable>() {
        Some(table) => Ok(table.case.get().keyword().into()),
        None => Err(Raise::type_error(readtable, known::READTABLE)),
    }
}

/// Lets a character mean what it means in the standard syntax.
#[builtin("%RESET-MACRO-CHARACTER")]
fn reset_macro_character(image: &mut Image, character: char, readtable: &Value) -> Result<Value> {
    with_readtable(image, Some(readtable), |table| {
        table.macros.borrow_mut().remove(&character);
        table.constituents.borrow_mut().remove(&character);
        Value::T
    })
}

/// Has a character been made a part of symbols like a letter?
#[builtin("%CONSTITUENT-P")]
fn is_constituent(image: &mut Image, character: char, readtable: &Value) -> Result<Value> {
    with_readtable(image, Some(readtable), |table| {
        Value::bool(table.constituents.borrow().contains(&character))
    })
}

/// Lets a character be a part of symbols like a letter.
#[builtin("%SET-CONSTITUENT")]
fn set_constituent(image: &mut Image, character: char, readtable: &Value) -> Result<Value> {
    with_readtable(image, Some(readtable), |table| {
        table.macros.borrow_mut().remove(&character);
        table.constituents.borrow_mut().insert(character);
        Value::T
    })
}

/// The function that a program has set for two characters, or NIL.
///
/// `(system::%dispatch-macro-character #\# #\? nil)` => `NIL`
#[builtin("%DISPATCH-MACRO-CHARACTER")]
fn dispatch_macro_character(
    image: &mut Image,
    character: char,
    sub_character: char,
    readtable: &Value,
) -> Result<Value> {
    let key = (character, sub_character.to_ascii_uppercase());
    with_readtable(image, Some(readtable), |table| {
        let functions = table.dispatch.borrow();
        functions.get(&key).cloned().unwrap_or(Value::NIL)
    })
}

/// Sets the function of two characters.
#[builtin("%SET-DISPATCH-MACRO-CHARACTER")]
fn set_dispatch_macro_character(
    image: &mut Image,
    character: char,
    sub_character: char,
    function: Value,
    readtable: &Value,
) -> Result<Value> {
    let key = (character, sub_character.to_ascii_uppercase());
    with_readtable(image, Some(readtable), |table| {
        table.dispatch.borrow_mut().insert(key, function);
        Value::T
    })
}

/// Sets what the reader does with letters.
#[builtin("READTABLE-CASE", "case readtable")]
fn set_readtable_case(case_value: &Value, readtable: &Value) -> Result<Value> {
    let Some(table) = readtable.as_foreign::<Readtable>() else {
        return Err(Raise::type_error(readtable, known::READTABLE));
    };
    let Some(case) = case_value.as_symbol().and_then(LetterCase::named) else {
        let names = [
            known::K_UPCASE,
            known::K_DOWNCASE,
            known::K_PRESERVE,
            known::K_INVERT,
        ];
        let expected = [known::MEMBER].into_iter().chain(names).map(Value::symbol);
        return Err(Raise::type_error(
            case_value,
            Value::list(expected.collect::<Vec<_>>()),
        ));
    };
    table.case.set(case);
    Ok(case_value.clone())
}

/// Gives `*readtable*` its value.
pub fn define_variables(image: &mut Image) {
    image.define_special(known::V_READTABLE, Value::foreign(Readtable::default()));
}

/// A copy of a readtable; of the standard one if the argument is NIL.
///
/// `(readtablep (copy-readtable nil))` => `T`
#[builtin(_, "&optional readtable to")]
fn copy_readtable(
    image: &mut Image,
    readtable: Option<&Value>,
    to_value: Option<&Value>,
) -> Result<Value> {
    let copy = if readtable.is_some_and(Value::is_nil) {
        Readtable::default()
    } else {
        with_readtable(image, readtable, Readtable::clone)?
    };
    match to_value.filter(|to| to.is_true()) {
        Some(to) => with_readtable(image, Some(to), |table| {
            table.become_like(copy);
            to.clone()
        }),
        None => Ok(Value::foreign(copy)),
    }
}

/// Lets a function of stream and character read what begins with the character.
#[builtin("%SET-MACRO-CHARACTER")]
fn set_macro_character(
    image: &mut Image,
    character: char,
    function: Value,
    #[default(false)] non_terminating_p: bool,
    readtable: Option<&Value>,
) -> Result<Value> {
    let c = character;
    let inside = non_terminating_p;
    with_readtable(image, readtable, |table| {
        let entry = (function, inside);
        table.macros.borrow_mut().insert(c, entry);
        Value::T
    })
}

/// The function that a program has set for a macro character, and whether the character may be in a
/// symbol.
///
/// `(system::%macro-character #\! nil)` => `NIL ; NIL`
#[builtin("%MACRO-CHARACTER")]
fn macro_character(image: &mut Image, character: char, readtable: &Value) -> Result<Value> {
    with_readtable(image, Some(readtable), |table| {
        let (function, inside) = match table.macros.borrow().get(&character) {
            Some((function, inside)) => (function.clone(), *inside),
            None => (Value::NIL, false),
        };
        Value::values(vec![function, Value::bool(inside)])
    })
}

/// Accesses the readtable of an argument, or the current one.
fn with_readtable<R>(
    image: &Image,
    argument: Option<&Value>,
    look: impl FnOnce(&Readtable) -> R,
) -> Result<R> {
    let table = match argument {
        Some(table) if table.is_true() => table,
        _ => image.special(known::V_READTABLE),
    };
    match table.as_foreign::<Readtable>() {
        Some(table) => Ok(look(table)),
        None => Err(Raise::type_error(table, known::READTABLE)),
    }
}

/// Builtins of package `COMMON-LISP`.
pub(crate) static TABLE: &[Builtin] = builtins![copy_readtable, readtablep, readtable_case,];

/// Builtins of package `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![
    macro_character,
    set_macro_character,
    reset_macro_character,
    set_constituent,
    is_constituent,
    dispatch_macro_character,
    set_dispatch_macro_character,
];

/// Places for `setf`; the new value is the first argument.
pub(crate) static SETTERS: &[Builtin] = builtins![set_readtable_case,];

//! Symbols: names, values, functions, fresh symbols.

use super::property_lists::symbol;
use super::strings::string;
use crate::builtin::Builtin;
use crate::image::Image;
use crate::image::locks::Meaning;
use crate::typed::{self, builtin, builtins};
use crate::types::standard_variables::check_value;
use crate::value::Value;
use crate::value::function::{Body, Function};
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::sequence::index;
use crate::value::string::LispString;
use crate::value::symbol::{FunctionCell, Sym, VariableKind};
use crate::vm::callable::callable;
use std::rc::Rc;

type Outcome = Result<Value, Box<Raise>>;

/// Is the object a symbol?
///
/// `(symbolp 'a)` => `T`
#[builtin]
fn symbolp(object: &Value) -> bool {
    object.as_symbol().is_some()
}

/// Is the object a keyword?
///
/// `(keywordp :a)` => `T`
#[builtin]
fn keywordp(image: &mut Image, object: &Value) -> bool {
    object.as_symbol().is_some_and(|s| image.is_keyword(s))
}

/// A symbol's name.
///
/// `(symbol-name 'foo)` => `"FOO"`
#[builtin]
fn symbol_name(image: &mut Image, symbol: Sym) -> Outcome {
    Ok(Value::string(image.name(symbol)))
}

/// A symbol's home package, or `NIL`.
///
/// `(symbol-package 'car)` => `#<PACKAGE "COMMON-LISP">`
#[builtin]
fn symbol_package(image: &mut Image, symbol: Sym) -> Outcome {
    let package = image.symbol(symbol).package;
    Ok(package.map_or(Value::NIL, Value::Package))
}

/// A fresh symbol without a package.
///
/// `(make-symbol "A")` => `#:A`
#[builtin]
fn make_symbol(image: &mut Image, name: &Rc<LispString>) -> Outcome {
    let name = name.text();
    Ok(image.symbols.make_passing(name.into()))
}

/// A fresh symbol of the same name without a package.
///
/// `(copy-symbol 'foo)` => `#:FOO`
#[builtin(_, "symbol &optional copy-properties")]
fn copy_symbol(image: &mut Image, from: Sym, #[default(false)] copy_properties: bool) -> Outcome {
    let name = image.name(from).to_owned();
    let copy = image.symbols.make_passing(name.into());
    if copy_properties {
        let data = image.symbol(from);
        let (value, function, plist, kind) = (
            data.value.clone(),
            data.function.clone(),
            data.plist.clone(),
            data.kind,
        );
        let data = image.symbols.get_mut(symbol(&copy)?);
        data.value = value;
        data.function = function;
        data.plist = plist;
        data.kind = kind;
    }
    Ok(copy)
}

/// A fresh symbol without a package, with a number in its name.
///
/// `(symbol-package (gensym))` => `NIL`
#[builtin(_, "&optional prefix")]
fn gensym(image: &mut Image, prefix_value: Option<&Value>) -> Outcome {
    let name = match prefix_value {
        None => image.fresh_name("G"),
        Some(Value::Str(prefix)) => image.fresh_name(&prefix.text()),
        Some(number) => format!("G{}", index(number)?),
    };
    Ok(image.symbols.make_passing(name.into()))
}

/// A symbol whose name was not taken.
///
/// `(symbolp (gentemp "NEW"))` => `T`
// A fresh symbol of the current package; names are counted from 1 for each prefix.
#[builtin(_, "&optional prefix package")]
fn gentemp(
    image: &mut Image,
    prefix_value: Option<&Value>,
    package_value: Option<&Value>,
) -> Outcome {
    let prefix = match prefix_value {
        Some(prefix) => string(prefix)?.text(),
        None => "T".to_owned(),
    };
    let package = match package_value {
        Some(package) => super::packages::designated(image, package)?,
        None => image.current_package(),
    };
    let mut count = 1_usize;
    loop {
        let name = format!("{prefix}{count}");
        if image.packages.find_symbol(package, &name).is_none() {
            return Ok(image.intern_for_program(package, &name));
        }
        count += 1;
    }
}

/// Has the symbol a value as a global variable?
///
/// `(boundp 'pi)` => `T`
#[builtin]
fn boundp(image: &mut Image, symbol: Sym) -> bool {
    !image.special(symbol).is_unbound()
}

/// The value of a global variable.
///
/// `(symbol-value :a)` => `:A`
#[builtin]
fn symbol_value(image: &mut Image, symbol: Sym) -> Outcome {
    let sym = symbol;
    match image.special(sym) {
        Value::Unbound => Err(Raise::unbound_variable(sym)),
        value => Ok(value.clone()),
    }
}

fn assign(image: &mut Image, sym: Sym, value: &Value) -> Outcome {
    if image.symbol(sym).kind == VariableKind::Constant {
        return Err(Raise::simple(format!(
            "{} is a constant, which cannot be set.",
            image.name(sym)
        )));
    }
    check_value(image, sym, value)?;
    image.set_special(sym, value.clone());
    Ok(value.clone())
}

/// Assigns a global variable.
///
/// `(progn (set 'set-example 6) (symbol-value 'set-example))` => `6`
#[builtin]
fn set(image: &mut Image, symbol: Sym, value: &Value) -> Outcome {
    assign(image, symbol, value)
}

/// Assigns a global variable.
#[builtin("SYMBOL-VALUE")]
fn set_symbol_value(image: &mut Image, value: &Value, symbol: Sym) -> Outcome {
    assign(image, symbol, value)
}

/// Takes a global variable's value away.
///
/// `(progn (set 'unset-example 6) (makunbound 'unset-example) (boundp 'unset-example))` => `NIL`
#[builtin(_, "symbol")]
fn makunbound(image: &mut Image, symbol_value: &Value) -> Outcome {
    assign(image, symbol(symbol_value)?, &Value::Unbound)?;
    Ok(symbol_value.clone())
}

/// Does the form always have the same value?
///
/// `(constantp :a)` => `T`
/// `(constantp 'x)` => `NIL`
// Does a form always have the same value: is it a constant, a quoted object, or something that
// evaluates to itself?
#[builtin]
fn constantp(image: &mut Image, form: &Value, _environment: Option<&Value>) -> bool {
    match form {
        Value::Symbol(sym, ..) => image.symbol(*sym).kind == VariableKind::Constant,
        Value::Cons(cons) => matches!(cons.car(), Value::Symbol(known::QUOTE, ..)),
        _ => true,
    }
}

/// Is the object a function that is not generic? All of these are compiled.
///
/// `(compiled-function-p #'car)` => `T`
#[builtin]
fn compiled_function_p(object: &Value) -> bool {
    matches!(object, Value::Function(f) if !matches!(f.body, Body::Generic(_)))
}

/// A symbol, or the place name in `(setf name)`.
enum FunctionName {
    Plain(Sym),
    Setf(Sym),
}

fn function_name(value: &Value) -> Result<FunctionName, Box<Raise>> {
    if let Value::Symbol(sym, ..) = value {
        return Ok(FunctionName::Plain(*sym));
    }
    let mut parts = value.iter_list();
    let words: Vec<Value> = parts.by_ref().take(3).collect();
    match words.as_slice() {
        [Value::Symbol(known::SETF, ..), Value::Symbol(place, ..)] if parts.rest.is_nil() => {
            Ok(FunctionName::Setf(*place))
        }
        _ => Err(Raise::type_error(value, known::SYMBOL)),
    }
}

/// Names this a function, macro or special operator?
///
/// `(fboundp 'car)` => `T`
#[builtin]
fn fboundp(image: &mut Image, name: &Value) -> Outcome {
    let bound = match function_name(name)? {
        FunctionName::Plain(sym) => !matches!(image.symbol(sym).function, FunctionCell::Unbound),
        FunctionName::Setf(sym) => image.symbol(sym).setf_function.is_some(),
    };
    Ok(Value::bool(bound))
}

/// The function of a name.
///
/// `(funcall (fdefinition 'car) '(1))` => `1`
#[builtin]
fn fdefinition(image: &mut Image, name: &Value) -> Outcome {
    let undefined = || Raise::undefined_function(name.clone());
    match function_name(name)? {
        FunctionName::Plain(sym) => match &image.symbol(sym).function {
            FunctionCell::Function(function) | FunctionCell::Macro(function) => {
                Ok(Value::Function(function.clone()))
            }
            FunctionCell::Unbound => Err(undefined()),
            FunctionCell::Builtin => {
                let function = Function::pure_of(sym, (0, None), (), move |(), image, _| {
                    let name = image.name(sym);
                    Err(Raise::simple(format!(
                        "{name} is a macro or special operator; it cannot be called as a function."
                    )))
                });
                Ok(Value::Function(function))
            }
        },
        FunctionName::Setf(sym) => match &image.symbol(sym).setf_function {
            Some(function) => Ok(Value::Function(function.clone())),
            None => Err(undefined()),
        },
    }
}

/// The function that a symbol names.
///
/// `(funcall (symbol-function 'car) '(1))` => `1`
#[builtin]
fn symbol_function(image: &mut Image, symbol: &Value) -> Outcome {
    if symbol.as_symbol().is_none() {
        return Err(Raise::type_error(symbol, known::SYMBOL));
    }
    fdefinition(image, symbol)
}

/// Sets the function that a symbol names.
#[builtin("SYMBOL-FUNCTION")]
fn set_fdefinition(image: &mut Image, value: &Value, symbol: &Value) -> Outcome {
    let Value::Function(function) = callable(image, value)? else {
        return Err(Raise::type_error(value, known::FUNCTION));
    };
    match function_name(symbol)? {
        FunctionName::Plain(sym) => {
            image.check_lock(sym, Meaning::Function)?;
            image.note_redefined(sym);
            image.set_function(sym, function);
        }
        FunctionName::Setf(sym) => {
            image.check_lock(sym, Meaning::Setter)?;
            image.symbols.get_mut(sym).setf_function = Some(function);
        }
    }
    Ok(value.clone())
}

/// Takes a name's function away.
///
/// `(fmakunbound 'no-such-function)` => `NO-SUCH-FUNCTION`
#[builtin]
fn fmakunbound(image: &mut Image, name: &Value) -> Outcome {
    match function_name(name)? {
        FunctionName::Plain(sym) => {
            image.check_lock(sym, Meaning::Function)?;
            image.forget_defined(sym);
            image.symbols.get_mut(sym).function = FunctionCell::Unbound;
        }
        FunctionName::Setf(sym) => {
            image.check_lock(sym, Meaning::Setter)?;
            image.symbols.get_mut(sym).setf_function = None;
        }
    }
    Ok(name.clone())
}

/// The symbol of a name, made if need be, and how it was accessible.
///
/// `(intern "SVREF")` => `SVREF ; :INHERITED`
#[builtin]
fn intern(image: &mut Image, name: &Rc<LispString>, package: Option<&Value>) -> Outcome {
    let name = name.text();
    let package = super::packages::or_current(image, package)?;
    let found = image.packages.find_symbol(package, &name);
    let symbol = image.intern_for_program(package, &name);
    let status = super::packages::status(found.map(|(_, access)| access));
    Ok(Value::values(vec![symbol, status]))
}

/// The symbol of a name, and how it is accessible, or `NIL`.
///
/// `(find-symbol "CAR" :cl)` => `CAR ; :EXTERNAL`
#[builtin]
fn find_symbol(image: &mut Image, name: &Rc<LispString>, package: Option<&Value>) -> Outcome {
    let name = name.text();
    let package = super::packages::or_current(image, package)?;
    let found = image.packages.find_symbol(package, &name);
    Ok(Value::values(vec![
        found.map_or(Value::NIL, |(sym, _)| image.symbols.value(sym)),
        super::packages::status(found.map(|(_, access)| access)),
    ]))
}

/// Sets the function of a name.
#[builtin("FDEFINITION")]
fn set_fdefinition_builtin(image: &mut Image, value: &Value, symbol: &Value) -> Outcome {
    set_fdefinition(image, value, symbol)
}

/// Symbols.
pub(crate) static TABLE: &[Builtin] = builtins![
    symbolp,
    keywordp,
    symbol_name,
    symbol_package,
    make_symbol,
    copy_symbol,
    gensym,
    gentemp,
    boundp,
    symbol_value,
    set,
    makunbound,
    constantp,
    compiled_function_p,
    fboundp,
    fdefinition,
    symbol_function,
    fmakunbound,
    intern,
    find_symbol,
];

/// Places for `setf`; the new value is the first argument.
pub(crate) static SETTERS: &[Builtin] =
    builtins![set_symbol_value, set_fdefinition, set_fdefinition_builtin,];

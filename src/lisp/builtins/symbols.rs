//! Symbols: names, values, functions, fresh symbols.

use super::property_lists::symbol;
use super::strings::string;
use crate::builtin::{Builtin, pure};
use crate::image::Image;
use crate::value::Value;
use crate::value::function::{Body, Function};
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::sequence::index;
use crate::value::symbol::{FunctionCell, Sym, VariableKind};
use crate::vm::callable::callable;

type Outcome = Result<Value, Box<Raise>>;

fn symbolp(_: &mut Image, args: &[Value]) -> Outcome {
    Ok(Value::bool(args[0].as_symbol().is_some()))
}

fn keywordp(image: &mut Image, args: &[Value]) -> Outcome {
    let is = args[0].as_symbol().is_some_and(|s| image.is_keyword(s));
    Ok(Value::bool(is))
}

fn symbol_name(image: &mut Image, args: &[Value]) -> Outcome {
    Ok(Value::string(image.name(symbol(&args[0])?)))
}

fn symbol_package(image: &mut Image, args: &[Value]) -> Outcome {
    let package = image.symbol(symbol(&args[0])?).package;
    Ok(package.map_or(Value::NIL, Value::Package))
}

fn make_symbol(image: &mut Image, args: &[Value]) -> Outcome {
    let name = string(&args[0])?.text();
    Ok(image.symbols.make_passing(name.into()))
}

fn copy_symbol(image: &mut Image, args: &[Value]) -> Outcome {
    let from = symbol(&args[0])?;
    let name = image.name(from).to_owned();
    let copy = image.symbols.make_passing(name.into());
    if args.get(1).is_some_and(Value::is_true) {
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

fn gensym(image: &mut Image, args: &[Value]) -> Outcome {
    let name = match args.first() {
        None => image.fresh_name("G"),
        Some(Value::Str(prefix)) => image.fresh_name(&prefix.text()),
        Some(number) => format!("G{}", index(number)?),
    };
    Ok(image.symbols.make_passing(name.into()))
}

/// A fresh symbol of the current package; names are counted from 1 for each prefix.
fn gentemp(image: &mut Image, args: &[Value]) -> Outcome {
    let prefix = match args.first() {
        Some(prefix) => string(prefix)?.text(),
        None => "T".to_owned(),
    };
    let package = match args.get(1) {
        Some(package) => super::packages::designated(image, package)?,
        None => image.current_package(),
    };
    let mut count = 1_usize;
    loop {
        let name = format!("{prefix}{count}");
        if image.packages.find_symbol(package, &name).is_none() {
            return Ok(image.intern(package, &name).into());
        }
        count += 1;
    }
}

fn boundp(image: &mut Image, args: &[Value]) -> Outcome {
    let bound = !image.special(symbol(&args[0])?).is_unbound();
    Ok(Value::bool(bound))
}

fn symbol_value(image: &mut Image, args: &[Value]) -> Outcome {
    let sym = symbol(&args[0])?;
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
    image.set_special(sym, value.clone());
    Ok(value.clone())
}

fn set(image: &mut Image, args: &[Value]) -> Outcome {
    assign(image, symbol(&args[0])?, &args[1])
}

fn set_symbol_value(image: &mut Image, args: &[Value]) -> Outcome {
    assign(image, symbol(&args[1])?, &args[0])
}

fn makunbound(image: &mut Image, args: &[Value]) -> Outcome {
    assign(image, symbol(&args[0])?, &Value::Unbound)?;
    Ok(args[0].clone())
}

/// Does a form always have the same value: is it a constant, a quoted object, or something that
/// evaluates to itself?
fn constantp(image: &mut Image, args: &[Value]) -> Outcome {
    let constant = match &args[0] {
        Value::Symbol(sym, ..) => image.symbol(*sym).kind == VariableKind::Constant,
        Value::Cons(cons) => matches!(cons.car(), Value::Symbol(known::QUOTE, ..)),
        _ => true,
    };
    Ok(Value::bool(constant))
}

fn compiled_function_p(_: &mut Image, args: &[Value]) -> Outcome {
    let is_compiled = matches!(&args[0], Value::Function(f) if !matches!(f.body, Body::Generic(_)));
    Ok(Value::bool(is_compiled))
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

fn fboundp(image: &mut Image, args: &[Value]) -> Outcome {
    let bound = match function_name(&args[0])? {
        FunctionName::Plain(sym) => !matches!(image.symbol(sym).function, FunctionCell::Unbound),
        FunctionName::Setf(sym) => image.symbol(sym).setf_function.is_some(),
    };
    Ok(Value::bool(bound))
}

fn fdefinition(image: &mut Image, args: &[Value]) -> Outcome {
    let undefined = || Raise::undefined_function(args[0].clone());
    match function_name(&args[0])? {
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

fn symbol_function(image: &mut Image, args: &[Value]) -> Outcome {
    symbol(&args[0])?;
    fdefinition(image, args)
}

fn set_fdefinition(image: &mut Image, args: &[Value]) -> Outcome {
    let Value::Function(function) = callable(image, &args[0])? else {
        return Err(Raise::type_error(&args[0], known::FUNCTION));
    };
    match function_name(&args[1])? {
        FunctionName::Plain(sym) => image.set_function(sym, function),
        FunctionName::Setf(sym) => image.symbols.get_mut(sym).setf_function = Some(function),
    }
    Ok(args[0].clone())
}

fn fmakunbound(image: &mut Image, args: &[Value]) -> Outcome {
    match function_name(&args[0])? {
        FunctionName::Plain(sym) => image.symbols.get_mut(sym).function = FunctionCell::Unbound,
        FunctionName::Setf(sym) => image.symbols.get_mut(sym).setf_function = None,
    }
    Ok(args[0].clone())
}

fn intern(image: &mut Image, args: &[Value]) -> Outcome {
    let name = string(&args[0])?.text();
    let package = super::packages::or_current(image, args.get(1))?;
    let found = image.packages.find_symbol(package, &name);
    let sym = match found {
        Some((sym, _)) => sym,
        None => image.intern(package, &name),
    };
    let status = super::packages::status(found.map(|(_, access)| access));
    Ok(Value::values(vec![sym.into(), status]))
}

fn find_symbol(image: &mut Image, args: &[Value]) -> Outcome {
    let name = string(&args[0])?.text();
    let package = super::packages::or_current(image, args.get(1))?;
    let found = image.packages.find_symbol(package, &name);
    Ok(Value::values(vec![
        found.map_or(Value::NIL, |(sym, _)| sym.into()),
        super::packages::status(found.map(|(_, access)| access)),
    ]))
}

/// Symbols.
pub static TABLE: &[Builtin] = &[
    pure(
        "SYMBOLP",
        "object",
        "Is the object a symbol?",
        &["(symbolp 'a) => T"],
        symbolp,
    ),
    pure(
        "KEYWORDP",
        "object",
        "Is the object a keyword?",
        &["(keywordp :a) => T"],
        keywordp,
    ),
    pure(
        "SYMBOL-NAME",
        "symbol",
        "A symbol's name.",
        &["(symbol-name 'foo) => \"FOO\""],
        symbol_name,
    ),
    pure(
        "SYMBOL-PACKAGE",
        "symbol",
        "A symbol's home package, or `NIL`.",
        &["(symbol-package 'car) => #<PACKAGE \"COMMON-LISP\">"],
        symbol_package,
    ),
    pure(
        "MAKE-SYMBOL",
        "name",
        "A fresh symbol without a package.",
        &["(make-symbol \"A\") => #:A"],
        make_symbol,
    ),
    pure(
        "COPY-SYMBOL",
        "symbol &optional copy-properties",
        "A fresh symbol of the same name without a package.",
        &["(copy-symbol 'foo) => #:FOO"],
        copy_symbol,
    ),
    pure(
        "GENSYM",
        "&optional prefix",
        "A fresh symbol without a package, with a number in its name.",
        &["(symbol-package (gensym)) => NIL"],
        gensym,
    ),
    pure(
        "GENTEMP",
        "&optional prefix package",
        "A symbol whose name was not taken.",
        &["(symbolp (gentemp \"NEW\")) => T"],
        gentemp,
    ),
    pure(
        "BOUNDP",
        "symbol",
        "Has the symbol a value as a global variable?",
        &["(boundp 'pi) => T"],
        boundp,
    ),
    pure(
        "SYMBOL-VALUE",
        "symbol",
        "The value of a global variable.",
        &["(symbol-value :a) => :A"],
        symbol_value,
    ),
    pure(
        "SET",
        "symbol value",
        "Assigns a global variable.",
        &["(progn (set 'set-example 6) (symbol-value 'set-example)) => 6"],
        set,
    ),
    pure(
        "MAKUNBOUND",
        "symbol",
        "Takes a global variable's value away.",
        &[
            "(progn (set 'unset-example 6) (makunbound 'unset-example) (boundp 'unset-example)) => NIL",
        ],
        makunbound,
    ),
    pure(
        "CONSTANTP",
        "form &optional environment",
        "Does the form always have the same value?",
        &["(constantp :a) => T", "(constantp 'x) => NIL"],
        constantp,
    ),
    pure(
        "COMPILED-FUNCTION-P",
        "object",
        "Is the object a function that is not generic? All of these are compiled.",
        &["(compiled-function-p #'car) => T"],
        compiled_function_p,
    ),
    pure(
        "FBOUNDP",
        "name",
        "Names this a function, macro or special operator?",
        &["(fboundp 'car) => T"],
        fboundp,
    ),
    pure(
        "FDEFINITION",
        "name",
        "The function of a name.",
        &["(funcall (fdefinition 'car) '(1)) => 1"],
        fdefinition,
    ),
    pure(
        "SYMBOL-FUNCTION",
        "symbol",
        "The function that a symbol names.",
        &["(funcall (symbol-function 'car) '(1)) => 1"],
        symbol_function,
    ),
    pure(
        "FMAKUNBOUND",
        "name",
        "Takes a name's function away.",
        &["(fmakunbound 'no-such-function) => NO-SUCH-FUNCTION"],
        fmakunbound,
    ),
    pure(
        "INTERN",
        "name &optional package",
        "The symbol of a name, made if need be, and how it was accessible.",
        &["(intern \"SVREF\") => SVREF ; :INHERITED"],
        intern,
    ),
    pure(
        "FIND-SYMBOL",
        "name &optional package",
        "The symbol of a name, and how it is accessible, or `NIL`.",
        &["(find-symbol \"CAR\" :cl) => CAR ; :EXTERNAL"],
        find_symbol,
    ),
];

/// Places for `setf`; the new value is the first argument.
pub static SETTERS: &[Builtin] = &[
    pure(
        "SYMBOL-VALUE",
        "value symbol",
        "Assigns a global variable.",
        &[],
        set_symbol_value,
    ),
    pure(
        "SYMBOL-FUNCTION",
        "value symbol",
        "Sets the function that a symbol names.",
        &[],
        set_fdefinition,
    ),
    pure(
        "FDEFINITION",
        "value name",
        "Sets the function of a name.",
        &[],
        set_fdefinition,
    ),
];

//! What the defining macros expand into.

use std::rc::Rc;

use crate::builtin::{Builtin, pure};
use crate::compile::{keep_place, setf};
use crate::image::Image;
use crate::image::setf_expander::SetfExpander;
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::{FunctionCell, Sym, VariableKind};

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `SYSTEM`.
pub static SYSTEM_TABLE: &[Builtin] = &[
    pure(
        "AT-PLACE-OF",
        "form expansion",
        "The expansion, which counts as standing where the form stands in its file.",
        &[],
        |_, args| {
            keep_place(&args[0], &args[1]);
            Ok(args[1].clone())
        },
    ),
    pure(
        "DEFINE-FUNCTION",
        "name function",
        "Makes a function the global one of its name.",
        &["(system:define-function 'one (lambda () 1)) => ONE"],
        define_function,
    ),
    pure(
        "DEFINE-MACRO",
        "name function lambda-list documentation",
        "Makes a function the expander of a macro.",
        &[],
        define_macro,
    ),
    pure(
        "DEFINE-PARAMETER",
        "name value documentation",
        "Makes a variable special and assigns it.",
        &["(system:define-parameter '*p* 1 nil) => *P*"],
        define_parameter,
    ),
    pure(
        "DEFINE-VARIABLE",
        "name &optional documentation",
        "Makes a variable special.",
        &["(system:define-variable '*v*) => *V*"],
        define_variable,
    ),
    pure(
        "DEFINE-CONSTANT",
        "name value",
        "Makes a variable constant.",
        &["(system:define-constant '+c+ 1) => +C+"],
        define_constant,
    ),
    pure(
        "SET-SYMBOL-MACRO",
        "name expansion",
        "Lets a symbol stand for a form.",
        &[],
        set_symbol_macro,
    ),
    pure(
        "DEFINE-SETF-UPDATE",
        "name update",
        "Short DEFSETF.",
        &[],
        define_setf_update,
    ),
    pure(
        "DEFINE-SETF-LONG",
        "name function stores",
        "Long DEFSETF.",
        &[],
        define_setf_long,
    ),
    pure(
        "SET-SETF-EXPANDER",
        "name function",
        "DEFINE-SETF-EXPANDER.",
        &[],
        set_setf_expander,
    ),
    pure(
        "MODIFY-PLACE",
        "place function arguments environment",
        "The form that sets a place to a function of it and of forms.",
        &[],
        modify_place,
    ),
];

/// Builtins of package `COMMON-LISP`.
pub static TABLE: &[Builtin] = &[
    pure(
        "PROCLAIM",
        "specifier",
        "A global declaration.",
        &["(proclaim '(special *proclaimed*)) => ; No value"],
        proclaim,
    ),
    pure(
        "GET-SETF-EXPANSION",
        "place &optional environment",
        "How to read and set a place: temporary variables, their forms, variables for the new values, the form that stores, the form that reads.",
        &["(fifth (multiple-value-list (get-setf-expansion 'x))) => X"],
        get_setf_expansion,
    ),
];

fn symbol(value: &Value) -> Result<Sym> {
    value
        .as_symbol()
        .ok_or_else(|| Raise::type_error(value, known::SYMBOL))
}

fn function(value: &Value) -> Result<Rc<crate::value::function::Function>> {
    match value {
        Value::Function(f) => Ok(f.clone()),
        other => Err(Raise::type_error(other, known::FUNCTION)),
    }
}

fn define_function(image: &mut Image, args: &[Value]) -> Result<Value> {
    let new = function(&args[1])?;
    match args[0].as_symbol() {
        Some(name) => {
            let is_of_language = match &image.symbol(name).function {
                FunctionCell::Builtin => true,
                FunctionCell::Macro(function) => function.as_deferred().is_some(),
                FunctionCell::Function(_) | FunctionCell::Unbound => false,
            };
            if is_of_language {
                return Err(Raise::program(format!(
                    "{} is a special operator or macro of the language and cannot be redefined.",
                    image.name(name)
                )));
            }
            image.set_function(name, new);
            image.symbols.get_mut(name).function_doc = None;
        }
        None => {
            let name = symbol(&args[0].cdr_or_nil().car_or_nil())?;
            image.symbols.get_mut(name).setf_function = Some(new);
        }
    }
    Ok(args[0].clone())
}

fn define_macro(image: &mut Image, args: &[Value]) -> Result<Value> {
    let name = symbol(&args[0])?;
    let expander = function(&args[1])?;
    let data = image.symbols.get_mut(name);
    data.function = FunctionCell::Macro(expander);
    data.function_doc = None;
    Ok(args[0].clone())
}

fn define_parameter(image: &mut Image, args: &[Value]) -> Result<Value> {
    let name = symbol(&args[0])?;
    check_not_constant(image, name)?;
    image.define_special(name, args[1].clone());
    image.symbols.get_mut(name).variable_doc = args[2].as_text().map(Into::into);
    Ok(args[0].clone())
}

fn check_not_constant(image: &Image, name: Sym) -> Result<()> {
    if image.symbol(name).kind == VariableKind::Constant {
        return Err(Raise::program(format!(
            "{} is a constant and cannot be made a variable.",
            image.name(name)
        )));
    }
    Ok(())
}

fn define_variable(image: &mut Image, args: &[Value]) -> Result<Value> {
    let name = symbol(&args[0])?;
    check_not_constant(image, name)?;
    let data = image.symbols.get_mut(name);
    data.kind = VariableKind::Special;
    if let Some(doc) = args.get(1).and_then(Value::as_text) {
        data.variable_doc = Some(doc.into());
    }
    Ok(args[0].clone())
}

fn define_constant(image: &mut Image, args: &[Value]) -> Result<Value> {
    image.define_constant(symbol(&args[0])?, args[1].clone());
    Ok(args[0].clone())
}

fn set_symbol_macro(image: &mut Image, args: &[Value]) -> Result<Value> {
    image.symbols.get_mut(symbol(&args[0])?).symbol_macro = Some(args[1].clone());
    Ok(args[0].clone())
}

fn define_setf_update(image: &mut Image, args: &[Value]) -> Result<Value> {
    let expander = SetfExpander::Update(symbol(&args[1])?);
    image.setf_expanders.insert(symbol(&args[0])?, expander);
    Ok(args[0].clone())
}

fn define_setf_long(image: &mut Image, args: &[Value]) -> Result<Value> {
    let count = match args[2] {
        Value::Int(n) => usize::try_from(n).unwrap_or(0),
        _ => 0,
    };
    let expander = SetfExpander::Long(args[1].clone(), count);
    image.setf_expanders.insert(symbol(&args[0])?, expander);
    Ok(args[0].clone())
}

fn set_setf_expander(image: &mut Image, args: &[Value]) -> Result<Value> {
    let expander = SetfExpander::Expander(args[1].clone());
    image.setf_expanders.insert(symbol(&args[0])?, expander);
    Ok(args[0].clone())
}

fn get_setf_expansion(image: &mut Image, args: &[Value]) -> Result<Value> {
    let environment = args.get(1).cloned().unwrap_or(Value::NIL);
    let outside = std::mem::replace(&mut image.environment, environment);
    let expansion = setf::expansion(image, &args[0]);
    image.environment = outside;
    let expansion = expansion?;
    Ok(Value::values(vec![
        Value::list(expansion.temps),
        Value::list(expansion.values),
        Value::list(expansion.stores),
        expansion.setter,
        expansion.getter,
    ]))
}

fn modify_place(image: &mut Image, args: &[Value]) -> Result<Value> {
    let function = args[1].clone();
    let (mut operands, mut arguments) = (Vec::new(), Vec::new());
    let has_effects = args[2]
        .iter_list()
        .any(|form| matches!(form, Value::Cons(_)));
    for form in args[2].iter_list() {
        let (bound, argument) = setf::operand(image, "ARG", form, has_effects);
        operands.extend(bound);
        arguments.push(argument);
    }
    let outside = std::mem::replace(&mut image.environment, args[3].clone());
    let form = setf::modify(image, &args[0], None, operands, |_, getter| {
        Value::cons(function, Value::cons(getter, Value::list(arguments)))
    });
    image.environment = outside;
    form
}

fn proclaim(image: &mut Image, args: &[Value]) -> Result<Value> {
    if args[0].list_to_vec().is_none() {
        return Err(Raise::type_error(&args[0], known::LIST));
    }
    if args[0].car_or_nil().as_symbol() == Some(known::SPECIAL) {
        for name in args[0].cdr_or_nil().iter_list() {
            let name = symbol(&name)?;
            check_not_constant(image, name)?;
            image.symbols.get_mut(name).kind = VariableKind::Special;
        }
    }
    Ok(Value::values(Vec::new()))
}

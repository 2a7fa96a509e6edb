//! What the defining macros expand into.

use std::rc::Rc;

use crate::lisp::builtin::Builtin;
use crate::lisp::compile::{keep_place, setf};
use crate::lisp::image::Image;
use crate::lisp::image::setf_expander::SetfExpander;
use crate::lisp::value::Value;
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;
use crate::lisp::value::symbol::{FunctionCell, Sym, VariableKind};
use crate::lisp::{builtin, builtins};

type Result<T> = std::result::Result<T, Box<Raise>>;

/// The expansion, which counts as standing where the form stands in its file.
#[builtin(_, "form expansion")]
fn at_place_of(args: &[Value]) -> Result<Value> {
    keep_place(&args[0], &args[1]);
    Ok(args[1].clone())
}

fn symbol(value: &Value) -> Result<Sym> {
    value
        .as_symbol()
        .ok_or_else(|| Raise::type_error(value, known::SYMBOL))
}

fn function(value: &Value) -> Result<Rc<crate::lisp::value::function::Function>> {
    match value {
        Value::Function(f) => Ok(f.clone()),
        other => Err(Raise::type_error(other, known::FUNCTION)),
    }
}

/// Makes a function the global one of its name.
///
/// `(system:define-function 'one (lambda () 1))` => `ONE`
#[builtin(_, "name function")]
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

/// Makes a function the expander of a macro.
#[builtin(_, "name function lambda-list documentation")]
fn define_macro(image: &mut Image, args: &[Value]) -> Result<Value> {
    let name = symbol(&args[0])?;
    let expander = function(&args[1])?;
    let data = image.symbols.get_mut(name);
    data.function = FunctionCell::Macro(expander);
    data.function_doc = None;
    Ok(args[0].clone())
}

/// Makes a variable special and assigns it.
///
/// `(system:define-parameter '*p* 1 nil)` => `*P*`
#[builtin(_, "name value documentation")]
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

/// Makes a variable special.
///
/// `(system:define-variable '*v*)` => `*V*`
#[builtin(_, "name &optional documentation")]
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

/// Makes a variable constant.
///
/// `(system:define-constant '+c+ 1)` => `+C+`
#[builtin(_, "name value")]
fn define_constant(image: &mut Image, args: &[Value]) -> Result<Value> {
    image.define_constant(symbol(&args[0])?, args[1].clone());
    Ok(args[0].clone())
}

/// Lets a symbol stand for a form.
#[builtin(_, "name expansion")]
fn set_symbol_macro(image: &mut Image, args: &[Value]) -> Result<Value> {
    image.symbols.get_mut(symbol(&args[0])?).symbol_macro = Some(args[1].clone());
    Ok(args[0].clone())
}

/// Short DEFSETF.
#[builtin(_, "name update")]
fn define_setf_update(image: &mut Image, args: &[Value]) -> Result<Value> {
    let expander = SetfExpander::Update(symbol(&args[1])?);
    image.setf_expanders.insert(symbol(&args[0])?, expander);
    Ok(args[0].clone())
}

/// Long DEFSETF.
#[builtin(_, "name function stores")]
fn define_setf_long(image: &mut Image, args: &[Value]) -> Result<Value> {
    let count = match args[2] {
        Value::Int(n) => usize::try_from(n).unwrap_or(0),
        _ => 0,
    };
    let expander = SetfExpander::Long(args[1].clone(), count);
    image.setf_expanders.insert(symbol(&args[0])?, expander);
    Ok(args[0].clone())
}

/// DEFINE-SETF-EXPANDER.
#[builtin(_, "name function")]
fn set_setf_expander(image: &mut Image, args: &[Value]) -> Result<Value> {
    let expander = SetfExpander::Expander(args[1].clone());
    image.setf_expanders.insert(symbol(&args[0])?, expander);
    Ok(args[0].clone())
}

/// How to read and set a place: temporary variables, their forms, variables for the new values, the
/// form that stores, the form that reads.
///
/// `(fifth (multiple-value-list (get-setf-expansion 'x)))` => `X`
#[builtin(_, "place &optional environment")]
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

/// The form that sets a place to a function of it and of forms.
#[builtin(_, "place function arguments environment")]
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

/// A global declaration.
///
/// `(proclaim '(special *proclaimed*))` => `; No value`
#[builtin(_, "specifier")]
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

/// Builtins of package `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![
    at_place_of,
    define_function,
    define_macro,
    define_parameter,
    define_variable,
    define_constant,
    set_symbol_macro,
    define_setf_update,
    define_setf_long,
    set_setf_expander,
    modify_place,
];

/// Builtins of package `COMMON-LISP`.
pub(crate) static TABLE: &[Builtin] = builtins![proclaim, get_setf_expansion,];

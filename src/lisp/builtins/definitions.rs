//! What the defining macros expand into.

use std::rc::Rc;

use crate::builtin::Builtin;
use crate::compile::{keep_place, setf};
use crate::image::Image;
use crate::image::locks::Meaning;
use crate::image::setf_expander::SetfExpander;
use crate::source::Place;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::function::Function;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::{FunctionCell, Sym, VariableKind};

type Result<T> = std::result::Result<T, Box<Raise>>;

/// The expansion, which counts as standing where the form stands in its file.
#[builtin]
fn at_place_of(form: &Value, expansion: &Value) -> Result<Value> {
    keep_place(form, expansion);
    Ok(expansion.clone())
}

fn symbol(value: &Value) -> Result<Sym> {
    value
        .as_symbol()
        .ok_or_else(|| Raise::type_error(value, known::SYMBOL))
}

/// Makes a function the global one of its name.
///
/// `(system:define-function 'one (lambda () 1))` => `ONE`
#[builtin(_, "name function")]
fn define_function(image: &mut Image, name_value: &Value, new: Rc<Function>) -> Result<Value> {
    match name_value.as_symbol() {
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
            image.check_lock(name, Meaning::Function)?;
            image.note_redefined(name);
            image.set_function(name, new);
            image.symbols.get_mut(name).function_doc = None;
        }
        None => {
            let name = symbol(&name_value.cdr_or_nil().car_or_nil())?;
            image.check_lock(name, Meaning::Setter)?;
            image.symbols.get_mut(name).setf_function = Some(new);
        }
    }
    Ok(name_value.clone())
}

/// Makes a function the expander of a macro.
#[builtin(_, "name function lambda-list documentation")]
fn define_macro(
    image: &mut Image,
    name_value: &Value,
    function: Rc<Function>,
    _lambda_list: &Value,
    _documentation: &Value,
) -> Result<Value> {
    let name = symbol(name_value)?;
    image.check_lock(name, Meaning::Function)?;
    image.note_redefined(name);
    let expander = function;
    let data = image.symbols.get_mut(name);
    data.function = FunctionCell::Macro(expander);
    data.function_doc = None;
    Ok(name_value.clone())
}

/// Makes a variable special and assigns it.
///
/// `(system:define-parameter '*p* 1 nil)` => `*P*`
#[builtin(_, "name value documentation")]
fn define_parameter(
    image: &mut Image,
    name_value: &Value,
    value: Value,
    documentation: &Value,
) -> Result<Value> {
    let name = symbol(name_value)?;
    check_not_constant(image, name)?;
    image.check_lock(name, Meaning::Variable)?;
    image.define_special(name, value);
    image.symbols.get_mut(name).variable_doc = documentation.as_text().map(Into::into);
    Ok(name_value.clone())
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
fn define_variable(
    image: &mut Image,
    name_value: &Value,
    documentation: Option<&Value>,
) -> Result<Value> {
    let name = symbol(name_value)?;
    check_not_constant(image, name)?;
    image.check_lock(name, Meaning::Variable)?;
    let data = image.symbols.get_mut(name);
    data.kind = VariableKind::Special;
    if let Some(doc) = documentation.and_then(Value::as_text) {
        data.variable_doc = Some(doc.into());
    }
    Ok(name_value.clone())
}

/// Makes a variable constant.
///
/// `(system:define-constant '+c+ 1)` => `+C+`
#[builtin]
fn define_constant(image: &mut Image, name: &Value, value: Value) -> Result<Value> {
    let sym = symbol(name)?;
    image.check_lock(sym, Meaning::Variable)?;
    image.define_constant(sym, value);
    Ok(name.clone())
}

/// What there is to tell of the definition of a function: where the same text defines it before and
/// where it does now, or NIL for both, and whether it redefines what is built in.
#[builtin("%NOTE-DEFINITION")]
fn note_definition(image: &mut Image, name: Sym, place: usize) -> Value {
    let here = Place(u32::try_from(place).unwrap_or_default());
    let is_open = image.is_open(name);
    let before = match image.sources.is_of_program(here) {
        true => image.note_defined(name, here),
        false => None,
    };
    let shown = |place: Option<Place>| {
        let location = place.and_then(|place| image.sources.locate(place));
        location.map_or(Value::NIL, |location| Value::string(location.to_string()))
    };
    Value::list([
        shown(before),
        shown(before.map(|_| here)),
        Value::bool(is_open),
    ])
}

/// Lets a symbol stand for a form.
#[builtin]
fn set_symbol_macro(image: &mut Image, name: &Value, expansion: Value) -> Result<Value> {
    image.check_lock(symbol(name)?, Meaning::Variable)?;
    image.symbols.get_mut(symbol(name)?).symbol_macro = Some(expansion);
    Ok(name.clone())
}

/// Short DEFSETF.
#[builtin]
fn define_setf_update(image: &mut Image, name: &Value, update: Sym) -> Result<Value> {
    let expander = SetfExpander::Update(update);
    image.check_lock(symbol(name)?, Meaning::Setter)?;
    image.setf_expanders.insert(symbol(name)?, expander);
    Ok(name.clone())
}

/// Long DEFSETF.
#[builtin]
fn define_setf_long(
    image: &mut Image,
    name: &Value,
    function: Value,
    stores: &Value,
) -> Result<Value> {
    let count = match stores {
        Value::Int(n) => usize::try_from(*n).unwrap_or(0),
        _ => 0,
    };
    let expander = SetfExpander::Long(function, count);
    image.check_lock(symbol(name)?, Meaning::Setter)?;
    image.setf_expanders.insert(symbol(name)?, expander);
    Ok(name.clone())
}

/// DEFINE-SETF-EXPANDER.
#[builtin]
fn set_setf_expander(image: &mut Image, name: &Value, function: Value) -> Result<Value> {
    let expander = SetfExpander::Expander(function);
    image.check_lock(symbol(name)?, Meaning::Setter)?;
    image.setf_expanders.insert(symbol(name)?, expander);
    Ok(name.clone())
}

/// How to read and set a place: temporary variables, their forms, variables for the new values, the
/// form that stores, the form that reads.
///
/// `(fifth (multiple-value-list (get-setf-expansion 'x)))` => `X`
#[builtin]
fn get_setf_expansion(
    image: &mut Image,
    place: &Value,
    environment: Option<&Value>,
) -> Result<Value> {
    let environment = environment.cloned().unwrap_or(Value::NIL);
    let outside = std::mem::replace(&mut image.environment, environment);
    let expansion = setf::expansion(image, place);
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
fn modify_place(
    image: &mut Image,
    place: &Value,
    function: Value,
    arguments_value: &Value,
    environment: Value,
) -> Result<Value> {
    let (mut operands, mut arguments) = (Vec::new(), Vec::new());
    let has_effects = arguments_value
        .iter_list()
        .any(|form| matches!(form, Value::Cons(_)));
    for form in arguments_value.iter_list() {
        let (bound, argument) = setf::operand(image, "ARG", form, has_effects);
        operands.extend(bound);
        arguments.push(argument);
    }
    let outside = std::mem::replace(&mut image.environment, environment);
    let form = setf::modify(image, place, None, operands, |_, getter| {
        Value::cons(function, Value::cons(getter, Value::list(arguments)))
    });
    image.environment = outside;
    form
}

/// A global declaration.
///
/// `(proclaim '(special *proclaimed*))` => `; No value`
#[builtin]
fn proclaim(image: &mut Image, specifier: &Value) -> Result<Value> {
    if specifier.list_to_vec().is_none() {
        return Err(Raise::type_error(specifier, known::LIST));
    }
    if specifier.car_or_nil().as_symbol() == Some(known::SPECIAL) {
        for name in specifier.cdr_or_nil().iter_list() {
            let name = symbol(&name)?;
            check_not_constant(image, name)?;
            image.check_lock(name, Meaning::Variable)?;
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
    note_definition,
    set_symbol_macro,
    define_setf_update,
    define_setf_long,
    set_setf_expander,
    modify_place,
];

/// Builtins of package `COMMON-LISP`.
pub(crate) static TABLE: &[Builtin] = builtins![proclaim, get_setf_expansion,];

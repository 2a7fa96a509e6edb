//! `documentation`: the texts that definitions carry.

use std::rc::Rc;

use crate::builtin::{Builtin, Entry};
use crate::image::Image;
use crate::library::definition_of;
use crate::object::method::MethodObject;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::function::{Body, Function};
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::{FunctionCell, Sym};

/// The documentation of an object: of a name as FUNCTION, VARIABLE, TYPE or STRUCTURE, or of a
/// function, class or method.
///
/// `(progn (defun twice (x) "Doubles." (* 2 x)) (documentation 'twice 'function))` => `"Doubles."`
/// `(progn (defparameter *speed* 1 "In m/s.") (documentation '*speed* 'variable))` => `"In m/s."`
#[builtin]
fn documentation(image: &mut Image, object: &Value, doc_type: &Value) -> Result<Value, Box<Raise>> {
    let kind = doc_type.as_symbol();
    let text = match (object, kind) {
        (Value::Symbol(name, ..), Some(known::VARIABLE)) => {
            image.symbol(*name).variable_doc.clone()
        }
        (Value::Symbol(name, ..), Some(known::TYPE | known::STRUCTURE)) => {
            match image.types.get(name) {
                Some(expander) => of_function(image, expander),
                None => image.class(*name).and_then(|c| c.doc.borrow().clone()),
            }
        }
        (Value::Symbol(name, ..), Some(known::FUNCTION | known::SETF)) => of_name(image, *name),
        (Value::Cons(_), Some(known::FUNCTION)) => image
            .named_function(object)
            .and_then(|f| of_function(image, &f)),
        (Value::Function(function), _) => match name_of(image, function) {
            Some(name) => of_name(image, name),
            None => of_function(image, function),
        },
        (Value::Class(class), _) => class.doc.borrow().clone(),
        (other, _) => other
            .as_foreign::<MethodObject>()
            .and_then(|method| method.0.doc.borrow().clone()),
    };
    Ok(text.map_or(Value::NIL, |text| Value::string(text.as_ref())))
}

/// The documentation of what a name means as a function.
fn of_name(image: &Image, name: Sym) -> Option<Rc<str>> {
    if let Some(text) = &image.symbol(name).function_doc {
        return Some(text.clone());
    }
    match &image.symbol(name).function {
        FunctionCell::Function(function) | FunctionCell::Macro(function) => {
            of_function(image, function)
        }
        FunctionCell::Builtin => image.entry(name).map(|entry| entry.doc().into()),
        FunctionCell::Unbound => None,
    }
}

/// The symbol whose function or macro a function is, if that is its name.
fn name_of(image: &Image, function: &Rc<Function>) -> Option<Sym> {
    let name = match &function.body {
        Body::Closure { code, .. } => code.name.shown().as_symbol()?,
        Body::Native(native) => native.name,
        Body::Generic(_) | Body::Deferred(_) => return None,
    };
    match &image.symbol(name).function {
        FunctionCell::Function(own) | FunctionCell::Macro(own) => {
            Rc::ptr_eq(own, function).then_some(name)
        }
        FunctionCell::Builtin | FunctionCell::Unbound => None,
    }
}

/// Keeps the documentation of a function that is generic or has a name. That of others is discarded.
fn document_function(image: &mut Image, function: &Rc<Function>, text: Option<Rc<str>>) {
    if let Some(generic) = function.as_generic() {
        *generic.doc.borrow_mut() = text;
    } else if let Some(name) = name_of(image, function) {
        image.symbols.get_mut(name).function_doc = text;
    }
}

fn of_function(image: &Image, function: &Function) -> Option<Rc<str>> {
    match &function.body {
        Body::Closure { code, .. } => image.content_to_look_at(code)?.doc.clone(),
        Body::Generic(generic) => generic.doc.borrow().clone(),
        Body::Native(native) => match image.entries.get(&native.name) {
            Some(Entry::Builtin(builtin)) => Some(builtin.doc.into()),
            _ => None,
        },
        Body::Deferred(_) => definition_of(image, function)
            .map(|definition| definition.signature().doc.as_str().into()),
    }
}

/// Gives a name a documentation.
#[builtin("DOCUMENTATION", "text object doc-type")]
fn set_documentation(
    image: &mut Image,
    text_value: &Value,
    object: &Value,
    doc_type: &Value,
) -> Result<Value, Box<Raise>> {
    let text: Option<Rc<str>> = text_value.as_text().map(Into::into);
    match (object, doc_type.as_symbol()) {
        (Value::Symbol(name, ..), Some(known::VARIABLE)) => {
            image.symbols.get_mut(*name).variable_doc = text;
        }
        (Value::Symbol(name, ..), Some(known::TYPE | known::STRUCTURE)) => {
            if let Some(class) = image.class(*name) {
                *class.doc.borrow_mut() = text;
            }
        }
        (Value::Symbol(name, ..), _) => {
            image.symbols.get_mut(*name).function_doc = text;
        }
        (Value::Class(class), _) => *class.doc.borrow_mut() = text,
        (Value::Function(function), _) => document_function(image, function, text),
        (other, _) => {
            if let Some(method) = other.as_foreign::<MethodObject>() {
                *method.0.doc.borrow_mut() = text;
            }
        }
    }
    Ok(text_value.clone())
}

/// The builtins.
pub(crate) static TABLE: &[Builtin] = builtins![documentation,];

/// What `setf` of the functions here calls: the new value comes first.
pub(crate) static SETTERS: &[Builtin] = builtins![set_documentation,];

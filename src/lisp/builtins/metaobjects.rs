//! What classes, generic functions and methods consist of.

use crate::builtins::generic_functions::Generic;
use crate::value::generic::Method;
use std::rc::Rc;

use crate::builtin::Builtin;
use crate::image::Image;
use crate::object::method::method_value;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::class::{Class, Initform, SlotDefinition};
use crate::value::function::Function;
use crate::value::generic::{Accessor, Specializer};
use crate::value::known;
use crate::value::raise::Raise;

type Outcome = Result<Value, Box<Raise>>;

/// The name of a generic function.
#[builtin("%GENERIC-FUNCTION-NAME")]
fn generic_function_name(generic_function: Generic) -> Outcome {
    let generic = generic_function.0.as_generic();
    Ok(generic.map_or(Value::NIL, |generic| generic.name.clone()))
}

/// The methods of a generic function, in order of definition.
#[builtin("%GENERIC-FUNCTION-METHODS")]
fn generic_function_methods(generic_function: Generic) -> Outcome {
    let generic = generic_function.0.as_generic();
    let methods = generic.map(|generic| generic.methods.borrow().clone());
    Ok(Value::list(methods.iter().flatten().map(method_value)))
}

/// The name of the generic function of a method.
#[builtin("%METHOD-NAME")]
fn method_name(method: &Rc<Method>) -> Outcome {
    Ok(method.name.clone())
}

/// The specializers of a method: classes and lists (EQL value).
#[builtin("%METHOD-SPECIALIZERS")]
fn method_specializers(method: &Rc<Method>) -> Outcome {
    let specializers = method.specializers.iter();
    Ok(Value::list(specializers.map(
        |specializer| match specializer {
            Specializer::Class(class) => Value::Class(class.clone()),
            Specializer::Eql(value) => Value::list([known::EQL.into(), value.clone()]),
        },
    )))
}

/// The `:superclasses`, `:subclasses` or the `:precedence` list of a class.
///
/// `(length (system::%related-classes (find-class 'integer) :superclasses))` => `1`
#[builtin("%RELATED-CLASSES")]
fn related_classes(image: &mut Image, class: &Rc<Class>, relation: &Value) -> Outcome {
    let relation = relation.as_symbol().map(|sym| image.name(sym));
    let classes = match relation {
        Some("SUPERCLASSES") => &class.direct_superclasses,
        Some("SUBCLASSES") => &class.direct_subclasses,
        _ => &class.precedence,
    };
    let classes = classes.borrow();
    Ok(Value::list(classes.iter().cloned().map(Value::Class)))
}

/// Initargs for the descriptions of the slots of a class, or of those that it defines itself.
///
/// `(system::%slots (find-class 'integer) t)` => `NIL`
#[builtin("%SLOTS")]
fn slots(image: &mut Image, class: &Rc<Class>, directp: bool) -> Outcome {
    let is_direct = directp;
    let slots = if is_direct {
        class.direct_slots.borrow()
    } else {
        class.slots.borrow()
    };
    let described = slots.iter().map(|slot| {
        let mut properties = description(image, slot);
        if is_direct {
            for (key, kind) in [
                ("READERS", Accessor::Reader(slot.name)),
                ("WRITERS", Accessor::Writer(slot.name)),
            ] {
                let methods = class.accessors.borrow();
                let methods = methods.iter().filter(|m| m.accessor == Some(kind));
                properties.push(image.keyword(key).into());
                properties.push(Value::list(methods.map(|m| m.name.clone())));
            }
        }
        Value::list(properties)
    });
    Ok(Value::list(described.collect::<Vec<_>>()))
}

/// The initargs for the description of a slot.
fn description(image: &mut Image, slot: &SlotDefinition) -> Vec<Value> {
    let allocation = match slot.shared {
        Some(_) => image.keyword("CLASS"),
        None => image.keyword("INSTANCE"),
    };
    let properties = [
        ("NAME", slot.name.into()),
        (
            "INITARGS",
            Value::list(slot.initargs.iter().map(|key| Value::symbol(*key))),
        ),
        ("INITFUNCTION", function(slot.initform.as_ref())),
        ("TYPE", slot.slot_type.clone()),
        ("ALLOCATION", allocation.into()),
        (
            "DOCUMENTATION",
            slot.doc.as_deref().map_or(Value::NIL, Value::string),
        ),
    ];
    let properties = properties.into_iter();
    properties
        .flat_map(|(key, value)| [image.keyword(key).into(), value])
        .collect()
}

/// A function without arguments that computes an initial value, or `NIL`.
fn function(initform: Option<&Initform>) -> Value {
    match initform {
        None => Value::NIL,
        Some(Initform::Function(function)) => Value::Function(function.clone()),
        Some(Initform::Value(value)) => Value::Function(Function::pure_of(
            known::CONSTANTLY,
            (0, None),
            value.clone(),
            |value, _, _| Ok(value.clone()),
        )),
    }
}

/// Lists of key, NIL and function for the default initargs of a class.
///
/// `(system::%default-initargs (find-class 'integer) t)` => `NIL`
#[builtin("%DEFAULT-INITARGS")]
fn default_initargs(class: &Rc<Class>, directp: bool) -> Outcome {
    let initargs = if directp {
        class.direct_default_initargs.borrow()
    } else {
        class.default_initargs.borrow()
    };
    let initargs = initargs
        .iter()
        .map(|(key, form)| Value::list([(*key).into(), Value::NIL, function(Some(form))]));
    Ok(Value::list(initargs.collect::<Vec<_>>()))
}

/// Builtins of the package `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![
    related_classes,
    slots,
    default_initargs,
    generic_function_name,
    generic_function_methods,
    method_name,
    method_specializers,
];

//! Builtins on generic functions and methods.

use crate::vm::machine::Machine;
use crate::vm::step::Step;
use std::rc::Rc;

use crate::builtin::{Builtin, Operator};
use crate::image::Image;
use crate::object::combination::{self, expand_define_method_combination};
use crate::object::combine::{invoke_method, no_next_method};
use crate::object::dispatch::no_applicable_method_error;
use crate::object::effective::applicable_methods;
use crate::object::method::{
    MethodObject, add_method, generic_named, generic_of, has_qualifiers, method_value,
    remove_method, specializer,
};
use crate::object::{defmethod, text};
use crate::typed::FromValue;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::function::Function;
use crate::value::generic::{GenericFunction, Method};
use crate::value::known;
use crate::value::raise::Raise;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Called when no method of a generic function applies. Add methods to do something else.
///
/// `(progn (defgeneric weigh (x)) (defmethod no-applicable-method ((g (eql #'weigh)) &rest args) (list :cannot args)) (weigh 1))` => `(:CANNOT (1))`
#[builtin]
fn no_applicable_method(
    machine: &mut Machine<'_>,
    generic_function: Value,
    arguments: Vec<Value>,
) -> Result<Step> {
    Err(no_applicable_method_error(
        machine.image,
        generic_function,
        arguments,
    ))
}

/// The error that CALL-NEXT-METHOD has nothing to call.
#[builtin("NO-NEXT-METHOD")]
fn no_next_method_builtin(
    machine: &mut Machine<'_>,
    generic_function: &Value,
    _method: &Value,
    _arguments: Vec<Value>,
) -> Result<Step> {
    Err(no_next_method(machine.image, generic_function))
}

/// Adds a method to a generic function, which is returned.
#[builtin("ADD-METHOD")]
fn add_method_builtin(
    image: &mut Image,
    generic_function: &Value,
    method: &Rc<Method>,
) -> Result<Value> {
    let function = generic_of(image, generic_function)?;
    let required = as_generic(&function)?.parameters.borrow().required;
    let count = method.specializers.len();
    if count != required && !as_generic(&function)?.methods.borrow().is_empty() {
        return Err(wrong_count(image, generic_function, required, count));
    }
    check_owner(image, &function, method)?;
    add_method(image, &function, method.clone())?;
    Ok(generic_function.clone())
}

/// Removes a method from a generic function, which is returned.
///
/// `(progn (defgeneric lift (x)) (let ((m (defmethod lift ((x integer)) x))) (remove-method #'lift m) (find-method #'lift '() (list (find-class 'integer)) nil)))` => `NIL`
#[builtin("REMOVE-METHOD")]
fn remove_method_builtin(
    image: &mut Image,
    generic_function: &Value,
    method: &Rc<Method>,
) -> Result<Value> {
    let function = generic_of(image, generic_function)?;
    if let Some(generic) = function.as_generic() {
        remove_method(generic, method);
    }
    Ok(generic_function.clone())
}

/// The methods that apply to the arguments, most specific first.
///
/// `(progn (defgeneric f (x)) (compute-applicable-methods #'f '(1)))` => `NIL`
#[builtin]
fn compute_applicable_methods(
    image: &mut Image,
    generic_function: Generic,
    arguments: &Value,
) -> Result<Value> {
    let function = generic_function.0;
    let arguments: Vec<Value> = arguments.iter_list().collect();
    let generic = as_generic(&function)?;
    let methods = applicable_methods(image, generic, &arguments);
    Ok(Value::list(methods.iter().map(method_value)))
}

/// The keywords that a method accepts, and whether it accepts all others, too.
///
/// `(function-keywords (defmethod poured (x &key (into 'cup)) (list x into)))` => `(:INTO) ; NIL`
#[builtin]
fn function_keywords(method: &Rc<Method>) -> Result<Value> {
    let parameters = &method.parameters;
    let keys = parameters.keys.iter().flatten().copied();
    Ok(Value::values(vec![
        Value::list(keys.map(Value::symbol)),
        Value::bool(parameters.allows_other_keys),
    ]))
}

/// The qualifiers of a method.
///
/// `(progn (defgeneric f (x)) (method-qualifiers (defmethod f :before (x) x)))` => `(:BEFORE)`
#[builtin]
fn method_qualifiers(method: &Rc<Method>) -> Result<Value> {
    Ok(Value::list(method.qualifiers.clone()))
}

/// Calls a method with a list of arguments and the function behind CALL-NEXT-METHOD.
#[builtin("%INVOKE-METHOD")]
fn invoke_method_builtin(method: &Rc<Method>, arguments: &Value, next: Value) -> Result<Step> {
    let arguments = arguments.iter_list().collect();
    Ok(invoke_method(method, arguments, next))
}

/// The error that CALL-NEXT-METHOD has nothing to call.
#[builtin("%NO-NEXT-METHOD")]
fn no_next_method3(image: &mut Image, name: &Value) -> Result<Value> {
    Err(no_next_method(image, name))
}

/// The macros.
pub(crate) static OPERATORS: &[Operator] = &[
    Operator {
        name: "DEFGENERIC",
        lambda_list: "name lambda-list &rest options",
        doc: "Defines a generic function. Options are (:documentation text), (:method qualifiers… lambda-list body…) (:method-combination operator) and (:argument-precedence-order parameters…).",
        examples: &[
            "(progn (defgeneric kind (x) (:method ((x integer)) :int) (:method (x) :other)) (list (kind 1) (kind \"s\"))) => (:INT :OTHER)",
        ],
        expand: Some(defmethod::expand_defgeneric),
    },
    Operator {
        name: "DEFMETHOD",
        lambda_list: "name &rest qualifiers lambda-list &body body",
        doc: "Defines a method. Required parameters may be (name class) or (name (eql form)); qualifiers are :before, :after, :around or the operator of the method combination.",
        examples: &["(progn (defmethod doubled ((x integer)) (* 2 x)) (doubled 21)) => 42"],
        expand: Some(defmethod::expand_defmethod),
    },
    Operator {
        name: "DEFINE-METHOD-COMBINATION",
        lambda_list: "name &key operator identity-with-one-argument documentation",
        doc: "Defines a method combination that gives the values of all applicable methods to an operator, or, in the long form, (name lambda-list method-groups body…), one whose body returns the form that calls them.",
        examples: &["(define-method-combination join :operator append) => JOIN"],
        expand: Some(expand_define_method_combination),
    },
];

/// A generic function.
pub(super) struct Generic(pub(super) Rc<Function>);

impl<'a> FromValue<'a> for Generic {
    fn from_value(image: &mut Image, value: &'a Value) -> Result<Self> {
        generic_of(image, value).map(Generic)
    }
}

impl<'a> FromValue<'a> for &'a Rc<Method> {
    fn from_value(_: &mut Image, value: &'a Value) -> Result<Self> {
        method_argument(value)
    }
}

fn as_generic(function: &Rc<Function>) -> Result<&GenericFunction> {
    function.as_generic().ok_or_else(|| {
        Raise::type_error(
            &Value::Function(function.clone()),
            Value::symbol(known::GENERIC_FUNCTION),
        )
    })
}

pub(super) fn method_argument(value: &Value) -> Result<&Rc<Method>> {
    value
        .as_foreign::<MethodObject>()
        .map(|object| &object.0)
        .ok_or_else(|| Raise::type_error(value, Value::symbol(known::METHOD)))
}

/// Checks that a method is not one of another generic function.
fn check_owner(image: &Image, function: &Rc<Function>, method: &Rc<Method>) -> Result<()> {
    let owner = generic_named(image, &method.name);
    let other = owner.filter(|owner| !Rc::ptr_eq(owner, function));
    let other = other.as_ref().and_then(|other| other.as_generic());
    if other.is_some_and(|other| other.methods.borrow().iter().any(|m| Rc::ptr_eq(m, method))) {
        return Err(Raise::simple(format!(
            "{} belongs to {}; a method can have one generic function only.",
            text(image, &method_value(method)),
            text(image, &method.name)
        )));
    }
    Ok(())
}

/// The error for a method, or the description of one, with another number of required parameters.
fn wrong_count(image: &Image, function: &Value, required: usize, count: usize) -> Box<Raise> {
    Raise::simple(format!(
        "Methods of {} have {required} specializer{}, not {count}.",
        text(image, function),
        if required == 1 { "" } else { "s" },
    ))
}

/// The method with these qualifiers and specializers.
///
/// `(progn (defgeneric f (x)) (find-method #'f '() (list (find-class 'string)) nil))` => `NIL`
#[builtin(_, "generic-function qualifiers specializers &optional (errorp t)")]
fn find_method(
    image: &mut Image,
    generic_function: &Value,
    qualifiers: &Value,
    specializers: &Value,
    #[default(true)] errorp: bool,
) -> Result<Value> {
    let function = generic_of(image, generic_function)?;
    let wanted_qualifiers: Vec<Value> = qualifiers.iter_list().collect();
    let wanted = specializers
        .iter_list()
        .map(|s| specializer(image, &s))
        .collect::<Result<Vec<_>>>()?;
    let required = as_generic(&function)?.parameters.borrow().required;
    if wanted.len() != required {
        return Err(wrong_count(image, generic_function, required, wanted.len()));
    }
    let methods = as_generic(&function)?.methods.borrow();
    let found = methods.iter().find(|m| {
        has_qualifiers(m, &wanted_qualifiers)
            && m.specializers.len() == wanted.len()
            && m.specializers
                .iter()
                .zip(&wanted)
                .all(|(a, b)| a.is_same(b))
    });
    match found {
        Some(method) => Ok(method_value(method)),
        None if !errorp => Ok(Value::NIL),
        None => Err(Raise::simple(format!(
            "There is no method on {} with qualifiers {} and specializers {}.",
            text(image, generic_function),
            text(image, qualifiers),
            text(image, specializers)
        ))),
    }
}

/// The builtins.
pub(crate) static TABLE: &[Builtin] = builtins![
    no_applicable_method,
    no_next_method_builtin,
    find_method,
    add_method_builtin,
    remove_method_builtin,
    compute_applicable_methods,
    function_keywords,
    method_qualifiers,
];

/// Builtins of the package `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![
    defmethod::add_method,
    defmethod::ensure_generic_function,
    defmethod::own_method,
    combination::define_combination,
    invoke_method_builtin,
    no_next_method3,
];

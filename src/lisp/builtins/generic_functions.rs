//! Builtins on generic functions and methods.

use std::rc::Rc;

use crate::builtin::{Builtin, Operator, control, pure};
use crate::image::Image;
use crate::object::combination::{define_combination, expand_define_method_combination};
use crate::object::combine::{invoke_method, no_next_method};
use crate::object::dispatch::no_applicable_method_error;
use crate::object::effective::applicable_methods;
use crate::object::method::{MethodObject, add_method, method_value, remove_method, specializer};
use crate::object::{defmethod, text};
use crate::value::Value;
use crate::value::function::Function;
use crate::value::generic::{GenericFunction, Method};
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;

/// The builtins.
pub(crate) static TABLE: &[Builtin] = &[
    control(
        "NO-APPLICABLE-METHOD",
        "generic-function &rest arguments",
        "Called when no method of a generic function applies. Add methods to do something else.",
        &[
            "(progn (defgeneric weigh (x)) (defmethod no-applicable-method ((g (eql #'weigh)) &rest args) (list :cannot args)) (weigh 1)) => (:CANNOT (1))",
        ],
        |machine, args| {
            let function = args[0].clone();
            let rest = args[1..].to_vec();
            Err(no_applicable_method_error(machine.image, function, rest))
        },
    ),
    control(
        "NO-NEXT-METHOD",
        "generic-function method &rest arguments",
        "The error that CALL-NEXT-METHOD has nothing to call.",
        &[],
        |machine, args| Err(no_next_method(machine.image, &args[0])),
    ),
    pure(
        "FIND-METHOD",
        "generic-function qualifiers specializers &optional (errorp t)",
        "The method with these qualifiers and specializers.",
        &[
            "(progn (defgeneric f (x)) (find-method #'f '() (list (find-class 'string)) nil)) => NIL",
        ],
        find_method,
    ),
    pure(
        "ADD-METHOD",
        "generic-function method",
        "Adds a method to a generic function, which is returned.",
        &[],
        |image, args| {
            let function = generic_argument(&args[0])?.clone();
            let required = as_generic(&function)?.parameters.borrow().required;
            let count = method_argument(&args[1])?.specializers.len();
            if count != required && !as_generic(&function)?.methods.borrow().is_empty() {
                return Err(wrong_count(image, &args[0], required, count));
            }
            check_owner(image, &function, method_argument(&args[1])?)?;
            add_method(image, &function, method_argument(&args[1])?.clone())?;
            Ok(args[0].clone())
        },
    ),
    pure(
        "REMOVE-METHOD",
        "generic-function method",
        "Removes a method from a generic function, which is returned.",
        &[
            "(progn (defgeneric lift (x)) (let ((m (defmethod lift ((x integer)) x))) (remove-method #'lift m) (find-method #'lift '() (list (find-class 'integer)) nil))) => NIL",
        ],
        |_, args| {
            let function = generic_argument(&args[0])?;
            if let Some(generic) = function.as_generic() {
                remove_method(generic, method_argument(&args[1])?);
            }
            Ok(args[0].clone())
        },
    ),
    pure(
        "COMPUTE-APPLICABLE-METHODS",
        "generic-function arguments",
        "The methods that apply to the arguments, most specific first.",
        &["(progn (defgeneric f (x)) (compute-applicable-methods #'f '(1))) => NIL"],
        |image, args| {
            let function = generic_argument(&args[0])?.clone();
            let arguments: Vec<Value> = args[1].iter_list().collect();
            let generic = as_generic(&function)?;
            let methods = applicable_methods(image, generic, &arguments);
            Ok(Value::list(methods.iter().map(method_value)))
        },
    ),
    pure(
        "FUNCTION-KEYWORDS",
        "method",
        "The keywords that a method accepts, and whether it accepts all others, too.",
        &[
            "(function-keywords (defmethod poured (x &key (into 'cup)) (list x into))) => (:INTO) ; NIL",
        ],
        |_, args| {
            let parameters = &method_argument(&args[0])?.parameters;
            let keys = parameters.keys.iter().flatten().copied();
            Ok(Value::values(vec![
                Value::list(keys.map(Value::symbol)),
                Value::bool(parameters.allows_other_keys),
            ]))
        },
    ),
    pure(
        "METHOD-QUALIFIERS",
        "method",
        "The qualifiers of a method.",
        &[
            "(progn (defgeneric f (x)) (method-qualifiers (defmethod f :before (x) x))) => (:BEFORE)",
        ],
        |_, args| {
            let method = method_argument(&args[0])?;
            let qualifiers: Vec<Sym> = method.qualifiers.clone();
            Ok(Value::list(qualifiers.into_iter().map(Value::symbol)))
        },
    ),
];

/// Builtins of the package `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = &[
    pure(
        "%ADD-METHOD",
        "name qualifiers specializers lambda-list takes-next documentation function",
        "Defines a method as DEFMETHOD describes it.",
        &[],
        defmethod::add_method,
    ),
    pure(
        "%ENSURE-GENERIC",
        "name lambda-list combination documentation precedence keeps-methods",
        "Defines a generic function as DEFGENERIC describes it.",
        &[],
        defmethod::ensure_generic_function,
    ),
    pure(
        "%OWN-METHOD",
        "method",
        "Notes that a method was made by a DEFGENERIC.",
        &[],
        defmethod::own_method,
    ),
    pure(
        "%DEFINE-COMBINATION",
        "name operator identity-with-one-argument",
        "Defines a method combination as DEFINE-METHOD-COMBINATION describes it.",
        &[],
        define_combination,
    ),
    control(
        "%INVOKE-METHOD",
        "method arguments next",
        "Calls a method with a list of arguments and the function behind CALL-NEXT-METHOD.",
        &[],
        |_, args| {
            let arguments = args[1].iter_list().collect();
            Ok(invoke_method(
                method_argument(&args[0])?,
                arguments,
                args[2].clone(),
            ))
        },
    ),
    pure(
        "%NO-NEXT-METHOD",
        "name",
        "The error that CALL-NEXT-METHOD has nothing to call.",
        &[],
        |image, args| Err(no_next_method(image, &args[0])),
    ),
];

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

pub(super) fn generic_argument(value: &Value) -> Result<&Rc<Function>, Box<Raise>> {
    match value {
        Value::Function(function) if function.as_generic().is_some() => Ok(function),
        other => Err(Raise::type_error(
            other,
            Value::symbol(known::GENERIC_FUNCTION),
        )),
    }
}

fn as_generic(function: &Rc<Function>) -> Result<&GenericFunction, Box<Raise>> {
    function.as_generic().ok_or_else(|| {
        Raise::type_error(
            &Value::Function(function.clone()),
            Value::symbol(known::GENERIC_FUNCTION),
        )
    })
}

pub(super) fn method_argument(value: &Value) -> Result<&Rc<Method>, Box<Raise>> {
    value
        .as_foreign::<MethodObject>()
        .map(|object| &object.0)
        .ok_or_else(|| Raise::type_error(value, Value::symbol(known::METHOD)))
}

/// Checks that a method is not one of another generic function.
fn check_owner(
    image: &Image,
    function: &Rc<Function>,
    method: &Rc<Method>,
) -> Result<(), Box<Raise>> {
    let owner = image.named_function(&method.name);
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

fn find_method(image: &mut Image, args: &[Value]) -> Result<Value, Box<Raise>> {
    let function = generic_argument(&args[0])?;
    let qualifiers: Vec<Sym> = args[1].iter_list().filter_map(|q| q.as_symbol()).collect();
    let specializers = args[2]
        .iter_list()
        .map(|s| specializer(image, &s))
        .collect::<Result<Vec<_>, _>>()?;
    let required = as_generic(function)?.parameters.borrow().required;
    if specializers.len() != required {
        return Err(wrong_count(image, &args[0], required, specializers.len()));
    }
    let methods = as_generic(function)?.methods.borrow();
    let found = methods.iter().find(|m| {
        m.qualifiers == qualifiers
            && m.specializers.len() == specializers.len()
            && m.specializers
                .iter()
                .zip(&specializers)
                .all(|(a, b)| a.is_same(b))
    });
    match found {
        Some(method) => Ok(method_value(method)),
        None if args.get(3).is_some_and(Value::is_nil) => Ok(Value::NIL),
        None => Err(Raise::simple(format!(
            "There is no method on {} with qualifiers {} and specializers {}.",
            text(image, &args[0]),
            text(image, &args[1]),
            text(image, &args[2])
        ))),
    }
}

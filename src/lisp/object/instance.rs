//! `make-instance` and the initialization protocol.

use std::rc::Rc;

use super::define::no_class;
use super::effective::applicable_methods;
use super::fill::{Finish, Which, fill};
use super::method::extended_function;
use crate::image::Image;
use crate::value::Value;
use crate::value::class::{Class, ClassKind, Initform, Instance};
use crate::value::function::Function;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;
use crate::vm::calls::{Args, run};
use crate::vm::machine::Machine;
use crate::vm::step::Step;

/// `(make-instance class initargs…)`.
pub(crate) fn make_instance(
    machine: &mut Machine<'_>,
    args: Vec<Value>,
) -> Result<Step, Box<Raise>> {
    let mut args = args.into_iter();
    let designator = args.next().unwrap_or(Value::NIL);
    if matches!(designator, Value::Symbol(..))
        && let Some(function) = extended_function(machine.image, known::MAKE_INSTANCE)
    {
        // A program's methods are for classes, not for their names.
        let class = Value::Class(designated_class(machine.image, &designator)?);
        let args: Vec<Value> = std::iter::once(class).chain(args).collect();
        return run(machine, "MAKE-INSTANCE", |calls| async move {
            Ok(calls.call(&function, Args::Many(args)).await)
        });
    }
    let class = instantiable_class(machine.image, &designator)?;
    let initargs: Vec<Value> = args.collect();
    check_pairs(machine.image, &initargs)?;
    let (initargs, pending) = with_default_initargs(&class, initargs);
    if pending.is_empty() {
        return make(machine, class, initargs);
    }
    run(machine, "MAKE-INSTANCE", |calls| async move {
        let mut initargs = initargs;
        for (key, initform) in pending {
            let initform = Value::Function(initform);
            let value = calls.call(&initform, Args::Many(Vec::new())).await;
            initargs.extend([Value::symbol(key), value]);
        }
        calls
            .with(move |machine| make(machine, class, initargs))
            .await
    })
}

/// Initargs, and default ones that are still to be computed, with their keywords.
type WithDefaults = (Vec<Value>, Vec<(Sym, Rc<Function>)>);

/// The initargs with those default ones that are constant.
fn with_default_initargs(class: &Class, mut initargs: Vec<Value>) -> WithDefaults {
    let mut pending = Vec::new();
    let given = initargs.len();
    for (key, form) in class.default_initargs.borrow().iter() {
        if has_key(&initargs[..given], *key) {
            continue;
        }
        match form {
            Initform::Value(value) => initargs.extend([Value::symbol(*key), value.clone()]),
            Initform::Function(function) => pending.push((*key, function.clone())),
        }
    }
    (initargs, pending)
}

/// Makes an instance and initialises it.
fn make(
    machine: &mut Machine<'_>,
    class: Rc<Class>,
    initargs: Vec<Value>,
) -> Result<Step, Box<Raise>> {
    let instance = Rc::new(Instance::new(class.clone()));
    let object = Value::Instance(instance.clone());
    if class.kind != ClassKind::Condition {
        let of_class = [Value::Class(class.clone()), Value::T];
        let of_instance = [object.clone(), Value::T];
        let protocol = [
            (known::MAKE_INSTANCE, of_class.clone()),
            (known::ALLOCATE_INSTANCE, of_class),
            (known::INITIALIZE_INSTANCE, of_instance.clone()),
            (known::SHARED_INITIALIZE, of_instance),
        ];
        check_initargs(machine.image, &object, &protocol, &initargs)?;
    }
    let initialize = extended_function(machine.image, known::INITIALIZE_INSTANCE);
    let shared = extended_function(machine.image, known::SHARED_INITIALIZE);
    if initialize.is_none() && shared.is_none() {
        let finish = Finish::Return(object);
        return fill(machine, &instance, &Which::All, &initargs, finish);
    }
    let function = initialize.unwrap_or(Value::symbol(known::INITIALIZE_INSTANCE));
    let mut args = vec![object.clone()];
    args.extend(initargs);
    call_and_return(machine, function, args, object)
}

/// Calls a function of the initialization protocol and returns the object.
fn call_and_return(
    machine: &mut Machine<'_>,
    function: Value,
    args: Vec<Value>,
    object: Value,
) -> Result<Step, Box<Raise>> {
    run(machine, "MAKE-INSTANCE", |calls| async move {
        calls.call(&function, Args::Many(args)).await;
        Ok(object)
    })
}

/// The class that a class or a class name designates.
pub(crate) fn designated_class(image: &Image, designator: &Value) -> Result<Rc<Class>, Box<Raise>> {
    match designator {
        Value::Class(class) => Ok(class.clone()),
        Value::Symbol(name, ..) => image
            .class(*name)
            .filter(|class| class.is_defined.get())
            .cloned()
            .ok_or_else(|| no_class(image, *name)),
        other => Err(Raise::type_error(other, Value::symbol(known::CLASS))),
    }
}

/// Like [`designated_class`], but an error if the class cannot be instantiated.
pub(crate) fn instantiable_class(
    image: &Image,
    designator: &Value,
) -> Result<Rc<Class>, Box<Raise>> {
    let class = designated_class(image, designator)?;
    check_instantiable(image, &class)?;
    Ok(class)
}

fn check_instantiable(image: &Image, class: &Class) -> Result<(), Box<Raise>> {
    let name = || super::text(image, &Value::symbol(class.name));
    if class.kind == ClassKind::Builtin {
        return Err(Raise::simple(format!(
            "Cannot allocate an instance of #<BUILT-IN-CLASS {}>.",
            name()
        )));
    }
    if class.precedence.borrow().is_empty() {
        let missing = class
            .direct_superclasses
            .borrow()
            .iter()
            .find(|s| s.precedence.borrow().is_empty())
            .map_or_else(String::new, |s| super::text(image, &s.name.into()));
        return Err(Raise::simple(format!(
            "The class {} cannot be instantiated: its superclass {missing} is not defined.",
            name()
        )));
    }
    Ok(())
}

fn has_key(initargs: &[Value], key: Sym) -> bool {
    initargs
        .chunks_exact(2)
        .any(|pair| pair[0].as_symbol() == Some(key))
}

/// Checks that initargs are symbols with values.
pub(super) fn check_pairs(image: &Image, initargs: &[Value]) -> Result<(), Box<Raise>> {
    if !initargs.len().is_multiple_of(2) {
        return Err(Raise::program("odd number of &KEY arguments"));
    }
    let names = initargs.chunks_exact(2).map(|pair| &pair[0]);
    match names.into_iter().find(|name| name.as_symbol().is_none()) {
        Some(name) => Err(Raise::program(format!(
            "The name of an initialization argument is a symbol, not {}.",
            super::text(image, name)
        ))),
        None => Ok(()),
    }
}

/// A function of the initialization protocol, and the arguments with which it would be called.
type ProtocolCall = (Sym, [Value; 2]);

/// Checks that each initarg names a slot or is a keyword of an applicable method of one of
/// the `protocol` functions.
pub(super) fn check_initargs(
    image: &Image,
    object: &Value,
    protocol: &[ProtocolCall],
    initargs: &[Value],
) -> Result<(), Box<Raise>> {
    let class = super::class_of(image, object);
    let slots = class.slots.borrow();
    let is_known = |key: &Value| match key.as_symbol() {
        Some(known::K_ALLOW_OTHER_KEYS) => true,
        Some(key) => slots.iter().any(|s| s.initargs.contains(&key)),
        None => false,
    };
    let unknown = initargs
        .chunks_exact(2)
        .map(|pair| &pair[0])
        .filter(|key| !is_known(key));
    let unknown: Vec<&Value> = unknown.collect();
    if unknown.is_empty() || allows_other_keys(initargs) {
        return Ok(());
    }
    let Some(keys) = method_keys(image, protocol) else {
        return Ok(());
    };
    let bad: Vec<String> = unknown
        .into_iter()
        .filter(|key| !key.as_symbol().is_some_and(|k| keys.contains(&k)))
        .map(|key| super::text(image, key))
        .collect();
    if bad.is_empty() {
        return Ok(());
    }
    let plural = if bad.len() == 1 { "" } else { "s" };
    Err(Raise::program(format!(
        "Invalid initialization argument{plural}:\n  {}\nin call for class {}.",
        bad.join(", "),
        super::text(image, &Value::Class(class.clone()))
    )))
}

fn allows_other_keys(initargs: &[Value]) -> bool {
    initargs
        .chunks_exact(2)
        .find(|pair| pair[0].as_symbol() == Some(known::K_ALLOW_OTHER_KEYS))
        .is_some_and(|pair| pair[1].is_true())
}

/// The keywords that the program's methods of the functions accept; none if any are accepted.
fn method_keys(image: &Image, protocol: &[ProtocolCall]) -> Option<Vec<Sym>> {
    let mut keys = Vec::new();
    for (function, args) in protocol {
        let Some(generic) = image.function(*function).and_then(|f| f.as_generic()) else {
            continue;
        };
        for method in applicable_methods(image, generic, args) {
            if method.is_builtin {
                continue;
            }
            if method.parameters.allows_other_keys {
                return None;
            }
            match &method.parameters.keys {
                Some(names) => keys.extend(names),
                None if method.parameters.has_rest => return None,
                None => {}
            }
        }
    }
    Some(keys)
}

/// The default `initialize-instance`.
pub(crate) fn initialize_instance(
    machine: &mut Machine<'_>,
    args: Vec<Value>,
) -> Result<Step, Box<Raise>> {
    share(machine, args, Value::T)
}

/// The default `reinitialize-instance`: no initforms.
pub(crate) fn reinitialize_instance(
    machine: &mut Machine<'_>,
    args: Vec<Value>,
) -> Result<Step, Box<Raise>> {
    if let Some((object, initargs)) = args.split_first() {
        let protocol = [known::REINITIALIZE_INSTANCE, known::SHARED_INITIALIZE];
        let protocol = protocol.map(|name| (name, [object.clone(), Value::T]));
        check_initargs(machine.image, object, &protocol, initargs)?;
    }
    share(machine, args, Value::NIL)
}

fn share(machine: &mut Machine<'_>, args: Vec<Value>, names: Value) -> Result<Step, Box<Raise>> {
    let mut all = args;
    all.insert(1.min(all.len()), names);
    match extended_function(machine.image, known::SHARED_INITIALIZE) {
        Some(function) => {
            let object = all.first().cloned().unwrap_or(Value::NIL);
            call_and_return(machine, function, all, object)
        }
        None => shared_initialize(machine, all),
    }
}

/// The default `shared-initialize`: `(instance slot-names initargs…)`.
pub(crate) fn shared_initialize(
    machine: &mut Machine<'_>,
    args: Vec<Value>,
) -> Result<Step, Box<Raise>> {
    let [object, names, initargs @ ..] = args.as_slice() else {
        return Err(Raise::program("invalid number of arguments: 1"));
    };
    let Value::Instance(instance) = object else {
        return Err(Raise::type_error(
            object,
            Value::symbol(known::STANDARD_OBJECT),
        ));
    };
    check_pairs(machine.image, initargs)?;
    let finish = Finish::Return(object.clone());
    let which = Which::from_value(names);
    fill(machine, instance, &which, initargs, finish)
}

/// `(allocate-instance class …)`: an instance whose slots are unbound.
pub(crate) fn allocate_instance(
    machine: &mut Machine<'_>,
    args: Vec<Value>,
) -> Result<Step, Box<Raise>> {
    let designator = args.first().cloned().unwrap_or(Value::NIL);
    let class = instantiable_class(machine.image, &designator)?;
    Ok(Step::Return(Value::Instance(Rc::new(Instance::new(class)))))
}

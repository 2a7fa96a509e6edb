//! Builtins on classes and instances.

use std::rc::Rc;

use crate::builtin::{Builtin, Operator};
use crate::image::Image;
use crate::image::locks::Meaning;
use crate::object::define::{self, no_class};
use crate::object::{access, class_of, defclass, instance, update};
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::class::Instance;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;
use crate::vm::machine::Machine;
use crate::vm::step::Step;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Makes an instance of a class.
///
/// `(progn (defclass cup () ((size :initarg :size))) (slot-value (make-instance 'cup :size 3) 'size))` => `3`
#[builtin(_, "class &rest initargs")]
fn make_instance(machine: &mut Machine<'_>, initargs: Vec<Value>) -> Result<Step> {
    instance::make_instance(machine, initargs)
}

/// Makes an instance whose slots have no values.
///
/// `(progn (defclass tray () ((load :initform 1))) (slot-boundp (allocate-instance (find-class 'tray)) 'load))` => `NIL`
#[builtin(_, "class &rest initargs")]
fn allocate_instance(machine: &mut Machine<'_>, initargs: Vec<Value>) -> Result<Step> {
    instance::allocate_instance(machine, initargs)
}

/// Gives the slots of a new instance their values. Add methods to do more.
///
/// `(progn (defclass lamp () ((lit :initarg :lit))) (defmethod initialize-instance :after ((x lamp) &key) (setf (slot-value x 'lit) :off)) (slot-value (make-instance 'lamp :lit :on) 'lit))` => `:OFF`
#[builtin(_, "instance &rest initargs")]
fn initialize_instance(machine: &mut Machine<'_>, initargs: Vec<Value>) -> Result<Step> {
    instance::initialize_instance(machine, initargs)
}

/// Changes slots by their initargs.
///
/// `(progn (defclass cup () ((size :initarg :size))) (slot-value (reinitialize-instance (make-instance 'cup) :size 5) 'size))` => `5`
#[builtin(_, "instance &rest initargs")]
fn reinitialize_instance(machine: &mut Machine<'_>, initargs: Vec<Value>) -> Result<Step> {
    instance::reinitialize_instance(machine, initargs)
}

/// Sets slots by initargs, and the named ones (all if T) that have no value by their initforms.
#[builtin(_, "instance slot-names &rest initargs")]
fn shared_initialize(machine: &mut Machine<'_>, initargs: Vec<Value>) -> Result<Step> {
    instance::shared_initialize(machine, initargs)
}

/// The value of a slot.
///
/// `(progn (defclass cup () ((size :initform 1))) (slot-value (make-instance 'cup) 'size))` => `1`
#[builtin]
fn slot_value(machine: &mut Machine<'_>, object: &Value, slot_name: &Value) -> Result<Step> {
    access::slot_value(machine, object, slot_name)
}

/// Has the slot a value?
///
/// `(progn (defclass cup () (size)) (slot-boundp (make-instance 'cup) 'size))` => `NIL`
#[builtin]
fn slot_boundp(machine: &mut Machine<'_>, object: &Value, slot_name: &Value) -> Result<Step> {
    access::slot_boundp(machine, object, slot_name)
}

/// Takes the value of a slot away; returns the object.
///
/// `(progn (defclass jar () ((lid :initform 1))) (slot-boundp (slot-makunbound (make-instance 'jar) 'lid) 'lid))` => `NIL`
#[builtin]
fn slot_makunbound(machine: &mut Machine<'_>, object: &Value, slot_name: &Value) -> Result<Step> {
    access::slot_makunbound(machine, object, slot_name)
}

/// Does the object have a slot of this name?
///
/// `(slot-exists-p 5 'size)` => `NIL`
#[builtin]
fn slot_exists_p(object: &Value, slot_name: &Value) -> Result<Value> {
    let slot = access::slot_name(slot_name)?;
    Ok(Value::bool(access::slot_exists(object, slot)))
}

/// Called when a slot without a value is read. Add methods to give it one.
#[builtin]
fn slot_unbound(_class: &Value, object: &Value, slot_name: &Value) -> Result<Step> {
    Err(access::unbound_slot(object, access::slot_name(slot_name)?))
}

/// The class of an object.
///
/// `(class-name (class-of '(1)))` => `CONS`
#[builtin("CLASS-OF")]
fn class_of_builtin(image: &mut Image, object: &Value) -> Result<Value> {
    Ok(Value::Class(class_of(image, object)))
}

/// The name of a class.
///
/// `(class-name (find-class 'list))` => `LIST`
#[builtin(_, "class")]
fn class_name(class_value: &Value) -> Result<Value> {
    match class_value {
        Value::Class(class) => Ok(class.class_name()),
        other => Err(Raise::type_error(other, Value::symbol(known::CLASS))),
    }
}

/// Called when an instance is used after its class was redefined. Add methods to do more.
#[builtin(_, "instance added-slots discarded-slots property-list &rest initargs")]
fn update_instance_for_redefined_class(
    machine: &mut Machine<'_>,
    initargs: Vec<Value>,
) -> Result<Step> {
    let mut rest = initargs;
    rest.drain(2..4.min(rest.len()));
    instance::shared_initialize(machine, rest)
}

/// The names of the slots that instances of a class have.
#[builtin("%SLOT-NAMES", "class")]
fn slot_names(class_value: &Value) -> Result<Value> {
    match class_value {
        Value::Class(class) => {
            let names: Vec<Value> = class.slots.borrow().iter().map(|s| s.name.into()).collect();
            Ok(Value::list(names))
        }
        other => Err(Raise::type_error(other, known::CLASS)),
    }
}

/// The macros.
pub static OPERATORS: &[Operator] = &[
    Operator {
        name: "DEFCLASS",
        lambda_list: "name (&rest superclasses) (&rest slots) &rest options",
        doc: "Defines a class. A slot is a name, or (name :initarg :key :initform form :reader name :writer name :accessor name :allocation :instance|:class :type type :documentation text); options are (:default-initargs key form …) and (:documentation text).",
        examples: &[
            "(progn (defclass point () ((x :initarg :x :accessor x))) (x (make-instance 'point :x 1))) => 1",
        ],
        expand: Some(defclass::expand_defclass),
    },
    Operator {
        name: "DEFINE-CONDITION",
        lambda_list: "name (&rest superclasses) (&rest slots) &rest options",
        doc: "Defines a condition: slots as in DEFCLASS; options are (:report text-or-function), (:default-initargs …) and (:documentation text).",
        examples: &[
            "(define-condition spilled (error) ((what :initarg :what :reader what)) (:report (lambda (c s) (format s \"~a spilled\" (what c))))) => SPILLED",
        ],
        expand: Some(defclass::expand_define_condition),
    },
];

/// Stores a value in a slot.
#[builtin("SLOT-VALUE")]
fn set_slot_value_builtin(
    machine: &mut Machine<'_>,
    value: Value,
    object: &Value,
    slot_name: &Value,
) -> Result<Step> {
    set_slot_value(machine, value, object, slot_name)
}

/// Stores a value in a slot: the function of `(setf slot-value)`.
#[builtin]
fn set_slot_value(
    machine: &mut Machine<'_>,
    value: Value,
    object: &Value,
    slot_name: &Value,
) -> Result<Step> {
    access::set_slot_value(machine, value, object, slot_name)
}

/// Called when a slot that the object does not have is used.
#[builtin]
fn slot_missing(
    machine: &mut Machine<'_>,
    _class: &Value,
    object: &Value,
    slot_name: &Value,
    operation: &Value,
    new_value: Option<&Value>,
) -> Result<Step> {
    let slot = access::slot_name(slot_name)?;
    let operation = match operation.as_symbol() {
        Some(known::SETF) => access::Access::Write,
        Some(known::SLOT_BOUNDP) => access::Access::IsBound,
        Some(known::SLOT_MAKUNBOUND) => access::Access::MakeUnbound,
        _ => access::Access::Read,
    };
    let value = new_value;
    Err(access::missing_slot(
        machine.image,
        object,
        slot,
        operation,
        value,
    ))
}

/// Lets each instance of the class, given by itself or its name, be brought up to date when it is
/// next used, as after a redefinition; returns its argument.
///
/// `(progn (defclass keg () ()) (make-instances-obsolete 'keg))` => `KEG`
#[builtin(_, "class")]
fn make_instances_obsolete(image: &mut Image, class_value: &Value) -> Result<Value> {
    let class = match class_value {
        Value::Class(class) => class.clone(),
        Value::Symbol(name, ..) => {
            let class = image.class(*name).cloned();
            class.ok_or_else(|| no_class(image, *name))?
        }
        other => return Err(Raise::type_error(other, Value::symbol(known::CLASS))),
    };
    define::make_obsolete(&class);
    Ok(class_value.clone())
}

/// The class of that name; without one an error, or NIL if the second argument is NIL.
///
/// `(find-class 'no-such-class nil)` => `NIL`
#[builtin(_, "symbol &optional (errorp t) environment")]
fn find_class(
    image: &mut Image,
    symbol: Sym,
    #[default(true)] errorp: bool,
    _environment: Option<&Value>,
) -> Result<Value> {
    match image.class(symbol) {
        Some(class) if class.is_defined.get() => Ok(Value::Class(class.clone())),
        _ if !errorp => Ok(Value::NIL),
        _ => Err(no_class(image, symbol)),
    }
}

/// Changes what `class-name` returns; `find-class` goes on finding the class under its old name.
#[builtin("CLASS-NAME", "name class")]
fn set_class_name(name: &Value, class_value: &Value) -> Result<Value> {
    match class_value {
        Value::Class(class) => {
            *class.given_name.borrow_mut() = Some(name.clone());
            Ok(name.clone())
        }
        other => Err(Raise::type_error(other, Value::symbol(known::CLASS))),
    }
}

/// Gives a class a name.
#[builtin("FIND-CLASS", "class symbol &optional errorp environment")]
fn set_find_class(
    image: &mut Image,
    class_value: &Value,
    symbol: &Value,
    _errorp: Option<&Value>,
    _environment: Option<&Value>,
) -> Result<Value> {
    let Some(name) = symbol.as_symbol() else {
        return Err(Raise::type_error(symbol, Value::symbol(known::SYMBOL)));
    };
    image.check_lock(name, Meaning::Type)?;
    match class_value {
        Value::Class(class) => {
            image.classes.insert(name, class.clone());
        }
        Value::Symbol(known::NIL, ..) => {
            image.classes.shift_remove(&name);
        }
        other => return Err(Raise::type_error(other, Value::symbol(known::CLASS))),
    }
    Ok(class_value.clone())
}

/// Makes an instance one of another class; slots of the same name keep their values.
///
/// `(progn (defclass raw () ((mass :initform 2))) (defclass cooked () (mass)) (slot-value (change-class (make-instance 'raw) 'cooked) 'mass))` => `2`
#[builtin]
fn change_class(
    machine: &mut Machine<'_>,
    instance: &Rc<Instance>,
    new_class: &Value,
    initargs: Vec<Value>,
) -> Result<Step> {
    let class = instance::instantiable_class(machine.image, new_class)?;
    if !initargs.len().is_multiple_of(2) {
        return Err(Raise::program("odd number of &KEY arguments"));
    }
    if instance.class().kind != class.kind {
        return Err(Raise::simple(format!(
            "An instance of the class {} cannot become one of the class {}.",
            machine.image.name(instance.class().name),
            machine.image.name(class.name)
        )));
    }
    update::change_class(machine, instance, &class, initargs)
}

/// Called by CHANGE-CLASS. Add methods to do more.
#[builtin("UPDATE-INSTANCE-FOR-DIFFERENT-CLASS")]
fn update_for_different_class(
    machine: &mut Machine<'_>,
    previous: &Rc<Instance>,
    current: &Rc<Instance>,
    initargs: &[Value],
) -> Result<Step> {
    update::initialize_new_slots(machine, previous, current, initargs)
}

/// The builtins.
pub(crate) static TABLE: &[Builtin] = builtins![
    make_instance,
    allocate_instance,
    initialize_instance,
    reinitialize_instance,
    shared_initialize,
    slot_value,
    slot_boundp,
    slot_makunbound,
    slot_exists_p,
    slot_unbound,
    slot_missing,
    class_of_builtin,
    class_name,
    find_class,
    make_instances_obsolete,
    change_class,
    update_instance_for_redefined_class,
    update_for_different_class,
];

/// Builtins of the package `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![
    slot_names,
    set_slot_value,
    defclass::define_class,
    defclass::define_condition
];

/// What `setf` of the functions here calls: the new value comes first.
pub(crate) static SETTERS: &[Builtin] =
    builtins![set_slot_value_builtin, set_find_class, set_class_name,];

//! Builtins on classes and instances.

use std::rc::Rc;

use crate::builtin::{Builtin, Operator, control, pure};
use crate::image::Image;
use crate::object::define::{self, no_class};
use crate::object::{access, class_of, defclass, instance, update};
use crate::value::Value;
use crate::value::class::Instance;
use crate::value::known;
use crate::value::raise::Raise;
use crate::vm::machine::Machine;
use crate::vm::step::Step;

/// The builtins.
pub static TABLE: &[Builtin] = &[
    control(
        "MAKE-INSTANCE",
        "class &rest initargs",
        "Makes an instance of a class.",
        &[
            "(progn (defclass cup () ((size :initarg :size))) (slot-value (make-instance 'cup :size 3) 'size)) => 3",
        ],
        instance::make_instance,
    ),
    control(
        "ALLOCATE-INSTANCE",
        "class &rest initargs",
        "Makes an instance whose slots have no values.",
        &[
            "(progn (defclass tray () ((load :initform 1))) (slot-boundp (allocate-instance (find-class 'tray)) 'load)) => NIL",
        ],
        instance::allocate_instance,
    ),
    control(
        "INITIALIZE-INSTANCE",
        "instance &rest initargs",
        "Gives the slots of a new instance their values. Add methods to do more.",
        &[
            "(progn (defclass lamp () ((lit :initarg :lit))) (defmethod initialize-instance :after ((x lamp) &key) (setf (slot-value x 'lit) :off)) (slot-value (make-instance 'lamp :lit :on) 'lit)) => :OFF",
        ],
        instance::initialize_instance,
    ),
    control(
        "REINITIALIZE-INSTANCE",
        "instance &rest initargs",
        "Changes slots by their initargs.",
        &[
            "(progn (defclass cup () ((size :initarg :size))) (slot-value (reinitialize-instance (make-instance 'cup) :size 5) 'size)) => 5",
        ],
        instance::reinitialize_instance,
    ),
    control(
        "SHARED-INITIALIZE",
        "instance slot-names &rest initargs",
        "Sets slots by initargs, and the named ones (all if T) that have no value by their initforms.",
        &[],
        instance::shared_initialize,
    ),
    control(
        "SLOT-VALUE",
        "object slot-name",
        "The value of a slot.",
        &[
            "(progn (defclass cup () ((size :initform 1))) (slot-value (make-instance 'cup) 'size)) => 1",
        ],
        |machine, args| access::slot_value(machine, &args[0], &args[1]),
    ),
    control(
        "SLOT-BOUNDP",
        "object slot-name",
        "Has the slot a value?",
        &["(progn (defclass cup () (size)) (slot-boundp (make-instance 'cup) 'size)) => NIL"],
        |machine, args| access::slot_boundp(machine, &args[0], &args[1]),
    ),
    control(
        "SLOT-MAKUNBOUND",
        "object slot-name",
        "Takes the value of a slot away; returns the object.",
        &[
            "(progn (defclass jar () ((lid :initform 1))) (slot-boundp (slot-makunbound (make-instance 'jar) 'lid) 'lid)) => NIL",
        ],
        |machine, args| access::slot_makunbound(machine, &args[0], &args[1]),
    ),
    pure(
        "SLOT-EXISTS-P",
        "object slot-name",
        "Does the object have a slot of this name?",
        &["(slot-exists-p 5 'size) => NIL"],
        |_, args| {
            let slot = access::slot_name(&args[1])?;
            Ok(Value::bool(access::slot_exists(&args[0], slot)))
        },
    ),
    control(
        "SLOT-UNBOUND",
        "class object slot-name",
        "Called when a slot without a value is read. Add methods to give it one.",
        &[],
        |_, args| Err(access::unbound_slot(&args[1], access::slot_name(&args[2])?)),
    ),
    control(
        "SLOT-MISSING",
        "class object slot-name operation &optional new-value",
        "Called when a slot that the object does not have is used.",
        &[],
        slot_missing,
    ),
    pure(
        "CLASS-OF",
        "object",
        "The class of an object.",
        &["(class-name (class-of '(1))) => CONS"],
        |image, args| Ok(Value::Class(class_of(image, &args[0]))),
    ),
    pure(
        "CLASS-NAME",
        "class",
        "The name of a class.",
        &["(class-name (find-class 'list)) => LIST"],
        |_, args| match &args[0] {
            Value::Class(class) => Ok(class.class_name()),
            other => Err(Raise::type_error(other, Value::symbol(known::CLASS))),
        },
    ),
    pure(
        "FIND-CLASS",
        "symbol &optional (errorp t) environment",
        "The class of that name; without one an error, or NIL if the second argument is NIL.",
        &["(find-class 'no-such-class nil) => NIL"],
        find_class,
    ),
    pure(
        "MAKE-INSTANCES-OBSOLETE",
        "class",
        "Lets each instance of the class, given by itself or its name, be brought up to date when it is next used, as after a redefinition; returns its argument.",
        &["(progn (defclass keg () ()) (make-instances-obsolete 'keg)) => KEG"],
        make_instances_obsolete,
    ),
    control(
        "CHANGE-CLASS",
        "instance new-class &rest initargs",
        "Makes an instance one of another class; slots of the same name keep their values.",
        &[
            "(progn (defclass raw () ((mass :initform 2))) (defclass cooked () (mass)) (slot-value (change-class (make-instance 'raw) 'cooked) 'mass)) => 2",
        ],
        change_class,
    ),
    control(
        "UPDATE-INSTANCE-FOR-REDEFINED-CLASS",
        "instance added-slots discarded-slots property-list &rest initargs",
        "Called when an instance is used after its class was redefined. Add methods to do more.",
        &[],
        |machine, args| {
            let mut rest = args;
            rest.drain(2..4.min(rest.len()));
            instance::shared_initialize(machine, rest)
        },
    ),
    control(
        "UPDATE-INSTANCE-FOR-DIFFERENT-CLASS",
        "previous current &rest initargs",
        "Called by CHANGE-CLASS. Add methods to do more.",
        &[],
        update_for_different_class,
    ),
];

/// Builtins of the package `SYSTEM`.
pub static SYSTEM_TABLE: &[Builtin] = &[
    pure(
        "%SLOT-NAMES",
        "class",
        "The names of the slots that instances of a class have.",
        &[],
        |_, args| match &args[0] {
            Value::Class(class) => {
                let names: Vec<Value> =
                    class.slots.borrow().iter().map(|s| s.name.into()).collect();
                Ok(Value::list(names))
            }
            other => Err(Raise::type_error(other, known::CLASS)),
        },
    ),
    control(
        "SET-SLOT-VALUE",
        "value object slot-name",
        "Stores a value in a slot: the function of `(setf slot-value)`.",
        &[],
        set_slot_value,
    ),
    pure(
        "%DEFINE-CLASS",
        "name superclasses slots default-initargs documentation last",
        "Defines a class as DEFCLASS describes it.",
        &[],
        defclass::define_standard_class,
    ),
    pure(
        "%DEFINE-CONDITION",
        "name superclasses slots default-initargs documentation report",
        "Defines a condition as DEFINE-CONDITION describes it.",
        &[],
        defclass::define_condition,
    ),
];

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

/// What `setf` of the functions here calls: the new value comes first.
pub static SETTERS: &[Builtin] = &[
    control(
        "SLOT-VALUE",
        "value object slot-name",
        "Stores a value in a slot.",
        &[],
        set_slot_value,
    ),
    pure(
        "FIND-CLASS",
        "class symbol &optional errorp environment",
        "Gives a class a name.",
        &[],
        set_find_class,
    ),
    pure(
        "CLASS-NAME",
        "name class",
        "Changes what `class-name` returns; `find-class` goes on finding the class under its old name.",
        &[],
        set_class_name,
    ),
];

fn set_slot_value(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    access::set_slot_value(machine, args[0].clone(), &args[1], &args[2])
}

fn slot_missing(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    let slot = access::slot_name(&args[2])?;
    let operation = match args[3].as_symbol() {
        Some(known::SETF) => access::Access::Write,
        Some(known::SLOT_BOUNDP) => access::Access::IsBound,
        Some(known::SLOT_MAKUNBOUND) => access::Access::MakeUnbound,
        _ => access::Access::Read,
    };
    let value = args.get(4);
    Err(access::missing_slot(
        machine.image,
        &args[1],
        slot,
        operation,
        value,
    ))
}

fn make_instances_obsolete(image: &mut Image, args: &[Value]) -> Result<Value, Box<Raise>> {
    let class = match &args[0] {
        Value::Class(class) => class.clone(),
        Value::Symbol(name, ..) => {
            let class = image.class(*name).cloned();
            class.ok_or_else(|| no_class(image, *name))?
        }
        other => return Err(Raise::type_error(other, Value::symbol(known::CLASS))),
    };
    define::make_obsolete(&class);
    Ok(args[0].clone())
}

fn find_class(image: &mut Image, args: &[Value]) -> Result<Value, Box<Raise>> {
    let Some(name) = args[0].as_symbol() else {
        return Err(Raise::type_error(&args[0], Value::symbol(known::SYMBOL)));
    };
    match image.class(name) {
        Some(class) if class.is_defined.get() => Ok(Value::Class(class.clone())),
        _ if args.get(1).is_some_and(Value::is_nil) => Ok(Value::NIL),
        _ => Err(no_class(image, name)),
    }
}

fn set_class_name(_: &mut Image, args: &[Value]) -> Result<Value, Box<Raise>> {
    match &args[1] {
        Value::Class(class) => {
            *class.given_name.borrow_mut() = Some(args[0].clone());
            Ok(args[0].clone())
        }
        other => Err(Raise::type_error(other, Value::symbol(known::CLASS))),
    }
}

fn set_find_class(image: &mut Image, args: &[Value]) -> Result<Value, Box<Raise>> {
    let Some(name) = args[1].as_symbol() else {
        return Err(Raise::type_error(&args[1], Value::symbol(known::SYMBOL)));
    };
    match &args[0] {
        Value::Class(class) => {
            image.classes.insert(name, class.clone());
        }
        Value::Symbol(known::NIL, ..) => {
            image.classes.shift_remove(&name);
        }
        other => return Err(Raise::type_error(other, Value::symbol(known::CLASS))),
    }
    Ok(args[0].clone())
}

fn instance_argument(value: &Value) -> Result<&Rc<Instance>, Box<Raise>> {
    match value {
        Value::Instance(instance) => Ok(instance),
        other => Err(Raise::type_error(
            other,
            Value::symbol(known::STANDARD_OBJECT),
        )),
    }
}

fn change_class(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    let class = instance::instantiable_class(machine.image, &args[1])?;
    let instance = instance_argument(&args[0])?;
    let initargs = args[2..].to_vec();
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

fn update_for_different_class(
    machine: &mut Machine<'_>,
    args: Vec<Value>,
) -> Result<Step, Box<Raise>> {
    let previous = instance_argument(&args[0])?;
    let current = instance_argument(&args[1])?;
    update::initialize_new_slots(machine, previous, current, &args[2..])
}

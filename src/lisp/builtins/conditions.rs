//! Builtins that make conditions and read their slots.

use crate::builtin::{Builtin, control, pure};
use crate::object::access::unbound_slot;
use crate::object::instance;
use crate::value::Value;
use crate::value::class::ClassKind;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;
use crate::vm::machine::Machine;
use crate::vm::step::Step;

/// The builtins.
pub static TABLE: &[Builtin] = &[
    control(
        "MAKE-CONDITION",
        "type &rest initargs",
        "Makes a condition without signalling it.",
        &["(type-error-datum (make-condition 'type-error :datum 5 :expected-type 'string)) => 5"],
        make_condition,
    ),
    pure(
        "SIMPLE-CONDITION-FORMAT-CONTROL",
        "condition",
        "The format control of a simple condition.",
        &[
            "(handler-case (error \"x ~a\" 1) (error (e) (simple-condition-format-control e))) => \"x ~a\"",
        ],
        |_, args| read(args, known::SIMPLE_CONDITION, known::FORMAT_CONTROL),
    ),
    pure(
        "SIMPLE-CONDITION-FORMAT-ARGUMENTS",
        "condition",
        "The format arguments of a simple condition.",
        &[
            "(handler-case (error \"x ~a\" 1) (error (e) (simple-condition-format-arguments e))) => (1)",
        ],
        |_, args| read(args, known::SIMPLE_CONDITION, known::FORMAT_ARGUMENTS),
    ),
    pure(
        "TYPE-ERROR-DATUM",
        "condition",
        "The value that is not of the expected type.",
        &["(handler-case (car 5) (type-error (e) (type-error-datum e))) => 5"],
        |_, args| read(args, known::TYPE_ERROR, known::DATUM),
    ),
    pure(
        "TYPE-ERROR-EXPECTED-TYPE",
        "condition",
        "The type that was expected.",
        &["(handler-case (car 5) (type-error (e) (type-error-expected-type e))) => LIST"],
        |_, args| read(args, known::TYPE_ERROR, known::EXPECTED_TYPE),
    ),
    pure(
        "CELL-ERROR-NAME",
        "condition",
        "The name of the variable, function or slot without a value.",
        &[
            "(handler-case no-such-variable (unbound-variable (e) (cell-error-name e))) => NO-SUCH-VARIABLE",
        ],
        |_, args| read(args, known::CELL_ERROR, known::NAME),
    ),
    pure(
        "UNBOUND-SLOT-INSTANCE",
        "condition",
        "The instance whose slot has no value.",
        &[
            "(progn (defclass crate () (load)) (handler-case (slot-value (make-instance 'crate) 'load) (unbound-slot (c) (type-of (unbound-slot-instance c))))) => CRATE",
        ],
        |_, args| read(args, known::UNBOUND_SLOT, known::INSTANCE),
    ),
    pure(
        "ARITHMETIC-ERROR-OPERATION",
        "condition",
        "The name of the function that failed.",
        &["(handler-case (/ 1 0) (division-by-zero (e) (arithmetic-error-operation e))) => /"],
        |_, args| read(args, known::ARITHMETIC_ERROR, known::OPERATION),
    ),
    pure(
        "ARITHMETIC-ERROR-OPERANDS",
        "condition",
        "The arguments of the function that failed.",
        &["(handler-case (/ 1 0) (division-by-zero (e) (arithmetic-error-operands e))) => (1 0)"],
        |_, args| read(args, known::ARITHMETIC_ERROR, known::OPERANDS),
    ),
    pure(
        "PACKAGE-ERROR-PACKAGE",
        "condition",
        "The package, or its name, that an error is about.",
        &[
            "(handler-case (in-package :nowhere) (package-error (c) (package-error-package c))) => :NOWHERE",
        ],
        |_, args| read(args, known::PACKAGE_ERROR, known::PACKAGE),
    ),
    pure(
        "STREAM-ERROR-STREAM",
        "condition",
        "The stream that an error is about.",
        &[
            "(handler-case (read-char (make-string-input-stream \"\")) (end-of-file (c) (streamp (stream-error-stream c)))) => T",
        ],
        |_, args| read(args, known::STREAM_ERROR, known::STREAM),
    ),
    pure(
        "FILE-ERROR-PATHNAME",
        "condition",
        "The file that an error is about.",
        &[
            "(handler-case (open \"no-such-file\") (file-error (c) (file-error-pathname c))) => #P\"no-such-file\"",
        ],
        |_, args| read(args, known::FILE_ERROR, known::PATHNAME),
    ),
    pure(
        "PRINT-NOT-READABLE-OBJECT",
        "condition",
        "The object that cannot be printed so that it can be read.",
        &[],
        |_, args| read(args, known::PRINT_NOT_READABLE, known::OBJECT),
    ),
];

/// The slot of a condition of a class.
fn read(args: &[Value], class: Sym, slot: Sym) -> Result<Value, Box<Raise>> {
    let condition = &args[0];
    let value = match condition {
        Value::Instance(instance) if instance.is_a(class) => instance.slot(slot),
        _ => None,
    };
    match value {
        Some(value) if value.is_unbound() => Err(unbound_slot(condition, slot)),
        Some(value) => Ok(value),
        None => Err(Raise::type_error(condition, Value::symbol(class))),
    }
}

fn make_condition(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    let class = instance::designated_class(machine.image, &args[0])?;
    if class.kind != ClassKind::Condition {
        return Err(Raise::type_error(&args[0], Value::symbol(known::CONDITION)));
    }
    instance::make_instance(machine, args)
}

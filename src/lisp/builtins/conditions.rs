//! Builtins that make conditions and read their slots.

use crate::builtin::Builtin;
use crate::object::access::unbound_slot;
use crate::object::instance;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::class::ClassKind;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;
use crate::vm::machine::Machine;
use crate::vm::step::Step;

/// The format control of a simple condition.
///
/// `(handler-case (error "x ~a" 1) (error (e) (simple-condition-format-control e)))` => `"x ~a"`
#[builtin]
fn simple_condition_format_control(condition: &Value) -> Result<Value, Box<Raise>> {
    read(condition, known::SIMPLE_CONDITION, known::FORMAT_CONTROL)
}

/// The format arguments of a simple condition.
///
/// `(handler-case (error "x ~a" 1) (error (e) (simple-condition-format-arguments e)))` => `(1)`
#[builtin]
fn simple_condition_format_arguments(condition: &Value) -> Result<Value, Box<Raise>> {
    read(condition, known::SIMPLE_CONDITION, known::FORMAT_ARGUMENTS)
}

/// The value that is not of the expected type.
///
/// `(handler-case (car 5) (type-error (e) (type-error-datum e)))` => `5`
#[builtin]
fn type_error_datum(condition: &Value) -> Result<Value, Box<Raise>> {
    read(condition, known::TYPE_ERROR, known::DATUM)
}

/// The type that was expected.
///
/// `(handler-case (car 5) (type-error (e) (type-error-expected-type e)))` => `LIST`
#[builtin]
fn type_error_expected_type(condition: &Value) -> Result<Value, Box<Raise>> {
    read(condition, known::TYPE_ERROR, known::EXPECTED_TYPE)
}

/// The name of the variable, function or slot without a value.
///
/// `(handler-case no-such-variable (unbound-variable (e) (cell-error-name e)))` => `NO-SUCH-VARIABLE`
#[builtin]
fn cell_error_name(condition: &Value) -> Result<Value, Box<Raise>> {
    read(condition, known::CELL_ERROR, known::NAME)
}

/// The instance whose slot has no value.
///
/// `(progn (defclass crate () (load)) (handler-case (slot-value (make-instance 'crate) 'load) (unbound-slot (c) (type-of (unbound-slot-instance c)))))` => `CRATE`
#[builtin]
fn unbound_slot_instance(condition: &Value) -> Result<Value, Box<Raise>> {
    read(condition, known::UNBOUND_SLOT, known::INSTANCE)
}

/// The name of the function that failed.
///
/// `(handler-case (/ 1 0) (division-by-zero (e) (arithmetic-error-operation e)))` => `/`
#[builtin]
fn arithmetic_error_operation(condition: &Value) -> Result<Value, Box<Raise>> {
    read(condition, known::ARITHMETIC_ERROR, known::OPERATION)
}

/// The arguments of the function that failed.
///
/// `(handler-case (/ 1 0) (division-by-zero (e) (arithmetic-error-operands e)))` => `(1 0)`
#[builtin]
fn arithmetic_error_operands(condition: &Value) -> Result<Value, Box<Raise>> {
    read(condition, known::ARITHMETIC_ERROR, known::OPERANDS)
}

/// The package, or its name, that an error is about.
///
/// `(handler-case (in-package :nowhere) (package-error (c) (package-error-package c)))` => `:NOWHERE`
#[builtin]
fn package_error_package(condition: &Value) -> Result<Value, Box<Raise>> {
    read(condition, known::PACKAGE_ERROR, known::PACKAGE)
}

/// The stream that an error is about.
///
/// `(handler-case (read-char (make-string-input-stream "")) (end-of-file (c) (streamp (stream-error-stream c))))` => `T`
#[builtin]
fn stream_error_stream(condition: &Value) -> Result<Value, Box<Raise>> {
    read(condition, known::STREAM_ERROR, known::STREAM)
}

/// The file that an error is about.
///
/// `(handler-case (open "no-such-file") (file-error (c) (file-error-pathname c)))` => `#P"no-such-file"`
#[builtin]
fn file_error_pathname(condition: &Value) -> Result<Value, Box<Raise>> {
    read(condition, known::FILE_ERROR, known::PATHNAME)
}

/// The object that cannot be printed so that it can be read.
#[builtin]
fn print_not_readable_object(condition: &Value) -> Result<Value, Box<Raise>> {
    read(condition, known::PRINT_NOT_READABLE, known::OBJECT)
}

/// The slot of a condition of a class.
fn read(condition: &Value, class: Sym, slot: Sym) -> Result<Value, Box<Raise>> {
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

/// Makes a condition without signalling it.
///
/// `(type-error-datum (make-condition 'type-error :datum 5 :expected-type 'string))` => `5`
#[builtin(_, "type &rest initargs")]
fn make_condition(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    let class = instance::designated_class(machine.image, &args[0])?;
    if class.kind != ClassKind::Condition {
        return Err(Raise::type_error(&args[0], Value::symbol(known::CONDITION)));
    }
    instance::make_instance(machine, args)
}

/// The builtins.
pub(crate) static TABLE: &[Builtin] = builtins![
    make_condition,
    simple_condition_format_control,
    simple_condition_format_arguments,
    type_error_datum,
    type_error_expected_type,
    cell_error_name,
    unbound_slot_instance,
    arithmetic_error_operation,
    arithmetic_error_operands,
    package_error_package,
    stream_error_stream,
    file_error_pathname,
    print_not_readable_object,
];

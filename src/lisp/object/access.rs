//! `slot-value` and its relatives.

use super::method::extended_function;
use super::update;
use crate::image::Image;
use crate::value::Value;
use crate::value::class::Instance;
use crate::value::cycles;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;
use crate::vm::calls::{Args, run};
use crate::vm::machine::Machine;
use crate::vm::step::Step;

/// What is done with a slot.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Access {
    /// The value is read.
    Read,
    /// A value is stored.
    Write,
    /// The slot is tested for a value.
    IsBound,
    /// The value is removed.
    MakeUnbound,
}

impl Access {
    /// The operation as `slot-missing` receives it.
    fn symbol(self) -> Sym {
        match self {
            Access::Read => known::SLOT_VALUE,
            Access::Write => known::SETF,
            Access::IsBound => known::SLOT_BOUNDP,
            Access::MakeUnbound => known::SLOT_MAKUNBOUND,
        }
    }
}

/// The value of a slot.
pub fn slot_value(
    machine: &mut Machine<'_>,
    object: &Value,
    name: &Value,
) -> Result<Step, Box<Raise>> {
    let slot = slot_name(name)?;
    match object {
        Value::Instance(instance) if instance.is_obsolete() => {
            let args = vec![object.clone(), name.clone()];
            update::then_call(machine, object.clone(), known::SLOT_VALUE.into(), args)
        }
        Value::Instance(instance) => match instance.slot(slot) {
            Some(value) if !value.is_unbound() => Ok(Step::Return(value)),
            Some(_) => unbound(machine, object, slot),
            None => missing(machine, object, slot, Access::Read, None),
        },
        other => missing(machine, other, slot, Access::Read, None),
    }
}

/// Stores a value in a slot and returns it. `again` is the function that does the same,
/// called once more after an update of the instance.
pub(crate) fn set_slot_value(
    machine: &mut Machine<'_>,
    value: Value,
    object: &Value,
    name: &Value,
) -> Result<Step, Box<Raise>> {
    let slot = slot_name(name)?;
    match object {
        Value::Instance(instance) if instance.is_obsolete() => {
            let args = vec![value, object.clone(), name.clone()];
            let again = known::SET_SLOT_VALUE.into();
            update::then_call(machine, object.clone(), again, args)
        }
        Value::Instance(instance) if instance.set_slot(slot, value.clone()) => {
            cycles::note(instance, &value);
            Ok(Step::Return(value))
        }
        other => missing(machine, other, slot, Access::Write, Some(value)),
    }
}

/// Does the slot have a value?
pub(crate) fn slot_boundp(
    machine: &mut Machine<'_>,
    object: &Value,
    name: &Value,
) -> Result<Step, Box<Raise>> {
    let slot = slot_name(name)?;
    match object {
        Value::Instance(instance) if instance.is_obsolete() => {
            let args = vec![object.clone(), name.clone()];
            update::then_call(machine, object.clone(), known::SLOT_BOUNDP.into(), args)
        }
        Value::Instance(instance) => match instance.slot(slot) {
            Some(value) => Ok(Step::Return(Value::bool(!value.is_unbound()))),
            None => missing(machine, object, slot, Access::IsBound, None),
        },
        other => missing(machine, other, slot, Access::IsBound, None),
    }
}

/// Makes a slot unbound; returns the instance.
pub(crate) fn slot_makunbound(
    machine: &mut Machine<'_>,
    object: &Value,
    name: &Value,
) -> Result<Step, Box<Raise>> {
    let slot = slot_name(name)?;
    match object {
        Value::Instance(instance) if instance.is_obsolete() => {
            let args = vec![object.clone(), name.clone()];
            update::then_call(machine, object.clone(), known::SLOT_MAKUNBOUND.into(), args)
        }
        Value::Instance(instance) if instance.set_slot(slot, Value::Unbound) => {
            Ok(Step::Return(object.clone()))
        }
        other => missing(machine, other, slot, Access::MakeUnbound, None),
    }
}

/// The value of an unbound slot, which a call of `slot-unbound` supplies.
fn unbound(machine: &mut Machine<'_>, object: &Value, slot: Sym) -> Result<Step, Box<Raise>> {
    let class = Value::Class(super::class_of(machine.image, object));
    let Some(function) = extended_function(machine.image, known::SLOT_UNBOUND) else {
        return Err(unbound_slot(object, slot));
    };
    let args = vec![class, object.clone(), slot.into()];
    run(machine, "SLOT-VALUE", |calls| async move {
        Ok(calls.call(&function, Args::Many(args)).await)
    })
}

/// The error for a slot without a value.
pub(crate) fn unbound_slot(object: &Value, slot: Sym) -> Box<Raise> {
    Box::new(Raise::Make {
        place: crate::source::Place::NONE,
        class: known::UNBOUND_SLOT,
        report: None,
        initargs: vec![
            (known::K_NAME, slot.into()),
            (known::K_INSTANCE, object.clone()),
        ],
    })
}

/// What an access to a slot returns that the object does not have: what a call of `slot-missing` says,
/// for one that only reads, else what it always returns.
fn missing(
    machine: &mut Machine<'_>,
    object: &Value,
    slot: Sym,
    access: Access,
    value: Option<Value>,
) -> Result<Step, Box<Raise>> {
    let Some(function) = extended_function(machine.image, known::SLOT_MISSING) else {
        let value = value.as_ref();
        return Err(missing_slot(machine.image, object, slot, access, value));
    };
    let class = Value::Class(super::class_of(machine.image, object));
    let operation = Value::symbol(access.symbol());
    let mut args = vec![class, object.clone(), slot.into(), operation];
    args.extend(value.clone());
    let object = object.clone();
    run(machine, "SLOT-MISSING", move |calls| async move {
        let answer = calls.call(&function, Args::Many(args)).await;
        Ok(match access {
            Access::Read => answer,
            Access::Write => value.unwrap_or_default(),
            Access::IsBound => Value::bool(answer.is_true()),
            Access::MakeUnbound => object,
        })
    })
}

/// The error for a slot that the object does not have.
pub(crate) fn missing_slot(
    image: &Image,
    object: &Value,
    slot: Sym,
    access: Access,
    value: Option<&Value>,
) -> Box<Raise> {
    let attempt = match access {
        Access::Read => "read the slot's value (slot-value)".to_owned(),
        Access::Write => format!(
            "set the slot's value to {} (setf of slot-value)",
            super::text(image, value.unwrap_or(&Value::NIL))
        ),
        Access::IsBound => "test to see whether slot is bound (slot-boundp)".to_owned(),
        Access::MakeUnbound => "make the slot unbound (slot-makunbound)".to_owned(),
    };
    Raise::simple(format!(
        "When attempting to {attempt}, the slot {} is missing from the object {}.",
        super::text(image, &slot.into()),
        super::text(image, object)
    ))
}

/// Does the object have a slot of this name?
pub(crate) fn slot_exists(object: &Value, slot: Sym) -> bool {
    matches!(object, Value::Instance(i) if has_slot(i, slot))
}

fn has_slot(instance: &Instance, slot: Sym) -> bool {
    instance.class.borrow().slot_index(slot).is_some()
}

/// A slot name, which is a symbol.
pub fn slot_name(name: &Value) -> Result<Sym, Box<Raise>> {
    name.as_symbol()
        .ok_or_else(|| Raise::type_error(name, Value::symbol(known::SYMBOL)))
}

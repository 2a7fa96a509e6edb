//! Bringing instances up to date after their class was redefined or changed.

use std::rc::Rc;

use super::fill::{Finish, Which, fill};
use super::instance::{check_initargs, check_pairs};
use super::method::extended_function;
use crate::value::Value;
use crate::value::class::{Class, Instance, OldSlot, SlotDefinition};
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;
use crate::vm::calls::{Args, run};
use crate::vm::machine::Machine;
use crate::vm::step::Step;

/// What a change of layout did.
struct Change {
    added: Vec<Sym>,
    /// Slots that are gone, with their values.
    discarded: Vec<(Sym, Value)>,
}

/// Updates an instance of a redefined class, then calls a function.
pub(crate) fn then_call(
    machine: &mut Machine<'_>,
    object: Value,
    function: Value,
    args: Vec<Value>,
) -> Result<Step, Box<Raise>> {
    let Value::Instance(instance) = &object else {
        return Ok(Step::TailCall { function, args });
    };
    let change = migrate(instance);
    let finish = Finish::Call(function, args);
    let Some(update) = extended_function(machine.image, known::UPDATE_INSTANCE_FOR_REDEFINED_CLASS)
    else {
        let added = Which::Only(change.added);
        return fill(machine, instance, &added, &[], finish);
    };
    let names = |names: &[Sym]| Value::list(names.iter().map(|n| Value::symbol(*n)));
    let gone: Vec<Sym> = change.discarded.iter().map(|(n, _)| *n).collect();
    let plist = change
        .discarded
        .into_iter()
        .flat_map(|(n, v)| [Value::symbol(n), v])
        .collect::<Vec<_>>();
    let update_args = vec![
        object.clone(),
        names(&change.added),
        names(&gone),
        Value::list(plist),
    ];
    call_then(machine, update, update_args, finish)
}

/// Calls the function that updates an instance, then does what comes after it.
fn call_then(
    machine: &mut Machine<'_>,
    update: Value,
    args: Vec<Value>,
    finish: Finish,
) -> Result<Step, Box<Raise>> {
    let name = "UPDATE-INSTANCE-FOR-REDEFINED-CLASS";
    run(machine, name, |calls| async move {
        calls.call(&update, Args::Many(args)).await;
        Ok(finish.step())
    })
}

/// Lays out the slots of an instance as its class defines them now.
fn migrate(instance: &Instance) -> Change {
    let class = instance.class();
    let old_names = old_layout(&class, instance.generation.get());
    let change = lay_out(instance, &old_names, &class);
    instance.generation.set(class.generation.get());
    change
}

/// The slot names of a class in one of its generations.
fn old_layout(class: &Class, generation: u32) -> Vec<OldSlot> {
    let layouts = class.old_layouts.borrow();
    usize::try_from(generation)
        .ok()
        .and_then(|i| layouts.get(i).cloned())
        .unwrap_or_else(|| {
            let slots = class.slots.borrow();
            let value = |slot: &SlotDefinition| slot.shared.as_ref().map(|shared| shared.get());
            slots.iter().map(|s| (s.name, value(s))).collect()
        })
}

fn lay_out(instance: &Instance, old_layout: &[OldSlot], class: &Class) -> Change {
    let names = || old_layout.iter().map(|(name, _)| *name);
    let values = old_layout.iter().zip(instance.slots.take());
    let values = values.map(|((_, shared), local)| shared.clone().unwrap_or(local));
    let mut old: Vec<(Sym, Value)> = names().zip(values).collect();
    let mut change = Change {
        added: Vec::new(),
        discarded: Vec::new(),
    };
    let mut slots = Vec::new();
    for slot in class.slots.borrow().iter() {
        match old.iter().position(|(name, _)| *name == slot.name) {
            Some(i) => {
                let value = old.swap_remove(i).1;
                slots.push(match slot.shared {
                    Some(_) => Value::Unbound,
                    None => value,
                });
            }
            None => {
                slots.push(Value::Unbound);
                change.added.push(slot.name);
            }
        }
    }
    old.retain(|(_, value)| !value.is_unbound());
    old.sort_by_key(|(name, _)| names().position(|n| n == *name));
    change.discarded = old;
    *instance.slots.borrow_mut() = slots;
    change
}

/// `change-class`: makes the instance one of another class. Slots of the same name keep
/// their values, others are initialised.
pub(crate) fn change_class(
    machine: &mut Machine<'_>,
    instance: &Rc<Instance>,
    class: &Rc<Class>,
    initargs: Vec<Value>,
) -> Result<Step, Box<Raise>> {
    let object = Value::Instance(instance.clone());
    check_pairs(machine.image, &initargs)?;
    let changed = Value::Instance(Rc::new(Instance::new(class.clone())));
    let protocol = [
        (
            known::UPDATE_INSTANCE_FOR_DIFFERENT_CLASS,
            [object.clone(), changed.clone()],
        ),
        (known::SHARED_INITIALIZE, [changed.clone(), Value::T]),
    ];
    check_initargs(machine.image, &changed, &protocol, &initargs)?;
    let old_class = instance.class();
    let previous = Instance::with_slots(old_class.clone(), instance.slots.borrow().clone());
    previous.generation.set(instance.generation.get());
    let previous = Rc::new(previous);
    let old_names = old_layout(&old_class, instance.generation.get());
    let change = lay_out(instance, &old_names, class);
    *instance.class.borrow_mut() = class.clone();
    instance.generation.set(class.generation.get());
    let update = extended_function(machine.image, known::UPDATE_INSTANCE_FOR_DIFFERENT_CLASS);
    match update {
        None => {
            let finish = Finish::Return(object);
            let added = Which::Only(change.added);
            fill(machine, instance, &added, &initargs, finish)
        }
        Some(function) => {
            let mut args = vec![Value::Instance(previous), object.clone()];
            args.extend(initargs);
            call_then(machine, function, args, Finish::Return(object))
        }
    }
}

/// The default `update-instance-for-different-class`: slots that the previous instance did
/// not have are initialised.
pub(crate) fn initialize_new_slots(
    machine: &mut Machine<'_>,
    previous: &Instance,
    instance: &Rc<Instance>,
    initargs: &[Value],
) -> Result<Step, Box<Raise>> {
    let old = previous.class();
    let added = instance
        .class()
        .slots
        .borrow()
        .iter()
        .map(|s| s.name)
        .filter(|name| old.slot_index(*name).is_none())
        .collect();
    let finish = Finish::Return(Value::Instance(instance.clone()));
    fill(machine, instance, &Which::Only(added), initargs, finish)
}

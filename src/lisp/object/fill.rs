//! Giving slots their values: initargs first, then initforms.

use std::ops::Deref;
use std::rc::Rc;

use crate::value::Value;
use crate::value::class::{Initform, Instance};
use crate::value::raise::Raise;
use crate::value::symbol::Sym;
use crate::vm::calls::{Args, run};
use crate::vm::machine::Machine;
use crate::vm::step::Step;

/// Which slots may get the value of their initform.
pub enum Which {
    /// All.
    All,
    /// The named ones.
    Only(Vec<Sym>),
}

impl Which {
    /// From the slot names argument of `shared-initialize`: `T` or a list.
    pub fn from_value(value: &Value) -> Which {
        match value {
            Value::Symbol(crate::value::known::T, ..) => Which::All,
            list => Which::Only(list.iter_list().filter_map(|n| n.as_symbol()).collect()),
        }
    }

    fn includes(&self, name: Sym) -> bool {
        match self {
            Which::All => true,
            Which::Only(names) => names.contains(&name),
        }
    }
}

/// What happens when all slots have their values.
pub enum Finish {
    /// The value is returned.
    Return(Value),
    /// The function is called.
    Call(Value, Vec<Value>),
}

impl Finish {
    /// The step that does it.
    pub fn step(self) -> Step {
        match self {
            Finish::Return(value) => Step::Return(value),
            Finish::Call(function, args) => Step::TailCall { function, args },
        }
    }
}

/// Sets the slots that initargs (keywords and values in turn) name; slots among `which`
/// that are still unbound get their initial values.
pub fn fill(
    machine: &mut Machine<'_>,
    instance: &Rc<Instance>,
    which: &Which,
    initargs: &[Value],
    finish: Finish,
) -> Result<Step, Box<Raise>> {
    let mut pending = Vec::new();
    let class = instance.class();
    for (index, slot) in class.slots.borrow().iter().enumerate() {
        let given = initargs.chunks_exact(2).find(|pair| {
            pair[0]
                .as_symbol()
                .is_some_and(|k| slot.initargs.contains(&k))
        });
        if let Some(pair) = given {
            store(
                instance,
                index,
                slot.shared.as_deref().map(Deref::deref),
                pair[1].clone(),
            );
            continue;
        }
        if !which.includes(slot.name)
            || !is_unbound(instance, index, slot.shared.as_deref().map(Deref::deref))
        {
            continue;
        }
        match &slot.initform {
            None => {}
            Some(Initform::Value(value)) => {
                store(
                    instance,
                    index,
                    slot.shared.as_deref().map(Deref::deref),
                    value.clone(),
                );
            }
            Some(Initform::Function(function)) => pending.push((slot.name, function.clone())),
        }
    }
    if pending.is_empty() {
        return Ok(finish.step());
    }
    let instance = instance.clone();
    run(machine, "SHARED-INITIALIZE", |calls| async move {
        for (name, initform) in pending {
            let initform = Value::Function(initform);
            let value = calls.call(&initform, Args::Many(Vec::new())).await;
            instance.set_slot(name, value);
        }
        Ok(finish.step())
    })
}

fn store(
    instance: &Instance,
    index: usize,
    shared: Option<&crate::value::slot::Slot>,
    value: Value,
) {
    match shared {
        Some(shared) => shared.set(value),
        None => {
            if let Some(slot) = instance.slots.borrow_mut().get_mut(index) {
                *slot = value;
            }
        }
    }
}

fn is_unbound(
    instance: &Instance,
    index: usize,
    shared: Option<&crate::value::slot::Slot>,
) -> bool {
    match shared {
        Some(shared) => shared.with(Value::is_unbound),
        None => instance
            .slots
            .borrow()
            .get(index)
            .is_some_and(Value::is_unbound),
    }
}

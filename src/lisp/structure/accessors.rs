//! Accessors, predicates and copiers of structures: functions that carry their class.

use std::rc::Rc;

use super::define::{check_slot_type, copy_structure};
use crate::image::Image;
use crate::image::locks::Meaning;
use crate::value::Value;
use crate::value::class::{Class, Instance, StructureSlot};
use crate::value::cycles;
use crate::value::function::Function;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;

/// The instance that a value is, if it is one of the class or of one that includes it.
fn instance_of<'a>(value: &'a Value, class: &Rc<Class>) -> Option<&'a Rc<Instance>> {
    let Value::Instance(instance) = value else {
        return None;
    };
    let own = instance.class.borrow();
    let is_one =
        Rc::ptr_eq(&own, class) || own.precedence.borrow().iter().any(|c| Rc::ptr_eq(c, class));
    is_one.then_some(instance)
}

fn wrong_type(value: &Value, class: &Class) -> Box<Raise> {
    Raise::type_error(value, Value::symbol(class.name))
}

/// Defines the reader of a slot and, unless it is read-only, its writer.
pub(crate) fn define(
    image: &mut Image,
    class: &Rc<Class>,
    index: usize,
    slot: &StructureSlot,
    accessor: Sym,
) -> Result<(), Box<Raise>> {
    // The accessor of an included slot may be the included structure's own.
    if is_inherited(image, class, accessor) {
        return Ok(());
    }
    image.check_lock(accessor, Meaning::Function)?;
    let reader = Function::pure_of(accessor, (1, Some(1)), class.clone(), move |of, _, args| {
        instance_of(&args[0], of)
            .and_then(|instance| instance.slots.borrow().get(index).cloned())
            .ok_or_else(|| wrong_type(&args[0], of))
    });
    image.set_function(accessor, reader);
    let data = image.symbols.get_mut(accessor);
    if slot.read_only {
        data.setf_function = None;
        return Ok(());
    }
    let writer = Function::pure_of(
        accessor,
        (2, Some(2)),
        (class.clone(), slot.slot_type.clone()),
        move |(of, slot_type), image, args| {
            let instance = instance_of(&args[1], of).ok_or_else(|| wrong_type(&args[1], of))?;
            check_slot_type(image, slot_type, &args[0])?;
            cycles::note(instance, &args[0]);
            if let Some(place) = instance.slots.borrow_mut().get_mut(index) {
                *place = args[0].clone();
            }
            Ok(args[0].clone())
        },
    );
    data.setf_function = Some(writer);
    Ok(())
}

/// Is the accessor one that an included structure has defined?
fn is_inherited(image: &Image, class: &Rc<Class>, accessor: Sym) -> bool {
    let name = image.name(accessor);
    let supers = class.direct_superclasses.borrow();
    supers.iter().any(|parent| {
        let layout = parent.structure.borrow();
        layout.as_ref().is_some_and(|layout| {
            layout
                .slots
                .iter()
                .any(|slot| name == format!("{}{}", layout.conc_name, image.name(slot.name)))
        }) && image.function(accessor).is_some()
    })
}

/// Defines the function that recognises structures of a class.
pub(crate) fn define_predicate(
    image: &mut Image,
    class: &Rc<Class>,
    predicate: Sym,
) -> Result<(), Box<Raise>> {
    image.check_lock(predicate, Meaning::Function)?;
    let function = Function::pure_of(predicate, (1, Some(1)), class.clone(), |of, _, args| {
        Ok(Value::bool(instance_of(&args[0], of).is_some()))
    });
    image.set_function(predicate, function);
    Ok(())
}

/// Defines the function that copies structures of a class.
pub(crate) fn define_copier(
    image: &mut Image,
    class: &Rc<Class>,
    copier: Sym,
) -> Result<(), Box<Raise>> {
    image.check_lock(copier, Meaning::Function)?;
    let function = Function::pure_of(copier, (1, Some(1)), class.clone(), |of, _, args| {
        if instance_of(&args[0], of).is_none() {
            return Err(wrong_type(&args[0], of));
        }
        copy_structure(&args[0])
    });
    image.set_function(copier, function);
    Ok(())
}

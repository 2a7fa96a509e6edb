//! The builtins behind `defstruct`: defining the class, and making structures.

use std::rc::Rc;

use super::accessors;
use crate::image::Image;
use crate::object::define::{ClassDefinition, no_class};
use crate::types::{TypeCheck, typep};
use crate::value::Value;
use crate::value::class::{
    Class, ClassKind, Initform, Instance, SlotDefinition, StructureLayout, StructureSlot,
};
use crate::value::form::constant_value;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;

/// Defines a structure: `(name parent ((slot accessor initform type read-only)…)
/// copier predicate documentation conc-name)`.
pub(crate) fn define_structure(image: &mut Image, args: &[Value]) -> Result<Value, Box<Raise>> {
    let [
        Value::Symbol(name, ..),
        parent,
        slots,
        copier,
        predicate,
        doc,
        conc_name,
    ] = args
    else {
        return Err(Raise::program("A structure definition is malformed."));
    };
    let mut layout = StructureLayout {
        slots: Vec::new(),
        conc_name: conc_name.as_text().unwrap_or_default().into(),
    };
    let mut accessors = Vec::new();
    for slot in slots.iter_list() {
        let parts = slot.list_to_vec().unwrap_or_default();
        if let [
            Value::Symbol(name, ..),
            Value::Symbol(accessor, ..),
            initform,
            slot_type,
            read_only,
        ] = parts.as_slice()
        {
            layout.slots.push(StructureSlot {
                name: *name,
                initform: initform.clone(),
                slot_type: slot_type.clone(),
                read_only: read_only.is_true(),
            });
            accessors.push(*accessor);
        }
    }
    let parent = parent.as_symbol().filter(|p| *p != known::NIL);
    let class = define_class(image, *name, parent, &layout, doc)?;
    for (index, (slot, accessor)) in layout.slots.iter().zip(accessors).enumerate() {
        accessors::define(image, &class, index, slot, accessor)?;
    }
    *class.structure.borrow_mut() = Some(Rc::new(layout));
    if let Some(copier) = copier.as_symbol().filter(|c| *c != known::NIL) {
        accessors::define_copier(image, &class, copier)?;
    }
    if let Some(predicate) = predicate.as_symbol().filter(|p| *p != known::NIL) {
        accessors::define_predicate(image, &class, predicate)?;
    }
    Ok((*name).into())
}

fn define_class(
    image: &mut Image,
    name: Sym,
    parent: Option<Sym>,
    layout: &StructureLayout,
    doc: &Value,
) -> Result<Rc<Class>, Box<Raise>> {
    let slots = layout
        .slots
        .iter()
        .map(|slot| SlotDefinition {
            slot_type: slot.slot_type.clone(),
            initform: constant_value(&slot.initform).map(Initform::Value),
            ..SlotDefinition::new(slot.name)
        })
        .collect();
    image.define_class(ClassDefinition {
        name,
        kind: ClassKind::Structure,
        superclasses: parent.into_iter().collect(),
        slots,
        default_initargs: Vec::new(),
        doc: doc.as_text().map(Into::into),
    })
}

/// Makes a structure: `(name slot-values…)`, the values in the order of the slots.
pub(crate) fn make_structure(image: &mut Image, args: &[Value]) -> Result<Value, Box<Raise>> {
    let Some((Value::Symbol(name, ..), values)) = args.split_first() else {
        return Err(Raise::program("invalid number of arguments: 0"));
    };
    let class = image
        .class(*name)
        .cloned()
        .ok_or_else(|| no_class(image, *name))?;
    for (slot, value) in class.slots.borrow().iter().zip(values) {
        check_slot_type(image, &slot.slot_type, value)?;
    }
    if class.slots.borrow().len() != values.len() {
        return Err(Raise::simple(format!(
            "The structure {} was redefined; define its constructor again.",
            image.name(*name)
        )));
    }
    let instance = Instance::with_slots(class, values.to_vec());
    Ok(Value::Instance(Rc::new(instance)))
}

/// Checks that a slot may have a value. Types that need a function call are not checked.
pub(super) fn check_slot_type(
    image: &Image,
    slot_type: &Value,
    value: &Value,
) -> Result<(), Box<Raise>> {
    if slot_type.as_symbol() == Some(known::T) {
        return Ok(());
    }
    match typep(image, value, slot_type)? {
        TypeCheck::No => Err(Raise::type_error(value, slot_type.clone())),
        TypeCheck::Yes | TypeCheck::NeedsCall => Ok(()),
    }
}

/// `copy-structure`: a structure with the same slot values.
pub(crate) fn copy_structure(value: &Value) -> Result<Value, Box<Raise>> {
    match value {
        Value::Instance(instance) if instance.class().kind == ClassKind::Structure => {
            let slots = instance.slots.borrow().clone();
            let copy = Instance::with_slots(instance.class(), slots);
            Ok(Value::Instance(Rc::new(copy)))
        }
        other => Err(Raise::type_error(
            other,
            Value::symbol(known::STRUCTURE_OBJECT),
        )),
    }
}

//! The expansion of `defstruct`.

use super::constructors::constructor_form;
use super::options::{Representation, StructureDefinition};
use super::typed;
use crate::image::Image;
use crate::object::define::no_class;
use crate::object::text;
use crate::value::Value;
use crate::value::class::{ClassKind, StructureSlot};
use crate::value::form::{doc_form, form, quote};
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;

/// `(defstruct name-and-options [documentation] slots…)`.
pub(crate) fn expand_defstruct(image: &mut Image, whole: &Value) -> Result<Value, Box<Raise>> {
    let definition = StructureDefinition::read(image, whole)?;
    if !matches!(definition.representation, Representation::Instance) {
        return typed::expand(image, &definition);
    }
    let slots = all_slots(image, &definition)?;
    let name = definition.name;
    let mut forms = vec![definition_form(image, &definition, &slots)];
    for constructor in &definition.constructors {
        forms.push(constructor_form(
            image,
            constructor,
            &slots,
            |values| form![known::SYS_MAKE_STRUCTURE, quote(name); Value::list(values)],
        ));
    }
    forms.extend(print_method(image, &definition));
    forms.push(quote(name));
    Ok(form![known::PROGN; Value::list(forms)])
}

/// The included slots, with their overrides, and the structure's own.
fn all_slots(
    image: &Image,
    definition: &StructureDefinition,
) -> Result<Vec<StructureSlot>, Box<Raise>> {
    let Some((parent, overrides)) = &definition.include else {
        return Ok(definition.slots.clone());
    };
    let layout = image
        .class(*parent)
        .filter(|class| class.kind == ClassKind::Structure)
        .and_then(|class| class.structure.borrow().clone())
        .ok_or_else(|| no_class(image, *parent))?;
    let mut slots = layout.slots.clone();
    override_slots(image, &mut slots, overrides, *parent)?;
    for slot in &definition.slots {
        if slots
            .iter()
            .any(|s| image.name(s.name) == image.name(slot.name))
        {
            return Err(Raise::program(format!(
                "The structure {} has two slots named {}.",
                image.name(definition.name),
                image.name(slot.name)
            )));
        }
    }
    slots.extend(definition.slots.iter().cloned());
    Ok(slots)
}

/// Replaces included slots by the descriptions in the `:include` option.
pub(super) fn override_slots(
    image: &Image,
    slots: &mut [StructureSlot],
    overrides: &[StructureSlot],
    parent: Sym,
) -> Result<(), Box<Raise>> {
    for new in overrides {
        let name = image.name(new.name);
        let Some(slot) = slots.iter_mut().find(|s| image.name(s.name) == name) else {
            return Err(Raise::program(format!(
                "The included structure {} has no slot named {name}.",
                text(image, &parent.into())
            )));
        };
        slot.initform = new.initform.clone();
        slot.read_only |= new.read_only;
        if new.slot_type.as_symbol() != Some(known::T) {
            slot.slot_type = new.slot_type.clone();
        }
    }
    Ok(())
}

/// The call that defines the class and its functions.
fn definition_form(
    image: &mut Image,
    definition: &StructureDefinition,
    slots: &[StructureSlot],
) -> Value {
    let described: Vec<Value> = slots
        .iter()
        .map(|slot| {
            let accessor = definition.accessor(image, slot.name);
            form![
                slot.name,
                accessor,
                slot.initform.clone(),
                slot.slot_type.clone(),
                Value::bool(slot.read_only),
            ]
        })
        .collect();
    let parent = definition.include.as_ref().map(|(parent, _)| *parent);
    let or_nil = |sym: Option<Sym>| quote(sym.map_or(Value::NIL, Value::symbol));
    form![
        known::SYS_DEFINE_STRUCTURE,
        quote(definition.name),
        or_nil(parent),
        quote(Value::list(described)),
        or_nil(definition.copier),
        or_nil(definition.predicate),
        doc_form(definition.doc.as_ref()),
        Value::string(definition.conc_name.clone()),
    ]
}

/// The method of `print-object` that the printing options ask for.
fn print_method(image: &mut Image, definition: &StructureDefinition) -> Option<Value> {
    let (function, has_depth) = match (&definition.print_object, &definition.print_function) {
        (Some(function), _) => (function, false),
        (None, Some(function)) => (function, true),
        (None, None) => return None,
    };
    let object = image.gensym("OBJECT");
    let stream = image.gensym("STREAM");
    let function = form![known::FUNCTION, function.clone()];
    let mut call = vec![
        known::FUNCALL.into(),
        function,
        object.clone(),
        stream.clone(),
    ];
    if has_depth {
        call.push(Value::Int(0));
    }
    Some(form![
        known::DEFMETHOD,
        known::PRINT_OBJECT,
        form![form![object, definition.name], stream],
        Value::list(call),
    ])
}

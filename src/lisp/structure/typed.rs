//! Structures that are lists or vectors: `(:type list)`, `(:type vector)`.
//!
//! Their layout is kept on the property list of the name, for structures that include it.

use super::constructors::constructor_form;
use super::expand::override_slots;
use super::options::{Representation, StructureDefinition};
use crate::image::Image;
use crate::image::locks::Meaning;
use crate::object::define::no_class;
use crate::value::Value;
use crate::value::class::StructureSlot;
use crate::value::form::{form, quote};
use crate::value::function::Function;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::sequence::Sequence;
use crate::value::symbol::Sym;

/// One element of such a structure.
#[derive(Clone)]
enum Element {
    /// Unused.
    Gap,
    /// The name of the structure.
    Name(Sym),
    /// A slot.
    Slot(StructureSlot),
}

impl Element {
    /// As kept on a property list: `NIL`, a symbol or a list.
    fn value(&self) -> Value {
        match self {
            Element::Gap => Value::NIL,
            Element::Name(name) => (*name).into(),
            Element::Slot(slot) => form![
                slot.name,
                slot.initform.clone(),
                slot.slot_type.clone(),
                Value::bool(slot.read_only),
            ],
        }
    }

    fn from_value(value: &Value) -> Element {
        let parts = value.list_to_vec().unwrap_or_default();
        match (value, parts.as_slice()) {
            (_, [Value::Symbol(name, ..), initform, slot_type, read_only]) => {
                Element::Slot(StructureSlot {
                    name: *name,
                    initform: initform.clone(),
                    slot_type: slot_type.clone(),
                    read_only: read_only.is_true(),
                })
            }
            (Value::Symbol(known::NIL, ..), _) => Element::Gap,
            (Value::Symbol(name, ..), _) => Element::Name(*name),
            _ => Element::Gap,
        }
    }
}

/// The expansion of a definition with `:type`.
pub fn expand(image: &mut Image, definition: &StructureDefinition) -> Result<Value, Box<Raise>> {
    let elements = layout(image, definition)?;
    let slots: Vec<StructureSlot> = elements
        .iter()
        .filter_map(|e| match e {
            Element::Slot(slot) => Some(slot.clone()),
            _ => None,
        })
        .collect();
    let described: Vec<Value> = elements
        .iter()
        .map(|element| match element {
            Element::Slot(slot) => Value::cons(
                definition.accessor(image, slot.name).into(),
                element.value(),
            ),
            other => Value::cons(Value::NIL, other.value()),
        })
        .collect();
    let or_nil = |sym: Option<Sym>| quote(sym.map_or(Value::NIL, Value::symbol));
    let mut forms = vec![form![
        known::SYS_DEFINE_TYPED_STRUCTURE,
        quote(definition.name),
        quote(Value::list(described)),
        or_nil(definition.copier),
        or_nil(definition.predicate),
    ]];
    let element_type = match &definition.representation {
        Representation::Vector(element_type) => element_type.clone(),
        _ => Value::T,
    };
    let maker = match definition.representation {
        Representation::List => known::LIST,
        _ => known::VECTOR,
    };
    for constructor in &definition.constructors {
        forms.push(constructor_form(image, constructor, &slots, |values| {
            let mut values = values.into_iter();
            let items = elements.iter().map(|element| match element {
                Element::Gap => Value::NIL,
                Element::Name(name) => quote(*name),
                Element::Slot(_) => values.next().unwrap_or(Value::NIL),
            });
            let items: Vec<Value> = items.collect();
            if element_type.as_symbol() == Some(known::T) {
                return form![maker; Value::list(items)];
            }
            let contents = form![known::LIST; Value::list(items.iter().cloned())];
            form![
                known::MAKE_ARRAY,
                items.len(),
                known::K_ELEMENT_TYPE,
                quote(element_type.clone()),
                known::K_INITIAL_CONTENTS,
                contents,
            ]
        }));
    }
    forms.push(quote(definition.name));
    Ok(form![known::PROGN; Value::list(forms)])
}

/// The elements of the structure, included ones first.
fn layout(image: &Image, definition: &StructureDefinition) -> Result<Vec<Element>, Box<Raise>> {
    let mut elements = Vec::new();
    if let Some((parent, overrides)) = &definition.include {
        let plist = image.symbol(*parent).plist.clone();
        let kept = property(&plist, known::SYS_DEFINE_TYPED_STRUCTURE);
        let kept = kept.ok_or_else(|| no_class(image, *parent))?;
        elements.extend(kept.iter_list().map(|e| Element::from_value(&e)));
        let mut slots: Vec<StructureSlot> = Vec::new();
        for element in &elements {
            if let Element::Slot(slot) = element {
                slots.push(slot.clone());
            }
        }
        override_slots(image, &mut slots, overrides, *parent)?;
        let mut slots = slots.into_iter();
        for element in &mut elements {
            if let Element::Slot(slot) = element
                && let Some(new) = slots.next()
            {
                *slot = new;
            }
        }
    }
    elements.extend((0..definition.initial_offset).map(|_| Element::Gap));
    if definition.is_named {
        elements.push(Element::Name(definition.name));
    }
    elements.extend(definition.slots.iter().cloned().map(Element::Slot));
    Ok(elements)
}

fn property(plist: &Value, indicator: Sym) -> Option<Value> {
    let items: Vec<Value> = plist.iter_list().collect();
    items
        .chunks_exact(2)
        .find(|pair| pair[0].as_symbol() == Some(indicator))
        .map(|pair| pair[1].clone())
}

/// Defines the functions of a structure that is a list or vector:
/// `(name ((accessor . element)…) copier predicate)`.
pub(crate) fn define_typed_structure(
    image: &mut Image,
    args: &[Value],
) -> Result<Value, Box<Raise>> {
    let [Value::Symbol(name, ..), described, copier, predicate] = args else {
        return Err(Raise::program("A structure definition is malformed."));
    };
    let mut elements = Vec::new();
    for (index, entry) in described.iter_list().enumerate() {
        let element = entry.cdr_or_nil();
        if let (Some(accessor), Element::Slot(slot)) = (
            entry.car_or_nil().as_symbol(),
            Element::from_value(&element),
        ) {
            image.check_lock(accessor, Meaning::Function)?;
            define_accessor(image, accessor, index, slot.read_only);
        }
        elements.push(element);
    }
    if let Some(copier) = copier.as_symbol().filter(|c| *c != known::NIL) {
        let function = Function::pure_of(copier, (1, Some(1)), (), |(), _, args| {
            let sequence = Sequence::of(&args[0])?;
            sequence.kind().make(sequence.all()?)
        });
        image.check_lock(copier, Meaning::Function)?;
        image.set_function(copier, function);
    }
    if let Some(predicate) = predicate.as_symbol().filter(|p| *p != known::NIL) {
        image.check_lock(predicate, Meaning::Function)?;
        define_predicate(image, predicate, *name, &elements);
    }
    let data = image.symbols.get_mut(*name);
    data.plist = Value::list_with_tail(
        [
            known::SYS_DEFINE_TYPED_STRUCTURE.into(),
            Value::list(elements),
        ],
        data.plist.clone(),
    );
    Ok((*name).into())
}

fn define_accessor(image: &mut Image, accessor: Sym, index: usize, read_only: bool) {
    let reader = Function::pure_of(accessor, (1, Some(1)), (), move |(), _, args| {
        Sequence::of(&args[0])?.get(index)
    });
    image.set_function(accessor, reader);
    let writer = (!read_only).then(|| {
        Function::pure_of(accessor, (2, Some(2)), (), move |(), _, args| {
            Sequence::of(&args[1])?.set(index, args[0].clone())?;
            Ok(args[0].clone())
        })
    });
    image.symbols.get_mut(accessor).setf_function = writer;
}

fn define_predicate(image: &mut Image, predicate: Sym, name: Sym, elements: &[Value]) {
    let position = elements
        .iter()
        .rposition(|e| e.as_symbol() == Some(name))
        .unwrap_or_default();
    let function = Function::pure_of(predicate, (1, Some(1)), (), move |(), _, args| {
        let found = match &args[0] {
            Value::Cons(_) | Value::Vector(_) => Sequence::of(&args[0])?.get(position).ok(),
            _ => None,
        };
        Ok(Value::bool(
            found.is_some_and(|found| found.as_symbol() == Some(name)),
        ))
    });
    image.set_function(predicate, function);
}

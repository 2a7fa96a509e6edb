//! Defining classes: new ones, redefinitions, and what subclasses inherit.

use std::rc::Rc;

use super::near_class::near_class;
use super::precedence::precedence_list;
use crate::image::Image;
use crate::image::locks::Meaning;
use crate::value::class::{Class, ClassKind, Initform, OldSlot, SlotDefinition};
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;

/// What a definition says about a class.
pub struct ClassDefinition {
    pub name: Sym,
    /// What its instances are.
    pub kind: ClassKind,
    /// Direct superclasses in order; the root of the kind is added when there are none.
    pub superclasses: Vec<Sym>,
    /// Slots of this class itself.
    pub slots: Vec<SlotDefinition>,
    /// Default initargs of this class itself.
    pub default_initargs: Vec<(Sym, Initform)>,
    /// The documentation.
    pub doc: Option<Rc<str>>,
}

impl Image {
    /// Defines a class, or redefines it: the class object stays, instances update
    /// themselves when they are next used.
    pub fn define_class(&mut self, definition: ClassDefinition) -> Result<Rc<Class>, Box<Raise>> {
        self.check_lock(definition.name, Meaning::Type)?;
        if let Some(class) = self.classes.get(&definition.name)
            && class.kind == ClassKind::Builtin
        {
            return Err(Raise::simple(format!(
                "The class {} is built in and cannot be redefined.",
                self.name(definition.name)
            )));
        }
        for name in &definition.superclasses {
            self.check_superclass(*name, &definition)?;
        }
        self.define_unchecked(definition)
    }

    /// Like `define_class`, for the implementation's own classes: kinds may be mixed.
    pub fn define_unchecked(
        &mut self,
        definition: ClassDefinition,
    ) -> Result<Rc<Class>, Box<Raise>> {
        let name = definition.name;
        let supers = self.superclasses(&definition);
        let class = match self.classes.get(&name) {
            Some(class) if class.kind == definition.kind && has_name(class, name) => class.clone(),
            _ => Rc::new(Class::new(name, definition.kind)),
        };
        if supers.iter().any(|s| depends_on(s, &class)) {
            return Err(Raise::simple(format!(
                "The class {} cannot be a superclass of itself.",
                self.name(name)
            )));
        }
        relink(&class, supers);
        let slots = keep_shared(&class, definition.slots);
        *class.direct_slots.borrow_mut() = slots;
        *class.direct_default_initargs.borrow_mut() = definition.default_initargs;
        *class.doc.borrow_mut() = definition.doc;
        class.is_defined.set(true);
        finalize(&class)?;
        self.classes.insert(name, class.clone());
        Ok(class)
    }

    /// May the named class be a direct superclass?
    fn check_superclass(&self, name: Sym, definition: &ClassDefinition) -> Result<(), Box<Raise>> {
        let allowed = match self.classes.get(&name) {
            Some(class) => class.kind == definition.kind || class.name == known::T,
            None if definition.kind == ClassKind::Standard => true,
            None => return Err(no_class(self, name)),
        };
        if allowed {
            return Ok(());
        }
        Err(Raise::simple(format!(
            "The class {} cannot be a superclass of {}.",
            self.name(name),
            self.name(definition.name)
        )))
    }

    /// The classes with the superclass names, undefined ones among them as placeholders. Without
    /// superclasses, the root of the kind is the only one.
    fn superclasses(&mut self, definition: &ClassDefinition) -> Vec<Rc<Class>> {
        let mut supers = Vec::new();
        for name in &definition.superclasses {
            let class = self
                .classes
                .entry(*name)
                .or_insert_with(|| Rc::new(Class::new(*name, definition.kind)));
            supers.push(class.clone());
        }
        let root = match definition.kind {
            ClassKind::Builtin => None,
            ClassKind::Standard => Some(known::STANDARD_OBJECT),
            ClassKind::Structure => Some(known::STRUCTURE_OBJECT),
            ClassKind::Condition => Some(known::CONDITION),
        };
        if supers.is_empty()
            && let Some(class) = root.and_then(|root| self.classes.get(&root))
        {
            supers.push(class.clone());
        }
        supers
    }
}

/// The error for a name that is not the name of a class.
pub(crate) fn no_class(image: &Image, name: Sym) -> Box<Raise> {
    let shown = crate::print::qualified(image, &name.into());
    let mut report = format!("There is no class named {shown}.");
    if let Some(near) = near_class(image, name) {
        let near = super::text(image, &near.into());
        report.push_str(&format!(" Did you mean {near}?"));
    }
    Raise::new(known::CLASS_NOT_FOUND_ERROR, report).with(known::K_NAME, name.into())
}

/// Is a name the proper name of a class?
fn has_name(class: &Class, name: Sym) -> bool {
    class.class_name().as_symbol() == Some(name)
}

/// Is `other` the class itself or, directly or not, among its superclasses?
fn depends_on(class: &Rc<Class>, other: &Rc<Class>) -> bool {
    let mut pending = vec![class.clone()];
    while let Some(current) = pending.pop() {
        if Rc::ptr_eq(&current, other) {
            return true;
        }
        pending.extend(current.direct_superclasses.borrow().iter().cloned());
    }
    false
}

/// The new slots of a class. Slots that were shared and still are keep their values; others that
/// are shared get theirs, if it is a constant.
fn keep_shared(class: &Class, mut slots: Vec<SlotDefinition>) -> Vec<SlotDefinition> {
    let old_slots = class.direct_slots.borrow();
    for slot in &mut slots {
        let Some(new) = &slot.shared else { continue };
        let old = old_slots.iter().find(|old| old.name == slot.name);
        match (old.and_then(|old| old.shared.clone()), &slot.initform) {
            (Some(old), _) => slot.shared = Some(old),
            (None, Some(Initform::Value(value))) => new.set(value.clone()),
            (None, _) => {}
        }
    }
    slots
}

/// Links a class and its direct superclasses to each other.
fn relink(class: &Rc<Class>, supers: Vec<Rc<Class>>) {
    for old in class.direct_superclasses.borrow().iter() {
        old.direct_subclasses
            .borrow_mut()
            .retain(|c| !Rc::ptr_eq(c, class));
    }
    for superclass in &supers {
        superclass
            .direct_subclasses
            .borrow_mut()
            .push(class.clone());
    }
    *class.direct_superclasses.borrow_mut() = supers;
}

/// Computes what a class inherits, then what its subclasses do.
fn finalize(class: &Rc<Class>) -> Result<(), Box<Raise>> {
    let mut pending = vec![class.clone()];
    while let Some(current) = pending.pop() {
        if !current.is_defined.get() {
            continue;
        }
        let old_layout = layout(&current);
        let was_complete = !current.precedence.borrow().is_empty();
        let order = precedence_list(&current)?.unwrap_or_default();
        let slots = effective_slots(&order, &current);
        let defaults = effective_default_initargs(&order);
        *current.precedence.borrow_mut() = order;
        *current.slots.borrow_mut() = slots;
        *current.default_initargs.borrow_mut() = defaults;
        if was_complete {
            supersede(&current, old_layout);
        }
        pending.extend(current.direct_subclasses.borrow().iter().cloned());
    }
    Ok(())
}

/// The slots that the instances of a class have.
fn layout(class: &Class) -> Vec<OldSlot> {
    let slots = class.slots.borrow();
    let shared = |slot: &SlotDefinition| slot.shared.as_ref().map(|shared| shared.get());
    slots.iter().map(|slot| (slot.name, shared(slot))).collect()
}

/// Begins a generation of a class, the one before having had a layout.
fn supersede(class: &Class, old_layout: Vec<OldSlot>) {
    class.old_layouts.borrow_mut().push(old_layout);
    let next = class.generation.get().wrapping_add(1);
    class.generation.set(next);
}

/// Lets the instances of a class and of those below it be brought up to date when they are next used.
pub(crate) fn make_obsolete(class: &Rc<Class>) {
    let mut pending = vec![class.clone()];
    let mut done: Vec<Rc<Class>> = Vec::new();
    while let Some(current) = pending.pop() {
        if done.iter().any(|other| Rc::ptr_eq(other, &current)) {
            continue;
        }
        if !current.precedence.borrow().is_empty() {
            supersede(&current, layout(&current));
        }
        pending.extend(current.direct_subclasses.borrow().iter().cloned());
        done.push(current);
    }
}

/// All slots of a class, those of the most general class first.
fn effective_slots(order: &[Rc<Class>], class: &Rc<Class>) -> Vec<SlotDefinition> {
    let mut slots: Vec<SlotDefinition> = Vec::new();
    for each in order.iter().rev() {
        let own = Rc::ptr_eq(each, class);
        for direct in each.direct_slots.borrow().iter() {
            match slots.iter_mut().find(|s| s.name == direct.name) {
                Some(slot) => override_slot(slot, direct),
                None => slots.push(direct.clone()),
            }
        }
        if own {
            break;
        }
    }
    slots
}

/// Applies to a slot what a more specific definition of it changes.
fn override_slot(slot: &mut SlotDefinition, specific: &SlotDefinition) {
    for initarg in &specific.initargs {
        if !slot.initargs.contains(initarg) {
            slot.initargs.push(*initarg);
        }
    }
    if specific.initform.is_some() {
        slot.initform = specific.initform.clone();
    }
    slot.shared = specific.shared.clone();
    if specific.slot_type.as_symbol() != Some(known::T) {
        slot.slot_type = specific.slot_type.clone();
    }
    if specific.doc.is_some() {
        slot.doc = specific.doc.clone();
    }
}

fn effective_default_initargs(order: &[Rc<Class>]) -> Vec<(Sym, Initform)> {
    let mut defaults: Vec<(Sym, Initform)> = Vec::new();
    for class in order {
        for (key, form) in class.direct_default_initargs.borrow().iter() {
            if !defaults.iter().any(|(k, _)| k == key) {
                defaults.push((*key, form.clone()));
            }
        }
    }
    defaults
}

//! Classes and their instances: standard objects, structures and conditions.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use super::Value;
use super::cycles::Mark;
use super::function::Function;
use super::generic::Method;
use super::release::release_values;
use super::shared_slot::SharedSlot;
use super::symbol::Sym;

/// What instances of a class are.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ClassKind {
    /// Values that are not instances: numbers, conses, functions, …
    Builtin,
    /// Objects of `defclass`.
    Standard,
    /// Objects of `defstruct`.
    Structure,
    /// Objects of `define-condition`.
    Condition,
}

/// Where the initial value of a slot comes from.
#[derive(Clone)]
pub enum Initform {
    /// A constant.
    Value(Value),
    /// A function of no arguments that computes it.
    Function(Rc<Function>),
}

/// A slot as a class defines it.
#[derive(Clone)]
pub struct SlotDefinition {
    /// The slot's name.
    pub name: Sym,
    /// Keywords that initialise it.
    pub initargs: Vec<Sym>,
    /// Its initial value, if any.
    pub initform: Option<Initform>,
    /// The shared place, for a slot with `:allocation :class`.
    pub shared: Option<Rc<SharedSlot>>,
    /// The declared type, `T` if none.
    pub(crate) slot_type: Value,
    /// The documentation.
    pub doc: Option<Rc<str>>,
}

/// A slot of an earlier definition: its name, and the value that it had if it was shared.
pub(crate) type OldSlot = (Sym, Option<Value>);

impl SlotDefinition {
    /// A slot with nothing but a name.
    pub fn new(name: Sym) -> SlotDefinition {
        SlotDefinition {
            name,
            initargs: Vec::new(),
            initform: None,
            shared: None,
            slot_type: Value::T,
            doc: None,
        }
    }
}

/// A slot of a structure as `defstruct` defines it, kept for structures that include it.
#[derive(Clone)]
pub struct StructureSlot {
    /// The slot's name.
    pub name: Sym,
    /// The form of its initial value.
    pub initform: Value,
    /// The declared type, `T` if none.
    pub(crate) slot_type: Value,
    /// Is assignment to the slot forbidden?
    pub(crate) read_only: bool,
}

/// What `defstruct` knows about a structure beyond its class.
#[derive(Clone, Default)]
pub struct StructureLayout {
    /// All slots, included ones first.
    pub slots: Vec<StructureSlot>,
    /// The prefix of the accessors.
    pub(crate) conc_name: Rc<str>,
}

pub struct Class {
    pub name: Sym,
    /// What its instances are.
    pub kind: ClassKind,
    /// Direct superclasses, as in the definition.
    pub(crate) direct_superclasses: RefCell<Vec<Rc<Class>>>,
    /// Direct subclasses, in order of definition.
    pub direct_subclasses: RefCell<Vec<Rc<Class>>>,
    /// This class and all its superclasses, most specific first; empty while a superclass
    /// is not defined yet.
    pub precedence: RefCell<Vec<Rc<Class>>>,
    /// Slots defined by this class itself.
    pub direct_slots: RefCell<Vec<SlotDefinition>>,
    /// All slots, inherited ones first; the order is that of an instance's slot values.
    pub slots: RefCell<Vec<SlotDefinition>>,
    /// `:default-initargs` of this class itself.
    pub(crate) direct_default_initargs: RefCell<Vec<(Sym, Initform)>>,
    /// `:default-initargs` of this class and its superclasses, most specific first.
    pub default_initargs: RefCell<Vec<(Sym, Initform)>>,
    /// The methods that read and write its slots; a redefinition replaces them.
    pub(crate) accessors: RefCell<Vec<Rc<Method>>>,
    /// The report of a condition class: a function of condition and stream.
    pub report: RefCell<Option<Rc<Function>>>,
    /// What `defstruct` remembers of a structure.
    pub structure: RefCell<Option<Rc<StructureLayout>>>,
    /// The documentation.
    pub doc: RefCell<Option<Rc<str>>>,
    /// Counts redefinitions, so that instances know when to update.
    pub(crate) generation: Cell<u32>,
    /// Names of all slots in each generation before the current one.
    pub(crate) old_layouts: RefCell<Vec<Vec<OldSlot>>>,
    /// False while the class is only named as a superclass.
    pub is_defined: Cell<bool>,
    /// What `(setf class-name)` has set; the class keeps the name under which it was defined if none.
    pub given_name: RefCell<Option<Value>>,
}

impl Class {
    /// A class without superclasses or slots; the image completes it.
    pub fn new(name: Sym, kind: ClassKind) -> Class {
        Class {
            name,
            kind,
            direct_superclasses: RefCell::default(),
            direct_subclasses: RefCell::default(),
            precedence: RefCell::default(),
            direct_slots: RefCell::default(),
            slots: RefCell::default(),
            direct_default_initargs: RefCell::default(),
            default_initargs: RefCell::default(),
            accessors: RefCell::default(),
            report: RefCell::default(),
            structure: RefCell::default(),
            doc: RefCell::default(),
            generation: Cell::new(0),
            old_layouts: RefCell::default(),
            is_defined: Cell::new(false),
            given_name: RefCell::default(),
        }
    }

    /// Lets go of all that may hold the class itself: those above and below it, the methods that are
    /// specialized on it, and functions.
    pub fn let_go(&self) {
        let _above = self.direct_superclasses.take();
        let _below = self.direct_subclasses.take();
        let _order = self.precedence.take();
        let _slots = (self.direct_slots.take(), self.slots.take());
        let _values = (
            self.direct_default_initargs.take(),
            self.default_initargs.take(),
        );
        let _accessors = self.accessors.take();
        let _report = self.report.take();
    }

    /// What `class-name` returns.
    pub fn class_name(&self) -> Value {
        let given = self.given_name.borrow().clone();
        given.unwrap_or_else(|| self.name.into())
    }

    /// Is this class the other one, or a subclass of it?
    pub(crate) fn is_within(&self, other: &Class) -> bool {
        std::ptr::eq(self, other)
            || self
                .precedence
                .borrow()
                .iter()
                .any(|class| std::ptr::eq(class.as_ref(), other))
    }

    /// Is this class the named one, or a subclass of it?
    pub(crate) fn is_subclass_of(&self, name: Sym) -> bool {
        self.name == name || self.precedence.borrow().iter().any(|c| c.name == name)
    }

    /// Position of a slot in an instance.
    #[inline]
    pub(crate) fn slot_index(&self, name: Sym) -> Option<usize> {
        self.slots.borrow().iter().position(|s| s.name == name)
    }
}

/// An instance of a standard class, a structure or a condition.
pub struct Instance {
    pub class: RefCell<Rc<Class>>,
    /// Slot values in the order of the class's slots; `Unbound` where none.
    pub slots: RefCell<Vec<Value>>,
    /// The class's generation when the slots were laid out.
    pub(crate) generation: Cell<u32>,
    pub(super) mark: Mark,
}

impl Instance {
    /// An instance whose slots are all unbound.
    pub fn new(class: Rc<Class>) -> Instance {
        let count = class.slots.borrow().len();
        Instance {
            generation: Cell::new(class.generation.get()),
            slots: RefCell::new(vec![Value::Unbound; count]),
            class: RefCell::new(class),
            mark: Mark::default(),
        }
    }

    /// An instance with the given slot values, in the order of the class's slots.
    pub(crate) fn with_slots(class: Rc<Class>, slots: Vec<Value>) -> Instance {
        Instance {
            generation: Cell::new(class.generation.get()),
            slots: RefCell::new(slots),
            class: RefCell::new(class),
            mark: Mark::default(),
        }
    }

    /// The instance's class.
    pub fn class(&self) -> Rc<Class> {
        self.class.borrow().clone()
    }

    /// Is the instance of the named class or a subclass?
    pub fn is_a(&self, name: Sym) -> bool {
        self.class.borrow().is_subclass_of(name)
    }

    /// Was the class redefined since the slots were laid out?
    pub(crate) fn is_obsolete(&self) -> bool {
        self.generation.get() != self.class.borrow().generation.get()
    }

    /// The value of a slot; `None` if there is no such slot, `Unbound` if it has no value.
    pub fn slot(&self, name: Sym) -> Option<Value> {
        let class = self.class.borrow();
        let index = class.slot_index(name)?;
        if let Some(shared) = &class.slots.borrow()[index].shared {
            return Some(shared.get());
        }
        self.slots.borrow().get(index).cloned()
    }

    /// Sets a slot; false if there is no such slot.
    pub(crate) fn set_slot(&self, name: Sym, value: Value) -> bool {
        let class = self.class.borrow();
        let Some(index) = class.slot_index(name) else {
            return false;
        };
        if let Some(shared) = &class.slots.borrow()[index].shared {
            shared.set(value);
            return true;
        }
        match self.slots.borrow_mut().get_mut(index) {
            Some(slot) => {
                *slot = value;
                true
            }
            None => false,
        }
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        release_values(self.slots.take());
    }
}

#[cfg(test)]
mod tests {
    use crate::value::class::*;
    use crate::value::symbol::known;

    #[test]
    fn a_chain_of_a_million_instances_is_freed_without_recursion() {
        let class = Rc::new(Class::new(known::T, ClassKind::Structure));
        let mut chain = Value::NIL;
        for i in 0..1_000_000 {
            let mut next = chain;
            if i % 3 == 0 {
                next = Value::list([next]);
            }
            let instance = Instance::with_slots(class.clone(), vec![Value::Int(i), next]);
            chain = Value::Instance(Rc::new(instance));
        }
        drop(chain);
    }
}

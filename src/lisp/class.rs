//! Classes and their instances: standard objects, structures and conditions.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use super::function::Function;
use super::slot::Slot;
use super::symbol::Sym;
use super::value::Value;

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

/// A slot as a class defines it.
#[derive(Clone)]
pub struct SlotDefinition {
    /// The slot's name.
    pub name: Sym,
    /// Keywords that initialise it.
    pub initargs: Vec<Sym>,
    /// A function of no arguments that computes the initial value.
    pub initform: Option<Rc<Function>>,
    /// The shared place, for a slot with `:allocation :class`.
    pub shared: Option<Rc<Slot>>,
    /// The declared type, `T` if none.
    pub slot_type: Value,
    /// The documentation.
    pub doc: Option<Rc<str>>,
}

/// A class.
pub struct Class {
    /// The name.
    pub name: Sym,
    /// What its instances are.
    pub kind: ClassKind,
    /// Direct superclasses, as in the definition.
    pub direct_superclasses: RefCell<Vec<Rc<Class>>>,
    /// Direct subclasses, in order of definition.
    pub direct_subclasses: RefCell<Vec<Rc<Class>>>,
    /// This class and all its superclasses, most specific first.
    pub precedence: RefCell<Vec<Rc<Class>>>,
    /// Slots defined by this class itself.
    pub direct_slots: RefCell<Vec<SlotDefinition>>,
    /// All slots, inherited ones first; the order is that of an instance's slot values.
    pub slots: RefCell<Vec<SlotDefinition>>,
    /// `:default-initargs` with the functions that compute them, most specific first.
    pub default_initargs: RefCell<Vec<(Sym, Rc<Function>)>>,
    /// The report of a condition class: a function of condition and stream.
    pub report: RefCell<Option<Rc<Function>>>,
    /// How a structure prints: its name for `#S(…)`, or a function.
    pub printer: RefCell<Option<Rc<Function>>>,
    /// The documentation.
    pub doc: RefCell<Option<Rc<str>>>,
    /// Counts redefinitions, so that instances know when to update.
    pub generation: Cell<u32>,
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
            default_initargs: RefCell::default(),
            report: RefCell::default(),
            printer: RefCell::default(),
            doc: RefCell::default(),
            generation: Cell::new(0),
        }
    }

    /// Is this class the named one, or a subclass of it?
    pub fn is_subclass_of(&self, name: Sym) -> bool {
        self.name == name || self.precedence.borrow().iter().any(|c| c.name == name)
    }

    /// Position of a slot in an instance.
    pub fn slot_index(&self, name: Sym) -> Option<usize> {
        self.slots.borrow().iter().position(|s| s.name == name)
    }
}

/// An instance of a standard class, a structure or a condition.
pub struct Instance {
    /// Its class.
    pub class: RefCell<Rc<Class>>,
    /// Slot values in the order of the class's slots; `Unbound` where none.
    pub slots: RefCell<Vec<Value>>,
    /// The class's generation when the slots were laid out.
    pub generation: Cell<u32>,
}

impl Instance {
    /// An instance whose slots are all unbound.
    pub fn new(class: Rc<Class>) -> Instance {
        let count = class.slots.borrow().len();
        Instance {
            generation: Cell::new(class.generation.get()),
            slots: RefCell::new(vec![Value::Unbound; count]),
            class: RefCell::new(class),
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
    pub fn set_slot(&self, name: Sym, value: Value) -> bool {
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

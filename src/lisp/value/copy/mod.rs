//! Copies of values for a copy of the image that they belong to.
//!
//! What can change is copied, and what refers to it: variables, pairs, arrays, tables, instances,
//! classes, generic functions. What can never change is shared: numbers, texts of names, operations
//! of compiled code, builtins. Two references to one object become two references to one copy, so the
//! copy cannot be told from the original. Nothing that is done to one is noticed in the other.
//!
//! Objects that can be changed are made empty first and filled later, in a loop: structures of any
//! depth, and circles, cost no Rust stack. What a copy cannot have, such as an open file or something
//! that runs, is refused: then there is no copy of the image at all.

mod classes;
mod functions;
mod streams;

use std::any::Any;
use std::cell::RefCell;
use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};
use std::rc::Rc;

use crate::value::Value;
use crate::value::array::{Array, Vector};
use crate::value::class::{Class, Instance};
use crate::value::code::Code;
use crate::value::cons::Cons;
use crate::value::cycles;
use crate::value::elements::{Displacement, Elements};
use crate::value::foreign::{ForeignBox, ForeignCopy};
use crate::value::function::{Body, Function};
use crate::value::generic::Method;
use crate::value::hash_table::{Entries, HashTable};
use crate::value::shared_slot::SharedSlot;
use crate::value::string::LispString;
use crate::value::symbol::{Holds, SymbolTable};

/// Something that a copy of the image has a copy of.
pub trait Copied: 'static {
    /// The copy. What it refers to may be filled later.
    fn copied(&self, copier: &mut Copier) -> Self;
}

/// Makes the copies of one image's values.
pub struct Copier {
    /// Copies of objects to which there is more than one reference, by the address of the original.
    copies: HashMap<usize, Value, BuildHasherDefault<AddressHasher>>,
    codes: HashMap<usize, Rc<Code>, BuildHasherDefault<AddressHasher>>,
    methods: HashMap<usize, Rc<Method>, BuildHasherDefault<AddressHasher>>,
    /// What holds the passing symbols of the copy.
    holds: Holds,
    /// Objects whose copies have to be filled, with these.
    pending: Vec<(Value, Value)>,
    /// Hash tables with their entries; their keys cannot be found until they are filled.
    tables: Vec<(Rc<HashTable>, Entries)>,
    depth: usize,
    refused: Option<&'static str>,
}

/// Spreads addresses, which are multiples of eight.
#[derive(Default)]
struct AddressHasher(u64);

impl Hasher for AddressHasher {
    fn finish(&self) -> u64 {
        self.0
    }

    fn write(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.write_usize(usize::from(*byte));
        }
    }

    fn write_usize(&mut self, address: usize) {
        let mixed = (self.0 ^ address as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        self.0 = mixed ^ (mixed >> 32);
    }
}

/// Could the object be met again, or be known by its address?
fn is_shared<T>(object: &Rc<T>) -> bool {
    Rc::strong_count(object) > 1 || Rc::weak_count(object) > 0
}

fn address<T>(object: &Rc<T>) -> usize {
    Rc::as_ptr(object).cast::<()>().addr()
}

/// Can the value never change, nor anything that it refers to?
pub(crate) fn is_fixed(value: &Value) -> bool {
    match value {
        Value::Symbol(_, hold) => hold.is_none(),
        Value::Int(_)
        | Value::Big(_)
        | Value::Ratio(_)
        | Value::Single(_)
        | Value::Double(_)
        | Value::Char(_)
        | Value::Package(_)
        | Value::Unbound => true,
        _ => false,
    }
}

impl Copier {
    /// For the values of an image with these symbols, and for the one with the symbols' copies.
    pub fn new(symbols: &SymbolTable) -> Copier {
        Copier {
            copies: HashMap::default(),
            codes: HashMap::default(),
            methods: HashMap::default(),
            holds: symbols.copied_holds(),
            pending: Vec::new(),
            tables: Vec::new(),
            depth: 0,
            refused: None,
        }
    }

    /// There can be no copy, because of this.
    pub fn refuse(&mut self, cause: &'static str) {
        self.refused.get_or_insert(cause);
    }

    /// What holds the passing symbols of the copy.
    pub fn holds(&mut self) -> &mut Holds {
        &mut self.holds
    }

    /// The copy of an object that has an address, if a copy has been asked for and the object may be
    /// known by its address.
    pub(crate) fn copy_at(&self, address: usize) -> Option<&Value> {
        self.copies.get(&address)
    }

    /// Fills all copies. Fails if something was refused.
    pub fn finish(&mut self) -> Result<(), &'static str> {
        while let Some((original, copy)) = self.pending.pop() {
            self.fill(&original, &copy);
            cycles::note_copy(&original, &copy);
        }
        for (table, entries) in std::mem::take(&mut self.tables) {
            if !table.set_entries(entries) {
                self.refuse("a hash table whose keys have been changed");
            }
        }
        self.refused.map_or(Ok(()), Err)
    }

    /// The copy of a value.
    pub fn value(&mut self, value: &Value) -> Value {
        match value {
            Value::Symbol(sym, hold) => match hold.is_none() {
                true => Value::symbol(*sym),
                false => self.holds.value(*sym),
            },
            Value::Cons(cons) => self.object(value, cons, |_, cons| {
                let copy = Cons::new(Value::Unbound, Value::Unbound);
                copy.set_place(cons.place());
                Value::Cons(Rc::new(copy))
            }),
            Value::Str(string) => Value::Str(self.string(string)),
            Value::Vector(vector) => self.object(value, vector, |_, vector| {
                Value::Vector(Rc::new(Vector {
                    fill_pointer: vector.fill_pointer.clone(),
                    adjustable: vector.adjustable,
                    ..Vector::of_type(vector.element_type, Vec::new())
                }))
            }),
            Value::Array(array) => self.object(value, array, |_, array| {
                let dimensions = array.dimensions.borrow().clone();
                Value::Array(Rc::new(Array {
                    adjustable: array.adjustable,
                    ..Array::new(array.element_type, dimensions, Vec::new())
                }))
            }),
            Value::Function(function) => Value::Function(self.function(function)),
            Value::Hash(table) => self.object(value, table, |_, table| {
                let copy = HashTable::new(table.test);
                copy.size.set(table.size.get());
                Value::Hash(Rc::new(copy))
            }),
            Value::Instance(instance) => self.object(value, instance, |copier, instance| {
                let class = copier.class(&instance.class.borrow());
                let copy = Instance::with_slots(class, Vec::new());
                copy.generation.set(instance.generation.get());
                Value::Instance(Rc::new(copy))
            }),
            Value::Class(class) => Value::Class(self.class(class)),
            Value::Stream(stream) => Value::Stream(self.stream(stream)),
            Value::Foreign(object) => self.foreign(object),
            Value::Cell(slot) => Value::Cell(self.slot(slot)),
            Value::Multiple(values) => Value::Multiple(Rc::new(self.all(values))),
            fixed => fixed.clone(),
        }
    }

    /// Copies of values.
    pub fn all(&mut self, values: &[Value]) -> Vec<Value> {
        values.iter().map(|value| self.value(value)).collect()
    }

    /// The copy of an object that is filled later; made unless there is one.
    fn object<T>(
        &mut self,
        original: &Value,
        object: &Rc<T>,
        make: impl FnOnce(&mut Copier, &T) -> Value,
    ) -> Value {
        let is_shared = is_shared(object);
        if is_shared && let Some(copy) = self.copies.get(&address(object)) {
            return copy.clone();
        }
        let copy = make(self, object);
        if is_shared {
            self.copies.insert(address(object), copy.clone());
        }
        self.pending.push((original.clone(), copy.clone()));
        copy
    }

    fn string(&mut self, string: &Rc<LispString>) -> Rc<LispString> {
        let is_shared = is_shared(string);
        if is_shared && let Some(Value::Str(copy)) = self.copies.get(&address(string)) {
            return copy.clone();
        }
        let copy = Rc::new(LispString::clone(string));
        if string.displacement().is_some() {
            let (original, copy) = (Value::Str(string.clone()), Value::Str(copy.clone()));
            self.pending.push((original, copy));
        }
        if is_shared {
            self.copies
                .insert(address(string), Value::Str(copy.clone()));
        }
        copy
    }

    fn slot(&mut self, slot: &Rc<SharedSlot>) -> Rc<SharedSlot> {
        let copy = self.object(&Value::Cell(slot.clone()), slot, |_, _| {
            Value::Cell(Rc::default())
        });
        match copy {
            Value::Cell(copy) => copy,
            _ => Rc::default(),
        }
    }

    fn foreign(&mut self, object: &Rc<ForeignBox>) -> Value {
        if let Some(copy) = self.copies.get(&address(object)) {
            return copy.clone();
        }
        let copy = match object.object().copied(self) {
            ForeignCopy::Same => Rc::clone(object),
            ForeignCopy::New(copy) => {
                let copy = Rc::new(ForeignBox::of(copy));
                let (original, copy) = (Value::Foreign(object.clone()), Value::Foreign(copy));
                self.pending.push((original, copy.clone()));
                self.copies.insert(address(object), copy.clone());
                return copy;
            }
            ForeignCopy::Refused(cause) => {
                self.refuse(cause);
                return Value::NIL;
            }
        };
        let copy = Value::Foreign(copy);
        self.copies.insert(address(object), copy.clone());
        copy
    }

    fn fill_elements(&mut self, original: &Elements, copy: &Elements) {
        match original.displacement() {
            Some(displacement) => copy.displace(self.displacement(&displacement)),
            None => copy.own(self.all(&original.to_vec())),
        }
    }

    fn displacement(&mut self, original: &Displacement) -> Displacement {
        Displacement {
            target: self.value(&original.target),
            offset: original.offset,
            size: original.size,
        }
    }

    /// Puts into a copy what the original holds.
    fn fill(&mut self, original: &Value, copy: &Value) {
        match (original, copy) {
            (Value::Cons(original), Value::Cons(copy)) => {
                copy.set_car(original.with_car(|car| self.value(car)));
                copy.set_cdr(original.with_cdr(|cdr| self.value(cdr)));
            }
            (Value::Vector(original), Value::Vector(copy)) => {
                self.fill_elements(&original.items, &copy.items);
            }
            (Value::Array(original), Value::Array(copy)) => {
                self.fill_elements(&original.items, &copy.items);
            }
            (Value::Str(original), Value::Str(copy)) => {
                if let Some(displacement) = original.displacement() {
                    copy.displace(self.displacement(&displacement));
                }
            }
            (Value::Hash(original), Value::Hash(copy)) => {
                let entries = original.entries();
                let entries = entries.iter().map(|entry| {
                    let (key, value) = entry.as_ref()?;
                    Some((self.value(key), self.value(value)))
                });
                let entries = entries.collect();
                self.tables.push((copy.clone(), entries));
            }
            (Value::Instance(original), Value::Instance(copy)) => {
                copy.slots.replace(self.all(&original.slots.borrow()));
            }
            (Value::Cell(original), Value::Cell(copy)) => {
                copy.set(original.with(|value| self.value(value)));
            }
            (Value::Stream(original), Value::Stream(copy)) => {
                copy.kind.replace(self.stream_kind(&original.kind.borrow()));
            }
            (Value::Class(original), Value::Class(copy)) => self.fill_class(original, copy),
            (Value::Function(original), Value::Function(copy)) => {
                if let (Body::Generic(original), Body::Generic(copy)) = (&original.body, &copy.body)
                {
                    self.fill_generic(original, copy);
                }
            }
            (Value::Foreign(original), Value::Foreign(copy)) => {
                let copy: &dyn Any = copy.object();
                original.object().fill_copy(copy, self);
            }
            _ => {}
        }
    }
}

impl Copied for () {
    fn copied(&self, _: &mut Copier) {}
}

impl Copied for Value {
    fn copied(&self, copier: &mut Copier) -> Value {
        copier.value(self)
    }
}

impl Copied for Rc<Class> {
    fn copied(&self, copier: &mut Copier) -> Rc<Class> {
        copier.class(self)
    }
}

impl Copied for Rc<Function> {
    fn copied(&self, copier: &mut Copier) -> Rc<Function> {
        copier.function(self)
    }
}

impl<A: Copied, B: Copied> Copied for (A, B) {
    fn copied(&self, copier: &mut Copier) -> (A, B) {
        (self.0.copied(copier), self.1.copied(copier))
    }
}

impl<T: Copied> Copied for Option<T> {
    fn copied(&self, copier: &mut Copier) -> Option<T> {
        self.as_ref().map(|value| value.copied(copier))
    }
}

impl<T: Copied> Copied for RefCell<T> {
    fn copied(&self, copier: &mut Copier) -> RefCell<T> {
        RefCell::new(self.borrow().copied(copier))
    }
}

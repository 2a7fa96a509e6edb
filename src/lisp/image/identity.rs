//! Made-up addresses: `{1001000003}`.
//!
//! Objects that cannot be read back are distinguished by a number that they get when they are first
//! printed. Real addresses would differ from run to run.

use std::collections::HashMap;
use std::rc::{Rc, Weak};

use super::Image;
use crate::value::Value;
use crate::value::array::{Array, Vector};
use crate::value::class::Instance;
use crate::value::copy::Copier;
use crate::value::foreign::ForeignBox;
use crate::value::function::Function;
use crate::value::hash_table::HashTable;
use crate::value::stream::Stream;

/// The first number.
const FIRST: u64 = 0x10_0100_0000;
/// The distance between consecutive numbers.
const STEP: u64 = 0x40;
/// The numbers of dead objects are forgotten when this many objects have one, and then whenever the
/// count has doubled since.
const SWEEP_FROM: usize = 1024;

enum Held {
    Instance(Weak<Instance>),
    Function(Weak<Function>),
    Hash(Weak<HashTable>),
    Stream(Weak<Stream>),
    Foreign(Weak<ForeignBox>),
    Vector(Weak<Vector>),
    Array(Weak<Array>),
}

impl Held {
    /// The object with its address and the low digit of its number.
    fn of(value: &Value) -> Option<(usize, u64, Held)> {
        Some(match value {
            Value::Instance(r) => (address(r), 0x3, Held::Instance(Rc::downgrade(r))),
            Value::Function(r) => (address(r), 0xB, Held::Function(Rc::downgrade(r))),
            Value::Hash(r) => (address(r), 0x3, Held::Hash(Rc::downgrade(r))),
            Value::Stream(r) => (address(r), 0x3, Held::Stream(Rc::downgrade(r))),
            Value::Foreign(r) => (address(r), 0x3, Held::Foreign(Rc::downgrade(r))),
            Value::Vector(r) => (address(r), 0xF, Held::Vector(Rc::downgrade(r))),
            Value::Array(r) => (address(r), 0xF, Held::Array(Rc::downgrade(r))),
            _ => return None,
        })
    }

    fn is_alive(&self) -> bool {
        let count = match self {
            Held::Instance(w) => w.strong_count(),
            Held::Function(w) => w.strong_count(),
            Held::Hash(w) => w.strong_count(),
            Held::Stream(w) => w.strong_count(),
            Held::Foreign(w) => w.strong_count(),
            Held::Vector(w) => w.strong_count(),
            Held::Array(w) => w.strong_count(),
        };
        count > 0
    }
}

fn address<T>(object: &Rc<T>) -> usize {
    Rc::as_ptr(object).cast::<()>() as usize
}

/// The numbers assigned to objects of an image.
#[derive(Default)]
pub struct Identities {
    /// By address; an address may have been used again, so the object is held weakly.
    entries: HashMap<usize, (u64, Held)>,
    given: u64,
    sweep_at: usize,
    /// Do objects without a number stay without one for now?
    is_aside: bool,
}

impl Identities {
    /// The numbers of the objects' copies.
    pub(super) fn copied(&self, copier: &Copier) -> Identities {
        let entries = self.entries.iter().filter_map(|(address, (number, held))| {
            let copy = held.is_alive().then(|| copier.copy_at(*address))??;
            let (address, _, held) = Held::of(copy)?;
            Some((address, (*number, held)))
        });
        Identities {
            entries: entries.collect(),
            given: self.given,
            sweep_at: self.sweep_at,
            is_aside: self.is_aside,
        }
    }

    fn number(&mut self, value: &Value) -> Option<u64> {
        let Some((address, tag, held)) = Held::of(value) else {
            return Some(FIRST);
        };
        if let Some((number, held)) = self.entries.get(&address)
            && held.is_alive()
        {
            return Some(*number);
        }
        if self.is_aside {
            return None;
        }
        if self.entries.len() >= self.sweep_at.max(SWEEP_FROM) {
            self.entries.retain(|_, (_, held)| held.is_alive());
            self.sweep_at = self.entries.len() * 2;
        }
        let number = FIRST + self.given * STEP + tag;
        self.given += 1;
        self.entries.insert(address, (number, held));
        Some(number)
    }
}

/// The made-up address of an object, in braces: the same one whenever it is printed.
pub fn identity(image: &Image, value: &Value) -> String {
    match image.printed.borrow_mut().number(value) {
        Some(number) => format!("{{{number:010X}}}"),
        None => "{…}".to_owned(),
    }
}

/// Prints something that is shown beside the session, such as a completion. Objects get no numbers
/// from that, so that the session's own output does not depend on it.
pub fn aside<T>(image: &Image, print: impl FnOnce() -> T) -> T {
    let was_aside = std::mem::replace(&mut image.printed.borrow_mut().is_aside, true);
    let printed = print();
    image.printed.borrow_mut().is_aside = was_aside;
    printed
}

//! Objects that may be parts of circles: weak references to those that were changed.

use std::rc::{Rc, Weak};

use crate::value::Value;
use crate::value::array::{Array, Vector};
use crate::value::class::Instance;
use crate::value::cons::Cons;
use crate::value::foreign::ForeignBox;
use crate::value::hash_table::HashTable;
use crate::value::shared_slot::SharedSlot;
use crate::value::symbol::WeakHold;

/// An object that may be a part of a circle.
pub enum Suspect {
    Cons(Weak<Cons>),
    Cell(Weak<SharedSlot>),
    Vector(Weak<Vector>),
    Array(Weak<Array>),
    Hash(Weak<HashTable>),
    Instance(Weak<Instance>),
    Foreign(Weak<ForeignBox>),
    Symbol(WeakHold),
}

macro_rules! suspects {
    ($($kind:ident $type:ty,)*) => {$(
        impl From<&Rc<$type>> for Suspect {
            fn from(object: &Rc<$type>) -> Suspect {
                Suspect::$kind(Rc::downgrade(object))
            }
        }
    )*

        impl Suspect {
            pub(super) fn object(&self) -> Option<Value> {
                Some(match self {
                    $(Suspect::$kind(weak) => Value::$kind(weak.upgrade()?),)*
                    Suspect::Symbol(weak) => weak.value()?,
                })
            }

            pub(super) fn is_alive(&self) -> bool {
                match self {
                    $(Suspect::$kind(weak) => weak.strong_count() > 0,)*
                    Suspect::Symbol(weak) => weak.is_alive(),
                }
            }
        }
    };
}

suspects! {
    Cons Cons,
    Cell SharedSlot,
    Vector Vector,
    Array Array,
    Hash HashTable,
    Instance Instance,
    Foreign ForeignBox,
}

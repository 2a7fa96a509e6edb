//! References that keep nothing alive.

use std::rc::{Rc, Weak};

use super::Value;
use super::array::{Array, Vector};
use super::class::{Class, Instance};
use super::cons::Cons;
use super::cycles;
use super::foreign::ForeignBox;
use super::function::Function;
use super::hash_table::HashTable;
use super::stream::Stream;
use super::string::LispString;

/// A reference to a value that may be gone.
pub enum Reference {
    Cons(Weak<Cons>),
    Str(Weak<LispString>),
    Vector(Weak<Vector>),
    Array(Weak<Array>),
    Function(Weak<Function>),
    Hash(Weak<HashTable>),
    Instance(Weak<Instance>),
    Class(Weak<Class>),
    Stream(Weak<Stream>),
    Foreign(Weak<ForeignBox>),
    /// Numbers, characters and symbols are always there.
    Kept(Value),
}

macro_rules! references {
    ($($kind:ident)*) => {
        impl Reference {
            /// A reference to a value.
            pub fn to(value: &Value) -> Reference {
                cycles::note_watched(value);
                match value {
                    $(Value::$kind(object) => Reference::$kind(Rc::downgrade(object)),)*
                    other => Reference::Kept(other.clone()),
                }
            }

            /// The value, if it is still there.
            pub fn value(&self) -> Option<Value> {
                match self {
                    $(Reference::$kind(object) => object.upgrade().map(Value::$kind),)*
                    Reference::Kept(value) => Some(value.clone()),
                }
            }
        }
    };
}

references!(Cons Str Vector Array Function Hash Instance Class Stream Foreign);

//! The dispatch cache of a generic function: the effective method for each key.

use std::rc::Rc;

use super::Value;
use super::class::Class;
use super::generic::{Combination, Method, Specializer};
use super::known;
use super::shared_slot::SharedSlot;
use super::symbol::Sym;

/// The methods of a call in the order in which they run.
pub struct Effective {
    /// The shape of the call.
    pub shape: Shape,
    /// Keywords that some applicable method accepts; none if they need no check.
    pub keys: Option<Vec<Sym>>,
    /// Number of arguments before the keywords.
    pub(crate) keys_from: usize,
}

/// The shape of a call.
pub enum Shape {
    /// No method applies.
    NotApplicable,
    /// Only a slot is read.
    Read(SlotPlace, Rc<Method>),
    /// Only a slot is written.
    Write(SlotPlace, Rc<Method>),
    /// One method that does not ask for the next one.
    Single(Rc<Method>),
    /// The standard combination, or one by an operator.
    Combined {
        /// `:around` methods.
        around: Vec<Rc<Method>>,
        /// `:before` methods.
        before: Vec<Rc<Method>>,
        /// Primary methods, or those that the operator combines.
        primary: Vec<Rc<Method>>,
        /// `:after` methods in the order in which they run: most specific last.
        after: Vec<Rc<Method>>,
        combination: Combination,
    },
}

/// Where an accessor's slot is stored in instances of the class in question.
pub enum SlotPlace {
    /// At this position of the instance.
    Local(usize),
    /// In the class.
    Shared(Rc<SharedSlot>),
}

/// Calls whose key has more parts than this are not cached.
pub(crate) const MAX_PARTS: usize = 4;
/// A cache with more keys than this is cleared.
pub(crate) const MAX_ENTRIES: usize = 256;

/// What one argument contributes to a key: a class by its address and generation, or a
/// small number with one of the two tags.
pub type Part = (usize, u32);
pub(crate) const BUILTIN_TAG: u32 = u32::MAX;
pub(crate) const EQL_TAG: u32 = u32::MAX - 1;

pub type Key = [Part; MAX_PARTS];
pub(crate) const NO_PART: Part = (0, 0);

/// An argument that decides which methods apply.
pub struct Position {
    pub index: usize,
    /// The values that `eql` specializers name.
    pub(crate) eql_values: Vec<Value>,
}

/// Which arguments decide, and the effective methods found so far.
#[derive(Default)]
pub struct Dispatch {
    /// The arguments that decide.
    pub positions: Vec<Position>,
    /// Effective methods by key.
    pub entries: Vec<(Key, Rc<Effective>)>,
    /// The classes whose addresses occur in keys; held so that none is reused.
    pub classes: Vec<Rc<Class>>,
}

impl Dispatch {
    /// The state for a changed set of methods.
    pub(crate) fn for_methods(methods: &[Rc<Method>]) -> Dispatch {
        let mut positions: Vec<Position> = Vec::new();
        for method in methods {
            for (index, specializer) in method.specializers.iter().enumerate() {
                let eql = match specializer {
                    Specializer::Class(class) if class.name == known::T => continue,
                    Specializer::Class(_) => None,
                    Specializer::Eql(value) => Some(value.clone()),
                };
                let at = match positions.iter().position(|p| p.index == index) {
                    Some(at) => at,
                    None => {
                        positions.push(Position {
                            index,
                            eql_values: Vec::new(),
                        });
                        positions.len() - 1
                    }
                };
                if let Some(value) = eql
                    && !positions[at].eql_values.iter().any(|v| v.is_eql(&value))
                {
                    positions[at].eql_values.push(value);
                }
            }
        }
        Dispatch {
            positions,
            ..Dispatch::default()
        }
    }

    /// The cached effective method, which is moved towards the front.
    #[inline]
    pub fn find(&mut self, key: &Key) -> Option<&Rc<Effective>> {
        let found = self.entries.iter().position(|(k, _)| k == key)?;
        let moved = found.saturating_sub(1);
        self.entries.swap(found, moved);
        Some(&self.entries[moved].1)
    }
}

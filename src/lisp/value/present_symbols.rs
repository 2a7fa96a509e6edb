//! The symbols that are present in a package, by name.

use std::cell::OnceCell;
use std::hash::BuildHasherDefault;
use std::rc::Rc;

use indexmap::IndexMap;

use super::key_hasher::KeyHasher;
use super::symbol::Sym;

/// Symbols by name; the flag tells whether the package exports the symbol. They are found by hashing,
/// and seen in the order of their names.
#[derive(Clone, Default)]
pub struct PresentSymbols {
    symbols: IndexMap<Rc<str>, (Sym, bool), BuildHasherDefault<KeyHasher>>,
    /// The places of the symbols in the table, in the order of their names, once that was asked for.
    order: OnceCell<Vec<usize>>,
}

impl PresentSymbols {
    /// The symbol with a name.
    #[inline]
    pub fn get(&self, name: &str) -> Option<&(Sym, bool)> {
        self.symbols.get(name)
    }

    /// The symbol with a name, which becomes present if there is none.
    pub(super) fn get_or_insert(&mut self, name: &Rc<str>, sym: Sym) -> &mut (Sym, bool) {
        let order = &mut self.order;
        self.symbols.entry(name.clone()).or_insert_with(|| {
            order.take();
            (sym, false)
        })
    }

    /// The symbol with a name, to be changed.
    pub(super) fn get_mut(&mut self, name: &str) -> Option<&mut (Sym, bool)> {
        self.symbols.get_mut(name)
    }

    /// Removes the symbol with a name.
    pub(super) fn remove(&mut self, name: &str) {
        if self.symbols.swap_remove(name).is_some() {
            self.order.take();
        }
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.symbols.len()
    }

    /// All of them, in the order of their names.
    pub fn iter(&self) -> impl Iterator<Item = (&Rc<str>, &(Sym, bool))> {
        let order = self.order.get_or_init(|| {
            let mut order: Vec<usize> = (0..self.symbols.len()).collect();
            order.sort_unstable_by_key(|at| self.symbols.get_index(*at).map(|(name, _)| name));
            order
        });
        order.iter().filter_map(|at| self.symbols.get_index(*at))
    }

    /// All of them without their names, in the order of these.
    pub fn values(&self) -> impl Iterator<Item = &(Sym, bool)> {
        self.iter().map(|(_, present)| present)
    }
}

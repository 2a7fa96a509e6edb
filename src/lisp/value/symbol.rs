//! Symbols: names with a value, a function and a property list.
//!
//! A symbol is an index into the image's symbol table. The symbols that Rust code names
//! have fixed indices, listed in [`known`].
//!
//! The symbols that a running program makes, by `gensym` or `intern` for example, are passing: the values
//! of such a symbol share a [`Hold`], and when the last of them is gone, so is what the table knows of the
//! symbol, its value, function and properties included. Compiled code holds the passing symbols that it
//! refers to. One that the reader has found, or that has been declared to mean something, stays; so does one
//! that belongs to a package, until it is removed from it.

use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, HashSet};
use std::hash::BuildHasherDefault;
use std::rc::{Rc, Weak};

use serde::{Deserialize, Serialize};

use super::Value;
use super::copy::{Copied, Copier};
use super::cycles::{self, Mark, Suspect};
use super::function::Function;
use super::key_hasher::KeyHasher;
use super::package::PackageId;

pub use super::known;

/// A symbol of an image.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug, Serialize, Deserialize)]
pub struct Sym(pub u32);

/// Symbols without an order.
pub(crate) type SymSet = HashSet<Sym, BuildHasherDefault<KeyHasher>>;

/// What a symbol means in function position.
#[derive(Clone, Default)]
pub enum FunctionCell {
    /// Nothing.
    #[default]
    Unbound,
    /// A function.
    Function(Rc<Function>),
    /// A macro: the function maps a whole form to its expansion.
    Macro(Rc<Function>),
    /// A macro or special operator that the compiler knows.
    Builtin,
}

impl FunctionCell {
    /// Is it a macro that a program has defined, not one of the language?
    pub fn is_macro_of_program(&self) -> bool {
        match self {
            FunctionCell::Macro(function) => function.as_deferred().is_none(),
            _ => false,
        }
    }
}

/// How a symbol behaves as a variable.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
pub enum VariableKind {
    /// Bindings are lexical.
    #[default]
    Lexical,
    /// Bindings are dynamic.
    Special,
    /// The value never changes.
    Constant,
}

/// What an image knows about a symbol.
pub struct SymbolData {
    pub name: Rc<str>,
    /// The home package; none if uninterned.
    pub package: Option<PackageId>,
    /// The global value.
    pub value: Value,
    /// How the symbol is bound as a variable.
    pub kind: VariableKind,
    /// The global function.
    pub function: FunctionCell,
    /// The function of `(setf (name …) …)`.
    pub setf_function: Option<Rc<Function>>,
    /// The property list.
    pub plist: Value,
    /// Expansion of a global symbol macro.
    pub symbol_macro: Option<Value>,
    /// Documentation as a variable, if any.
    pub variable_doc: Option<Rc<str>>,
    /// Documentation as a function that a program has given since its definition, if any.
    pub(crate) function_doc: Option<Rc<str>>,
    /// Does something refer to it that is no value?
    is_kept: Cell<bool>,
}

impl SymbolData {
    fn named(name: Rc<str>) -> SymbolData {
        SymbolData {
            name,
            package: None,
            value: Value::Unbound,
            kind: VariableKind::Lexical,
            function: FunctionCell::Unbound,
            setf_function: None,
            plist: Value::NIL,
            symbol_macro: None,
            variable_doc: None,
            function_doc: None,
            is_kept: Cell::new(false),
        }
    }

    fn copied(&self, copier: &mut Copier) -> SymbolData {
        SymbolData {
            name: self.name.clone(),
            package: self.package,
            value: copier.value(&self.value),
            kind: self.kind,
            function: match &self.function {
                FunctionCell::Function(f) => FunctionCell::Function(copier.function(f)),
                FunctionCell::Macro(f) => FunctionCell::Macro(copier.function(f)),
                other => other.clone(),
            },
            setf_function: self.setf_function.copied(copier),
            plist: copier.value(&self.plist),
            symbol_macro: self.symbol_macro.copied(copier),
            variable_doc: self.variable_doc.clone(),
            function_doc: self.function_doc.clone(),
            is_kept: self.is_kept.clone(),
        }
    }

    /// Has the symbol a meaning that somebody could ask for, who has only its index? Nobody else can ask
    /// for its value, its function and its properties.
    fn stays(&self) -> bool {
        self.is_kept.get()
            || self.package.is_some()
            || self.kind != VariableKind::Lexical
            || matches!(
                self.function,
                FunctionCell::Macro(_) | FunctionCell::Builtin
            )
            || self.symbol_macro.is_some()
    }
}

/// What holds the data of a passing symbol; nothing, for all others.
#[derive(Clone, Default)]
pub struct Hold(Option<Rc<Held>>);

impl Hold {
    /// For symbols that stay.
    pub const NONE: Hold = Hold(None);

    /// Does the symbol stay?
    pub fn is_none(&self) -> bool {
        self.0.is_none()
    }

    /// What the collector has written on the symbol.
    pub(super) fn mark(&self) -> Option<&Mark> {
        self.0.as_ref().map(|held| &held.mark)
    }

    /// The values of the symbol.
    pub(super) fn strong_count(&self) -> usize {
        self.0.as_ref().map_or(usize::MAX, Rc::strong_count)
    }
}

/// A reference to a passing symbol that does not hold it.
pub struct WeakHold(Weak<Held>);

impl WeakHold {
    /// The symbol, if it is still there.
    pub(super) fn value(&self) -> Option<Value> {
        let held = self.0.upgrade()?;
        Some(Value::Symbol(held.sym, Hold(Some(held))))
    }

    /// Is the symbol still there?
    pub(super) fn is_alive(&self) -> bool {
        self.0.strong_count() > 0
    }
}

/// What holds the passing symbols of a table that is being copied.
pub struct Holds {
    held: BTreeMap<u32, Rc<Held>>,
    gone: Rc<RefCell<Vec<Sym>>>,
}

impl Holds {
    /// A value of a passing symbol.
    pub(super) fn value(&mut self, sym: Sym) -> Value {
        Value::Symbol(sym, Hold(Some(self.held(sym).clone())))
    }

    fn held(&mut self, sym: Sym) -> &Rc<Held> {
        let gone = &self.gone;
        let hold = || Held::new(sym, gone);
        self.held.entry(sym.0).or_insert_with(hold)
    }
}

/// A passing symbol, and where its table is told that it is gone.
struct Held {
    sym: Sym,
    gone: Rc<RefCell<Vec<Sym>>>,
    mark: Mark,
}

impl Held {
    fn new(sym: Sym, gone: &Rc<RefCell<Vec<Sym>>>) -> Rc<Held> {
        Rc::new(Held {
            sym,
            gone: gone.clone(),
            mark: Mark::default(),
        })
    }
}

/// What a table knows of a passing symbol.
struct Passing {
    data: SymbolData,
    /// What holds it.
    held: Weak<Held>,
    /// Is it among those that may be in a circle?
    is_suspect: bool,
}

impl Drop for Held {
    fn drop(&mut self) {
        self.gone.borrow_mut().push(self.sym);
    }
}

/// The first index of passing symbols.
const PASSING: u32 = 1 << 31;

/// All symbols of an image.
pub struct SymbolTable {
    entries: Vec<SymbolData>,
    passing: BTreeMap<u32, Passing>,
    next_passing: u32,
    /// Passing symbols that no value refers to any more.
    gone: Rc<RefCell<Vec<Sym>>>,
    /// What is known of these.
    forgotten: SymbolData,
    /// Are the symbols passing that a program interns? Those of the library are not.
    is_library_complete: bool,
}

impl SymbolTable {
    /// An empty table.
    pub fn new() -> SymbolTable {
        SymbolTable {
            entries: Vec::with_capacity(8192),
            passing: BTreeMap::new(),
            next_passing: PASSING,
            gone: Rc::default(),
            forgotten: SymbolData::named("FORGOTTEN".into()),
            is_library_complete: false,
        }
    }

    /// From now on, the symbols that programs intern are passing.
    pub fn complete_library(&mut self) {
        self.is_library_complete = true;
    }

    /// Adds a symbol that belongs to no package, on behalf of a program.
    pub(crate) fn make_for_program(&mut self, name: Rc<str>) -> Value {
        match self.is_library_complete {
            true => self.make_passing(name),
            false => self.make(name).into(),
        }
    }

    /// Adds a symbol that belongs to no package yet.
    pub fn make(&mut self, name: Rc<str>) -> Sym {
        // More than two billion symbols do not fit in memory.
        let index = u32::try_from(self.entries.len()).unwrap_or(PASSING - 1);
        self.entries.push(SymbolData::named(name));
        Sym(index)
    }

    /// Adds a symbol that belongs to no package, and that is freed once no value refers to it.
    pub fn make_passing(&mut self, name: Rc<str>) -> Value {
        self.free_gone();
        while self.passing.contains_key(&self.next_passing) {
            self.count_on();
        }
        let sym = Sym(self.next_passing);
        let held = Held::new(sym, &self.gone);
        let passing = Passing {
            data: SymbolData::named(name),
            held: Rc::downgrade(&held),
            is_suspect: false,
        };
        self.passing.insert(sym.0, passing);
        self.count_on();
        Value::Symbol(sym, Hold(Some(held)))
    }

    /// What will hold the passing symbols of a copy.
    pub(super) fn copied_holds(&self) -> Holds {
        Holds {
            held: BTreeMap::new(),
            gone: Rc::new(RefCell::new(self.gone.borrow().clone())),
        }
    }

    /// A copy of the table, with copies of the symbols' values and functions.
    pub fn copied(&self, copier: &mut Copier) -> SymbolTable {
        let entries = self.entries.iter().map(|data| data.copied(copier));
        let entries = entries.collect();
        let passing = self.passing.iter();
        let passing = passing.map(|(sym, passing)| {
            let held = Rc::downgrade(copier.holds().held(Sym(*sym)));
            if passing.is_suspect {
                cycles::note_symbol(Suspect::Symbol(WeakHold(held.clone())));
            }
            let copy = Passing {
                data: passing.data.copied(copier),
                held,
                is_suspect: passing.is_suspect,
            };
            (*sym, copy)
        });
        SymbolTable {
            entries,
            passing: passing.collect(),
            next_passing: self.next_passing,
            gone: copier.holds().gone.clone(),
            forgotten: SymbolData::named(self.forgotten.name.clone()),
            is_library_complete: self.is_library_complete,
        }
    }

    /// A value of a symbol of a package, which holds it if it is passing.
    pub fn value(&mut self, sym: Sym) -> Value {
        let Some(passing) = self.passing.get_mut(&sym.0) else {
            return sym.into();
        };
        let held = passing.held.upgrade().unwrap_or_else(|| {
            let held = Held::new(sym, &self.gone);
            passing.held = Rc::downgrade(&held);
            if passing.is_suspect {
                cycles::note_symbol(Suspect::Symbol(WeakHold(passing.held.clone())));
            }
            held
        });
        Value::Symbol(sym, Hold(Some(held)))
    }

    /// The list of such values.
    pub(crate) fn values(&mut self, symbols: Vec<Sym>) -> Value {
        let values: Vec<Value> = symbols.into_iter().map(|sym| self.value(sym)).collect();
        Value::list(values)
    }

    /// A value that holds a passing symbol, if there are others; `None` for a symbol that needs none.
    pub(crate) fn held_value(&self, sym: Sym) -> Option<Value> {
        let held = self.passing.get(&sym.0)?.held.upgrade()?;
        Some(Value::Symbol(sym, Hold(Some(held))))
    }

    /// Forgets a passing symbol that no longer belongs to a package, unless a value refers to it or it stays
    /// for other reasons.
    pub(super) fn let_go(&mut self, sym: Sym) {
        if sym.0 >= PASSING {
            self.gone.borrow_mut().push(sym);
        }
    }

    fn count_on(&mut self) {
        self.next_passing = self.next_passing.checked_add(1).unwrap_or(PASSING);
    }

    /// Forgets the passing symbols that no value refers to any more.
    fn free_gone(&mut self) {
        loop {
            let gone = self.gone.take();
            if gone.is_empty() {
                return;
            }
            // What such a symbol held may have held others.
            for sym in gone {
                let passing = self.passing.get(&sym.0);
                if passing.is_some_and(|p| p.held.strong_count() == 0 && !p.data.stays()) {
                    drop(self.passing.remove(&sym.0));
                }
            }
        }
    }

    /// Forgets the passing symbols that no longer stay since nothing declares them to mean something.
    pub(super) fn free_forsaken(&mut self) {
        self.free_gone();
        self.passing
            .retain(|_, passing| passing.held.strong_count() > 0 || passing.data.stays());
    }

    /// Does the hold belong to a symbol of this table that does not stay for other reasons?
    pub(super) fn is_own(&self, hold: &Hold) -> bool {
        hold.0.as_ref().is_some_and(|held| {
            Rc::ptr_eq(&held.gone, &self.gone)
                && self.passing(held.sym).is_some_and(|data| !data.stays())
        })
    }

    /// What is known of a passing symbol.
    pub(super) fn passing(&self, sym: Sym) -> Option<&SymbolData> {
        self.passing.get(&sym.0).map(|passing| &passing.data)
    }

    /// Forgets a passing symbol that no value refers to but those in circles.
    pub(super) fn forget(&mut self, sym: Sym) -> Option<SymbolData> {
        self.passing.remove(&sym.0).map(|passing| passing.data)
    }

    /// Keeps a symbol for good, since something refers to it that is no value.
    pub fn keep(&self, sym: Sym) {
        if let Some(data) = self.passing(sym) {
            data.is_kept.set(true);
        }
    }

    /// The symbol's data.
    #[inline]
    pub fn get(&self, sym: Sym) -> &SymbolData {
        if sym.0 >= PASSING {
            return self.passing(sym).unwrap_or(&self.forgotten);
        }
        &self.entries[sym.0 as usize]
    }

    /// The symbol's data, mutably.
    #[inline]
    pub fn get_mut(&mut self, sym: Sym) -> &mut SymbolData {
        if sym.0 >= PASSING {
            return self.passing_mut(sym);
        }
        &mut self.entries[sym.0 as usize]
    }

    fn passing_mut(&mut self, sym: Sym) -> &mut SymbolData {
        let name = &self.forgotten.name;
        let again = || Passing {
            data: SymbolData::named(name.clone()),
            held: Weak::new(),
            is_suspect: false,
        };
        let passing = self.passing.entry(sym.0).or_insert_with(again);
        if !passing.is_suspect {
            passing.is_suspect = true;
            cycles::note_symbol(Suspect::Symbol(WeakHold(passing.held.clone())));
        }
        &mut passing.data
    }

    /// Number of symbols.
    #[cfg(test)]
    pub(crate) fn len(&self) -> usize {
        self.entries.len() + self.passing.len()
    }

    /// All symbols but passing ones that belong to no package, in order of creation.
    pub fn iter(&self) -> impl Iterator<Item = (Sym, &SymbolData)> {
        let entries = (0..).zip(&self.entries);
        let passing = self.passing.iter();
        let interned = passing.filter(|(_, passing)| passing.data.package.is_some());
        let interned = interned.map(|(index, passing)| (*index, &passing.data));
        let all = entries.chain(interned);
        all.map(|(index, data)| (Sym(index), data))
    }
}

impl Default for SymbolTable {
    fn default() -> SymbolTable {
        SymbolTable::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_passing_symbol_goes_with_its_last_value() {
        let mut symbols = SymbolTable::new();
        let value = symbols.make_passing("A".into());
        let sym = value.as_symbol().unwrap();
        let another = value.clone();
        drop(value);
        symbols.free_gone();
        assert_eq!(&*symbols.get(sym).name, "A");
        drop(another);
        symbols.free_gone();
        assert_eq!(symbols.len(), 0);
    }

    #[test]
    fn a_passing_symbol_stays_if_something_refers_to_it_that_is_no_value() {
        let mut symbols = SymbolTable::new();
        let names = ["V", "S", "K"];
        let [valued, special, kept] = names.map(|name| symbols.make_passing(name.into()));
        symbols.get_mut(valued.as_symbol().unwrap()).value = Value::Int(1);
        symbols.get_mut(special.as_symbol().unwrap()).kind = VariableKind::Special;
        symbols.keep(kept.as_symbol().unwrap());
        drop((valued, special, kept));
        symbols.free_gone();
        assert_eq!(symbols.len(), 2);
    }

    #[test]
    fn passing_symbols_that_hold_each_other_go_one_after_the_other() {
        let mut symbols = SymbolTable::new();
        let [outer, inner] = ["O", "I"].map(|name| symbols.make_passing(name.into()));
        symbols.get_mut(outer.as_symbol().unwrap()).value = inner;
        drop(outer);
        symbols.free_gone();
        assert_eq!(symbols.len(), 0);
    }

    #[test]
    fn tables_do_not_free_each_others_symbols() {
        let (mut one, mut other) = (SymbolTable::new(), SymbolTable::new());
        let held = one.make_passing("HELD".into());
        drop(other.make_passing("GONE".into()));
        other.free_gone();
        one.free_gone();
        assert_eq!(&*one.get(held.as_symbol().unwrap()).name, "HELD");
    }
}

//! Symbols: names with a value, a function and a property list.
//!
//! A symbol is an index into the image's symbol table. The symbols that Rust code names
//! have fixed indices, listed in [`known`].

use std::rc::Rc;

use super::Value;
use super::function::Function;
use super::package::PackageId;

pub(crate) use super::known;

/// A symbol of an image.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub(crate) struct Sym(pub(crate) u32);

/// What a symbol means in function position.
#[derive(Clone, Default)]
pub(crate) enum FunctionCell {
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
    pub(crate) fn is_macro_of_program(&self) -> bool {
        match self {
            FunctionCell::Macro(function) => function.as_deferred().is_none(),
            _ => false,
        }
    }
}

/// How a symbol behaves as a variable.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
pub(crate) enum VariableKind {
    /// Bindings are lexical.
    #[default]
    Lexical,
    /// Bindings are dynamic.
    Special,
    /// The value never changes.
    Constant,
}

/// What an image knows about a symbol.
#[derive(Default)]
pub(crate) struct SymbolData {
    pub(crate) name: Rc<str>,
    /// The home package; none if uninterned.
    pub(crate) package: Option<PackageId>,
    /// The global value.
    pub(crate) value: Value,
    /// How the symbol is bound as a variable.
    pub(crate) kind: VariableKind,
    /// The global function.
    pub(crate) function: FunctionCell,
    /// The function of `(setf (name …) …)`.
    pub(crate) setf_function: Option<Rc<Function>>,
    /// The property list.
    pub(crate) plist: Value,
    /// Expansion of a global symbol macro.
    pub(crate) symbol_macro: Option<Value>,
    /// Documentation as a variable, if any.
    pub(crate) variable_doc: Option<Rc<str>>,
}

/// All symbols of an image.
pub(crate) struct SymbolTable {
    entries: Vec<SymbolData>,
}

impl SymbolTable {
    /// An empty table.
    pub(crate) fn new() -> SymbolTable {
        SymbolTable {
            entries: Vec::with_capacity(4096),
        }
    }

    /// Adds a symbol that belongs to no package yet.
    pub(crate) fn make(&mut self, name: Rc<str>) -> Sym {
        // More than four billion symbols do not fit in memory.
        let index = u32::try_from(self.entries.len()).unwrap_or(u32::MAX);
        self.entries.push(SymbolData {
            name,
            plist: Value::NIL,
            ..SymbolData::default()
        });
        Sym(index)
    }

    /// The symbol's data.
    #[inline]
    pub(crate) fn get(&self, sym: Sym) -> &SymbolData {
        &self.entries[sym.0 as usize]
    }

    /// The symbol's data, mutably.
    #[inline]
    pub(crate) fn get_mut(&mut self, sym: Sym) -> &mut SymbolData {
        &mut self.entries[sym.0 as usize]
    }

    /// Number of symbols.
    pub(crate) fn len(&self) -> usize {
        self.entries.len()
    }

    /// All symbols, in order of creation.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (Sym, &SymbolData)> {
        self.entries
            .iter()
            .enumerate()
            .map(|(i, data)| (Sym(u32::try_from(i).unwrap_or(u32::MAX)), data))
    }
}

impl Default for SymbolTable {
    fn default() -> SymbolTable {
        SymbolTable::new()
    }
}

//! Packages: name spaces of symbols.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use super::Value;
use super::present_symbols::PresentSymbols;
use super::symbol::{Sym, SymbolTable};

/// A package of an image.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct PackageId(pub u32);

/// How a name is accessible in a package.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Access {
    /// Present and exported.
    External,
    /// Present, not exported.
    Internal,
    /// Exported by a used package.
    Inherited,
}

/// One package.
#[derive(Clone, Default)]
pub struct Package {
    pub name: Rc<str>,
    /// Other names.
    pub nicknames: Vec<Rc<str>>,
    /// Symbols present in the package, by name; the flag tells whether it is exported.
    pub symbols: PresentSymbols,
    /// Packages whose external symbols are inherited, in order.
    pub uses: Vec<PackageId>,
    /// Names that the package shadows.
    pub(crate) shadowing: Vec<Rc<str>>,
    /// A sentence about the package.
    pub doc: Option<Rc<str>>,
    /// Whether every name that is read in it is one of its external symbols.
    pub is_open: bool,
}

/// All packages of an image. Copies share the packages until one changes them.
#[derive(Clone)]
pub struct PackageTable {
    packages: Vec<Rc<Package>>,
    by_name: BTreeMap<Rc<str>, PackageId>,
    /// Those that have not been deleted.
    present: BTreeSet<PackageId>,
    /// What is known of all that have been deleted.
    deleted: Rc<Package>,
}

impl Default for PackageTable {
    fn default() -> Self {
        let deleted = Package {
            name: "(deleted)".into(),
            ..Package::default()
        };
        Self {
            packages: Vec::new(),
            by_name: BTreeMap::new(),
            present: BTreeSet::new(),
            deleted: Rc::new(deleted),
        }
    }
}

impl PackageTable {
    /// `COMMON-LISP`.
    pub const CL: PackageId = PackageId(0);
    /// `KEYWORD`.
    pub const KEYWORD: PackageId = PackageId(1);
    /// `SYSTEM`: names that the implementation itself needs.
    pub const SYSTEM: PackageId = PackageId(3);
    /// `COMMON-LISP-USER`.
    pub const USER: PackageId = PackageId(2);

    /// Makes a package; `None` if a name is taken.
    pub fn make(&mut self, name: &str, nicknames: &[&str]) -> Option<PackageId> {
        if self.find(name).is_some() || nicknames.iter().any(|n| self.find(n).is_some()) {
            return None;
        }
        let id = PackageId(u32::try_from(self.packages.len()).ok()?);
        let name: Rc<str> = name.into();
        self.by_name.insert(name.clone(), id);
        self.present.insert(id);
        self.packages.push(Rc::new(Package {
            name,
            ..Package::default()
        }));
        for nickname in nicknames {
            self.add_nickname(id, nickname);
        }
        Some(id)
    }

    /// Gives a package another name, unless that name is taken.
    pub fn add_nickname(&mut self, id: PackageId, nickname: &str) {
        let nickname: Rc<str> = nickname.into();
        if !self.by_name.contains_key(&nickname) {
            self.by_name.insert(nickname.clone(), id);
            self.get_mut(id).nicknames.push(nickname);
        }
    }

    /// The package of that name or nickname.
    pub fn find(&self, name: &str) -> Option<PackageId> {
        self.by_name.get(name).copied()
    }

    /// Forgets a package, so that it can no longer be found. A program may still hold it.
    pub fn delete(&mut self, id: PackageId) {
        self.forget_names(id);
        self.present.remove(&id);
        self.packages[id.0 as usize] = self.deleted.clone();
    }

    /// Forgets the names of a package.
    fn forget_names(&mut self, id: PackageId) {
        let package = &self.packages[id.0 as usize];
        for name in package.nicknames.iter().chain([&package.name]) {
            if self.by_name.get(name) == Some(&id) {
                self.by_name.remove(name);
            }
        }
    }

    /// The package.
    pub fn get(&self, id: PackageId) -> &Package {
        &self.packages[id.0 as usize]
    }

    /// The package, mutably.
    pub fn get_mut(&mut self, id: PackageId) -> &mut Package {
        Rc::make_mut(&mut self.packages[id.0 as usize])
    }

    /// All names and nicknames with their packages, by name.
    pub fn names(&self) -> impl Iterator<Item = (&str, PackageId)> {
        self.by_name.iter().map(|(name, id)| (name.as_ref(), *id))
    }

    /// All packages that have not been deleted, in order of creation.
    pub fn ids(&self) -> impl Iterator<Item = PackageId> + use<> {
        let ids: Vec<PackageId> = self.present.iter().copied().collect();
        ids.into_iter()
    }

    /// How many packages have been made, those included that have been deleted.
    pub(crate) fn made(&self) -> usize {
        self.packages.len()
    }

    /// The symbol accessible under a name in a package.
    pub fn find_symbol(&self, package: PackageId, name: &str) -> Option<(Sym, Access)> {
        let this = self.get(package);
        if let Some((sym, external)) = this.symbols.get(name) {
            let access = if *external {
                Access::External
            } else {
                Access::Internal
            };
            return Some((*sym, access));
        }
        this.uses.iter().find_map(|used| {
            let (sym, external) = self.get(*used).symbols.get(name)?;
            external.then_some((*sym, Access::Inherited))
        })
    }

    /// The symbol accessible under a name; if there is none, a new one is made present. A new
    /// symbol in `KEYWORD` is exported and is its own value.
    pub fn intern(&mut self, symbols: &mut SymbolTable, package: PackageId, name: &str) -> Sym {
        if let Some((sym, _)) = self.find_symbol(package, name) {
            return sym;
        }
        self.make_present(symbols, package, name, false)
    }

    /// The same for a running program, as a value: a new symbol lasts until it is removed from the package and no
    /// value refers to it. Keywords stay.
    pub(crate) fn intern_for_program(
        &mut self,
        symbols: &mut SymbolTable,
        package: PackageId,
        name: &str,
    ) -> Value {
        if let Some((sym, _)) = self.find_symbol(package, name) {
            return symbols.value(sym);
        }
        if package == Self::KEYWORD {
            return self.make_present(symbols, package, name, false).into();
        }
        let name: Rc<str> = name.into();
        let value = symbols.make_for_program(name.clone());
        if let Some(sym) = value.as_symbol() {
            symbols.get_mut(sym).package = Some(package);
            self.get_mut(package).symbols.get_or_insert(&name, sym);
        }
        value
    }

    /// The symbol under a name whose home is the package, where it is known that the package inherits none of
    /// that name; made present if there is none.
    pub(crate) fn intern_at_home(
        &mut self,
        symbols: &mut SymbolTable,
        home: PackageId,
        name: &str,
    ) -> Sym {
        match self.get(home).symbols.get(name) {
            Some((sym, _)) => *sym,
            None => self.make_present(symbols, home, name, false),
        }
    }

    fn make_present(
        &mut self,
        symbols: &mut SymbolTable,
        package: PackageId,
        name: &str,
        is_external: bool,
    ) -> Sym {
        let name: Rc<str> = name.into();
        let sym = symbols.make(name.clone());
        let is_keyword = package == Self::KEYWORD;
        let data = symbols.get_mut(sym);
        data.package = Some(package);
        if is_keyword {
            data.value = sym.into();
            data.kind = crate::value::symbol::VariableKind::Constant;
        }
        let present = self.get_mut(package).symbols.get_or_insert(&name, sym);
        *present = (sym, is_external || is_keyword);
        sym
    }

    /// The symbol accessible under a name, made as [`PackageTable::intern`] does, and exported.
    pub(crate) fn intern_external(
        &mut self,
        symbols: &mut SymbolTable,
        package: PackageId,
        name: &str,
    ) -> Sym {
        match self.find_symbol(package, name) {
            Some((sym, Access::External)) => sym,
            Some((sym, _)) => {
                self.export(symbols, package, sym);
                sym
            }
            None => self.make_present(symbols, package, name, true),
        }
    }

    /// Makes a symbol present in a package (`import`), keeping its home.
    pub fn import(&mut self, symbols: &mut SymbolTable, package: PackageId, sym: Sym) {
        let name = symbols.get(sym).name.clone();
        let data = symbols.get_mut(sym);
        if *data.package.get_or_insert(package) != package {
            // It may be removed from its home, and is still in this package.
            symbols.keep(sym);
        }
        self.get_mut(package).symbols.get_or_insert(&name, sym);
    }

    /// Exports a symbol from a package, making it present first.
    pub fn export(&mut self, symbols: &mut SymbolTable, package: PackageId, sym: Sym) {
        let data = symbols.get_mut(sym);
        data.package.get_or_insert(package);
        let present = self.get_mut(package).symbols.get_or_insert(&data.name, sym);
        present.1 = true;
    }

    /// Lets a package inherit the external symbols of another.
    pub fn use_package(&mut self, package: PackageId, used: PackageId) {
        let uses = &mut self.get_mut(package).uses;
        if package != used && !uses.contains(&used) {
            uses.push(used);
        }
    }

    /// Removes a package from those that another uses.
    pub(crate) fn unuse_package(&mut self, package: PackageId, used: PackageId) {
        if self.get(package).uses.contains(&used) {
            self.get_mut(package).uses.retain(|id| *id != used);
        }
    }

    /// Makes an exported symbol internal again.
    pub fn unexport(&mut self, symbols: &SymbolTable, package: PackageId, sym: Sym) {
        let name = symbols.get(sym).name.clone();
        if let Some(entry) = self.get_mut(package).symbols.get_mut(&name)
            && entry.0 == sym
        {
            entry.1 = false;
        }
    }

    /// Removes a symbol from a package; returns whether it was present.
    pub(crate) fn unintern(
        &mut self,
        symbols: &mut SymbolTable,
        package: PackageId,
        sym: Sym,
    ) -> bool {
        let name = symbols.get(sym).name.clone();
        let this = self.get_mut(package);
        if this.symbols.get(&name).is_none_or(|(s, _)| *s != sym) {
            return false;
        }
        this.symbols.remove(&name);
        this.shadowing.retain(|n| *n != name);
        let data = symbols.get_mut(sym);
        if data.package == Some(package) {
            data.package = None;
            symbols.let_go(sym);
        }
        true
    }

    /// Makes a symbol present in place of any other of its name, and shadowing.
    pub(crate) fn shadowing_import(
        &mut self,
        symbols: &mut SymbolTable,
        package: PackageId,
        sym: Sym,
    ) {
        let name = symbols.get(sym).name.clone();
        self.get_mut(package).symbols.remove(&name);
        self.import(symbols, package, sym);
        let shadowing = &mut self.get_mut(package).shadowing;
        if !shadowing.contains(&name) {
            shadowing.push(name);
        }
    }

    /// Gives a package a new name and nicknames; false if one is taken.
    pub fn rename(&mut self, id: PackageId, name: &str, nicknames: &[Rc<str>]) -> bool {
        let taken = |n: &str| self.find(n).is_some_and(|found| found != id);
        if taken(name) || nicknames.iter().any(|n| taken(n)) {
            return false;
        }
        self.forget_names(id);
        self.by_name.insert(name.into(), id);
        let this = self.get_mut(id);
        this.name = name.into();
        this.nicknames.clear();
        for nickname in nicknames {
            self.add_nickname(id, nickname);
        }
        true
    }

    /// Has the package been deleted?
    pub fn is_deleted(&self, id: PackageId) -> bool {
        !self.present.contains(&id)
    }
}

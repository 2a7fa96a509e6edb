//! Package locks: what the language and the built-in packages define is not redefined by mistake.

use std::rc::Rc;

use super::Image;
use crate::source::Place;
use crate::value::Value;
use crate::value::known;
use crate::value::package::{PackageId, PackageTable};
use crate::value::raise::Raise;
use crate::value::symbol::{FunctionCell, Sym, SymSet, SymbolData, VariableKind};

/// What a name is to mean.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Meaning {
    /// A function or macro everywhere.
    Function,
    /// A function or macro within a form.
    LocalFunction,
    /// What `setf` does with a place.
    Setter,
    /// A type, class, structure or condition.
    Type,
    /// A variable, constant or symbol macro.
    Variable,
}

/// Names with a built-in meaning, in order.
#[derive(Clone, Default)]
struct Names {
    functions: Vec<Sym>,
    setters: Vec<Sym>,
    types: Vec<Sym>,
}

impl Names {
    fn has(&self, name: Sym, meaning: Meaning) -> bool {
        let names = match meaning {
            Meaning::Function => &self.functions,
            Meaning::Setter => &self.setters,
            Meaning::Type => &self.types,
            Meaning::LocalFunction | Meaning::Variable => return false,
        };
        names.binary_search(&name).is_ok()
    }
}

/// The locks of an image. There are none until [`Image::lock_packages`].
#[derive(Clone, Default)]
pub struct Locks {
    /// Names that are locked.
    locked: Option<Rc<Names>>,
    /// How many packages there were.
    packages: usize,
    /// Names that may be redefined, which is said once.
    open: Rc<SymSet>,
    /// Where programs have defined functions.
    defined: Rc<std::collections::HashMap<Sym, Place>>,
}

/// Names that macros of the language bind as local functions, so that programs may, too.
const BOUND_BY_MACROS: &[&str] = &[
    "CALL-METHOD",
    "CALL-NEXT-METHOD",
    "LOOP-FINISH",
    "MAKE-METHOD",
    "NEXT-METHOD-P",
    "PPRINT-EXIT-IF-LIST-EXHAUSTED",
    "PPRINT-POP",
];

impl Image {
    /// Locks what all packages define by now, except those that are named.
    pub fn lock_packages(&mut self, open: &[&str]) {
        self.symbols.complete_library();
        let open: Vec<PackageId> = open.iter().filter_map(|p| self.packages.find(p)).collect();
        let package = |data: &SymbolData| data.package.filter(|p| *p != PackageTable::KEYWORD);
        let mut locked = Names::default();
        let mut free = SymSet::default();
        for (sym, data) in self.symbols.iter() {
            let Some(package) = package(data) else {
                continue;
            };
            let is_function = !matches!(data.function, FunctionCell::Unbound);
            if open.contains(&package) {
                if is_function {
                    free.insert(sym);
                }
                continue;
            }
            if is_function {
                locked.functions.push(sym);
            }
            if data.setf_function.is_some() {
                locked.setters.push(sym);
            }
        }
        let is_locked = |sym: &Sym| {
            let package = package(self.symbols.get(*sym));
            package.is_some_and(|package| !open.contains(&package))
        };
        let setters = self.setf_expanders.keys().copied();
        locked.setters.extend(setters.filter(is_locked));
        let classes = self.classes.iter();
        let classes = classes.filter(|(_, class)| class.is_defined.get());
        let types = self.types.keys().chain(classes.map(|(name, _)| name));
        locked.types.extend(types.copied().filter(is_locked));
        for names in [
            &mut locked.functions,
            &mut locked.setters,
            &mut locked.types,
        ] {
            names.sort_unstable();
        }
        self.locks.locked = Some(Rc::new(locked));
        self.locks.packages = self.packages.made();
        self.locks.open = Rc::new(free);
    }

    /// Was the package there when the packages were locked?
    pub(crate) fn is_built_in(&self, package: PackageId) -> bool {
        (package.0 as usize) < self.locks.packages
    }

    /// Have the packages been locked?
    pub(crate) fn has_locks(&self) -> bool {
        self.locks.locked.is_some()
    }

    /// Would it break what is built in if a program gave a name this meaning?
    pub fn is_locked(&self, name: Sym, meaning: Meaning) -> bool {
        let Some(locked) = &self.locks.locked else {
            return false;
        };
        if self.special(known::V_LOCKS_IGNORED).is_true() {
            return false;
        }
        let data = self.symbol(name);
        if data.package != Some(PackageTable::CL) {
            return locked.has(name, meaning);
        }
        let access = self.packages.get(PackageTable::CL).symbols.get(&data.name);
        if !access.is_some_and(|(found, is_external)| *found == name && *is_external) {
            return locked.has(name, meaning);
        }
        match meaning {
            Meaning::LocalFunction => !BOUND_BY_MACROS.contains(&&*data.name),
            // A variable that is one already may get another value.
            Meaning::Variable => data.kind != VariableKind::Special,
            Meaning::Function | Meaning::Setter | Meaning::Type => true,
        }
    }

    /// Is it a function that is built in and that no program has redefined?
    pub fn is_built_in_function(&self, name: Sym) -> bool {
        let locked = self.locks.locked.as_ref();
        locked.is_some_and(|names| names.has(name, Meaning::Function))
            || self.locks.open.contains(&name)
    }

    /// Signals an error if a program may not give a name this meaning. The forms that define ask
    /// before, with restarts; this is for functions that do.
    pub(crate) fn check_lock(&self, name: Sym, meaning: Meaning) -> Result<(), Box<Raise>> {
        if !self.is_locked(name, meaning) {
            return Ok(());
        }
        let what = match meaning {
            Meaning::Function | Meaning::LocalFunction => "a function",
            Meaning::Setter => "a place",
            Meaning::Type => "a type",
            Meaning::Variable => "a variable",
        };
        let package = self.symbol(name).package.unwrap_or(PackageTable::CL);
        let home = &self.packages.get(package).name;
        let text = self.name(name);
        let report = format!(
            "{text} belongs to the locked package {home}: defining it as {what} would change it for all that uses it. (system:without-package-locks …) around the form allows that."
        );
        Err(Raise::new(known::LOCKED_PACKAGE_ERROR, report)
            .with(known::K_PACKAGE, Value::Package(package))
            .with(known::K_NAME, name.into()))
    }

    /// Is it a built-in function that programs may redefine, and that none has yet?
    pub(crate) fn is_open(&self, name: Sym) -> bool {
        self.locks.open.contains(&name) && !self.special(known::V_LOCKS_IGNORED).is_true()
    }

    /// Notes that a program has redefined a name.
    pub(crate) fn note_redefined(&mut self, name: Sym) {
        if self.locks.open.contains(&name) {
            Rc::make_mut(&mut self.locks.open).remove(&name);
        }
    }

    /// Notes where a program defines a function; returns where the same text has done so before.
    pub(crate) fn note_defined(&mut self, name: Sym, place: Place) -> Option<Place> {
        let before = Rc::make_mut(&mut self.locks.defined).insert(name, place)?;
        self.sources.are_apart(before, place).then_some(before)
    }

    /// Forgets where a function is defined: it is taken away on purpose.
    pub(crate) fn forget_defined(&mut self, name: Sym) {
        if self.locks.defined.contains_key(&name) {
            Rc::make_mut(&mut self.locks.defined).remove(&name);
        }
    }
}

//! One Lisp image: the meanings of all global names.

pub mod built_in_files;
mod copy;
pub mod definition;
pub mod extension;
pub mod identity;
pub mod input;
pub mod locks;
pub mod notes;
pub mod open_call;
mod output;
pub mod precompiled;
pub(crate) mod setf_expander;
pub mod signalled;
pub mod warnings;

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use indexmap::IndexMap;

use self::definition::Installed;
use self::extension::Extension;
use self::identity::Identities;
use self::input::Input;
use self::locks::Locks;
use self::notes::{Note, NoteKind};
pub use self::output::Output;
use self::setf_expander::SetfExpander;
use self::signalled::Signalled;
use self::warnings::Warnings;
use super::builtin::{Builtin, Entry, Expander, Operator};
use super::files::{Disk, Files};
use super::guard::Limits;
use super::guard::polls::Polls;
use super::guard::reclaim::{self, Reclaim};
use super::native::BuiltinCall;
use super::source::{Place, Sources};
use super::value::Value;
use super::value::class::Class;
use super::value::function::{Body, Function};
use super::value::known;
use super::value::number;
use super::value::package::{Access, PackageId, PackageTable};
use super::value::raise::Raise;
use super::value::symbol::{FunctionCell, Sym, SymbolData, SymbolTable, VariableKind};
use super::value::{cycles, release};

pub struct Image {
    /// All symbols.
    pub symbols: SymbolTable,
    /// All packages.
    pub packages: PackageTable,
    /// Classes by name, in order of definition.
    pub classes: IndexMap<Sym, Rc<Class>>,
    /// Expanders of `deftype`, by name.
    pub types: IndexMap<Sym, Rc<Function>>,
    /// What names of `deftype` stand for by themselves, without arguments.
    pub(crate) type_names: IndexMap<Sym, Value>,
    /// Source texts and places.
    pub sources: Sources,
    /// Text written to standard output that has not been taken yet.
    pub output: Output,
    /// The files that programs can use.
    pub files: Arc<dyn Files>,
    /// Where standard input comes from.
    pub input: Input,
    /// Seed and state of `random`.
    pub random: rand_pcg::Pcg64,
    /// How `setf` treats operators that have an expander instead of a setf function.
    pub(crate) setf_expanders: IndexMap<Sym, SetfExpander>,
    /// What ends an evaluation from outside.
    pub limits: Rc<Limits>,
    /// What the compiler notices; `None` unless notes are wanted.
    pub notes: Option<Vec<Note>>,
    /// The form at top level that notes are about.
    pub noted_form: Place,
    /// What is known about warnings of forms that are evaluated.
    pub warnings: Warnings,
    /// The environment of the macro call that is being expanded.
    pub environment: Value,
    /// How deeply runs of macro functions are nested.
    pub nesting: usize,
    /// Are all values of the builtin that runs wanted? It may leave out all but the first one if not.
    pub(crate) wants_all: bool,
    signalled: Signalled,
    identities: i64,
    /// What the tables say about functions, macros and special operators, by name: calls, help,
    /// completion, the manual and the test of the examples read this one table.
    pub entries: IndexMap<Sym, Entry>,
    /// The part of the language that is written in Lisp.
    pub library: Installed,
    /// The package that receives symbols unknown to the current package, if not that package.
    pub(crate) new_symbols: Option<PackageId>,
    /// The Rust functions of builtins, by number.
    pub(super) natives: Vec<BuiltinCall>,
    /// Made-up addresses of objects that were printed.
    pub printed: RefCell<Identities>,
    pub(crate) locks: Locks,
    /// What layers above the language keep in the image: one value per type.
    extensions: Vec<Rc<dyn Extension>>,
}

/// The stream of the random generator: any constant will do.
const STREAM: u128 = 0xa02b_dbf7_bb3c_0a7a;

impl Drop for Image {
    fn drop(&mut self) {
        self.classes.values().for_each(|class| class.let_go());
    }
}

impl Image {
    /// An image with the known symbols and standard packages, and nothing else.
    pub(super) fn bare() -> Image {
        reclaim::provide(Reclaim {
            all: || {
                cycles::collect_all(None);
                release::all();
            },
            if_overdue: |in_use| {
                cycles::collect_if_overdue(in_use);
            },
        });
        let mut symbols = SymbolTable::new();
        let mut packages = PackageTable::default();
        packages.make("COMMON-LISP", &["CL"]);
        packages.make("KEYWORD", &[]);
        packages.make("COMMON-LISP-USER", &["CL-USER"]);
        packages.make("SYSTEM", &["SYS"]);
        known::intern_all(&mut symbols, &mut packages);
        packages.use_package(PackageTable::USER, PackageTable::CL);
        packages.use_package(PackageTable::SYSTEM, PackageTable::CL);
        Image {
            symbols,
            packages,
            classes: IndexMap::new(),
            types: IndexMap::new(),
            type_names: IndexMap::new(),
            sources: Sources::default(),
            output: Output::default(),
            files: Arc::new(Disk),
            input: Input::default(),
            random: rand_pcg::Pcg64::new(0, STREAM),
            setf_expanders: IndexMap::new(),
            limits: Rc::default(),
            notes: None,
            noted_form: Place::NONE,
            warnings: Warnings::default(),
            environment: Value::NIL,
            nesting: 0,
            wants_all: true,
            signalled: Signalled::default(),
            identities: 0,
            natives: Vec::new(),
            printed: RefCell::default(),
            entries: IndexMap::new(),
            library: Installed::default(),
            new_symbols: None,
            locks: Locks::default(),
            extensions: Vec::new(),
        }
    }

    /// The interrupt flag: set from outside to stop the machine.
    pub fn interrupt(&self) -> &Arc<AtomicBool> {
        self.limits.polls.flag()
    }

    /// How often has the flag been looked at? Counts the same in every run, so that an
    /// interrupt can be repeated.
    pub fn polls(&self) -> &Polls {
        &self.limits.polls
    }

    /// Is the interrupt flag set?
    pub fn is_interrupted(&self) -> bool {
        self.limits.polls.look()
    }

    /// Was the interrupt flag set? Clears it.
    pub fn take_interrupt(&self) -> bool {
        self.limits.polls.take()
    }

    /// Expands a form with a macro written in Rust, which may ask for the environment.
    pub(crate) fn expand_with(
        &mut self,
        expand: Expander,
        form: &Value,
        environment: Value,
    ) -> Result<Value, Box<Raise>> {
        let outside = std::mem::replace(&mut self.environment, environment);
        let expansion = expand(self, form);
        self.environment = outside;
        expansion
    }

    /// A value of a builtin and another one after it, if that is wanted.
    pub(crate) fn with_second(&self, first: Value, second: impl FnOnce() -> Value) -> Value {
        match self.wants_all {
            true => Value::values(vec![first, second()]),
            false => first,
        }
    }

    /// Takes a note about a form, if notes are wanted.
    pub fn note(&mut self, place: Place, kind: impl FnOnce() -> NoteKind) {
        if let Some(notes) = &mut self.notes {
            let kind = kind();
            notes.push(Note { place, kind });
        }
    }

    /// Seeds `random`.
    pub fn seed(&mut self, seed: u64) {
        self.random = rand_pcg::Pcg64::new(u128::from(seed), STREAM);
    }

    /// The package in which a name without a prefix is read.
    pub(crate) fn package_of_read(&self, name: &str) -> PackageId {
        let current = self.current_package();
        match self.new_symbols {
            Some(elsewhere) if self.packages.find_symbol(current, name).is_none() => elsewhere,
            _ => current,
        }
    }

    /// A number that no block or tagbody has had before.
    pub(crate) fn fresh_identity(&mut self) -> i64 {
        self.identities += 1;
        self.identities
    }

    /// The function that a function object or a symbol designates.
    pub fn coerce_to_function(&self, designator: &Value) -> Result<Rc<Function>, Box<Raise>> {
        match designator {
            Value::Function(f) => Ok(f.clone()),
            Value::Symbol(sym, ..) => match &self.symbols.get(*sym).function {
                FunctionCell::Function(f) => Ok(f.clone()),
                _ => Err(Raise::undefined_function(designator.clone())),
            },
            other => match self.named_function(other) {
                Some(f) => Ok(f),
                None => Err(Raise::type_error(other, known::FUNCTION)),
            },
        }
    }

    /// The function of a name: a symbol, or the list `(setf symbol)`.
    pub(crate) fn named_function(&self, name: &Value) -> Option<Rc<Function>> {
        match name {
            Value::Symbol(sym, ..) => self.function(*sym).cloned(),
            other => self.symbol(other.setf_name()?).setf_function.clone(),
        }
    }

    /// The data of a symbol.
    #[inline]
    pub fn symbol(&self, sym: Sym) -> &SymbolData {
        self.symbols.get(sym)
    }

    /// A symbol's name.
    pub fn name(&self, sym: Sym) -> &str {
        &self.symbols.get(sym).name
    }

    /// The value of a special variable as the running fiber sees it.
    #[inline]
    pub fn special(&self, sym: Sym) -> &Value {
        &self.symbols.get(sym).value
    }

    /// Assigns a special variable.
    pub fn set_special(&mut self, sym: Sym, value: Value) {
        self.symbols.get_mut(sym).value = value;
    }

    /// The symbol `name` of a package, created if necessary. It stays.
    pub fn intern(&mut self, package: PackageId, name: &str) -> Sym {
        let sym = self.packages.intern(&mut self.symbols, package, name);
        self.symbols.keep(sym);
        sym
    }

    /// The symbol `name` of a package as a running program interns it, created if necessary.
    pub(crate) fn intern_for_program(&mut self, package: PackageId, name: &str) -> Value {
        self.packages
            .intern_for_program(&mut self.symbols, package, name)
    }

    /// The keyword of that name.
    pub fn keyword(&mut self, name: &str) -> Sym {
        self.intern(PackageTable::KEYWORD, name)
    }

    /// The symbol of that name in the named package, exported; the package must exist.
    pub fn export_symbol(&mut self, package: PackageId, name: &str) -> Sym {
        self.packages
            .intern_external(&mut self.symbols, package, name)
    }

    /// Is the symbol a keyword?
    pub fn is_keyword(&self, sym: Sym) -> bool {
        self.symbols.get(sym).package == Some(PackageTable::KEYWORD)
    }

    /// The value of `*package*`.
    pub fn current_package(&self) -> PackageId {
        match self.special(known::V_PACKAGE) {
            Value::Package(id) => *id,
            _ => PackageTable::USER,
        }
    }

    /// Is the symbol accessible in the current package without a prefix?
    pub(crate) fn is_accessible(&self, sym: Sym) -> bool {
        let name = &self.symbols.get(sym).name;
        self.packages
            .find_symbol(self.current_package(), name)
            .is_some_and(|(found, _)| found == sym)
    }

    /// How the symbol is accessible in its home package.
    pub fn home_access(&self, sym: Sym) -> Option<Access> {
        let data = self.symbols.get(sym);
        self.packages
            .find_symbol(data.package?, &data.name)
            .map(|(_, access)| access)
    }

    /// An uninterned symbol, which stays.
    pub fn make_symbol(&mut self, name: &str) -> Sym {
        self.symbols.make(name.into())
    }

    /// An uninterned symbol with a fresh number: `G123`.
    pub fn gensym(&mut self, prefix: &str) -> Value {
        let name = self.fresh_name(prefix);
        self.symbols.make_for_program(name.into())
    }

    /// A name with a fresh number: `G123`.
    pub(crate) fn fresh_name(&mut self, prefix: &str) -> String {
        let counter = match self.special(known::V_GENSYM_COUNTER) {
            Value::Big(n) => {
                let (name, next) = (format!("{prefix}{n}"), n.as_ref() + 1_u8);
                self.set_special(known::V_GENSYM_COUNTER, number::from_big(next));
                return name;
            }
            Value::Int(n) => *n,
            _ => 0,
        };
        let next = match counter.checked_add(1) {
            Some(next) => Value::Int(next),
            None => number::from_big(num_bigint::BigInt::from(counter) + 1_u8),
        };
        self.set_special(known::V_GENSYM_COUNTER, next);
        format!("{prefix}{counter}")
    }

    /// Sets a symbol's global function.
    pub fn set_function(&mut self, sym: Sym, function: Rc<Function>) {
        self.symbols.get_mut(sym).function = FunctionCell::Function(function);
    }

    /// The global function of a symbol.
    pub fn function(&self, sym: Sym) -> Option<&Rc<Function>> {
        match &self.symbols.get(sym).function {
            FunctionCell::Function(f) => Some(f),
            _ => None,
        }
    }

    /// Makes a symbol a special variable and gives it a value.
    pub fn define_special(&mut self, sym: Sym, value: Value) {
        let data = self.symbols.get_mut(sym);
        data.kind = VariableKind::Special;
        data.value = value;
    }

    /// Makes a symbol a constant.
    pub(crate) fn define_constant(&mut self, sym: Sym, value: Value) {
        let data = self.symbols.get_mut(sym);
        data.kind = VariableKind::Constant;
        data.value = value;
    }

    /// Installs the builtins of a table as exported functions of a package.
    pub fn install(&mut self, package: PackageId, table: &'static [Builtin]) {
        for builtin in table {
            let sym = self.export_symbol(package, builtin.name);
            let function = builtin.function(self, sym);
            self.set_function(sym, function);
            self.entries.insert(sym, Entry::Builtin(builtin));
        }
    }

    /// Installs the functions of a table as the functions that `setf` calls for places with those
    /// names; the new value is their first argument.
    pub fn install_setf(&mut self, package: PackageId, table: &'static [Builtin]) {
        for setter in table {
            let sym = self.export_symbol(package, setter.name);
            let function = setter.function(self, sym);
            self.symbols.get_mut(sym).setf_function = Some(function);
        }
    }

    /// Installs the macros and special operators of a table, exported from a package.
    pub fn install_operators(&mut self, package: PackageId, table: &'static [Operator]) {
        for operator in table {
            let sym = self.export_symbol(package, operator.name);
            self.symbols.get_mut(sym).function = FunctionCell::Builtin;
            self.entries.insert(sym, Entry::Operator(operator));
        }
    }

    /// The macro written in Rust, or the special operator, with this name.
    pub fn operator(&self, name: Sym) -> Option<&'static Operator> {
        match self.entries.get(&name)? {
            Entry::Operator(operator) => Some(operator),
            Entry::Builtin(_) | Entry::Library(_) => None,
        }
    }

    /// What the tables say about a name, unless a program has given it another meaning.
    pub fn entry(&self, name: Sym) -> Option<Entry> {
        let entry = *self.entries.get(&name)?;
        let is_current = match (&self.symbol(name).function, entry) {
            (FunctionCell::Builtin, Entry::Operator(_)) => true,
            (FunctionCell::Function(function), Entry::Builtin(_)) => {
                matches!(function.body, Body::Native(_))
            }
            (FunctionCell::Function(f) | FunctionCell::Macro(f), Entry::Library(_)) => {
                f.as_deferred().is_some()
            }
            _ => false,
        };
        is_current.then_some(entry)
    }

    /// The class of that name.
    pub fn class(&self, name: Sym) -> Option<&Rc<Class>> {
        self.classes.get(&name)
    }
}

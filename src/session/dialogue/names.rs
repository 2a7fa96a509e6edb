//! What is known about names, as data that any thread may read while the session works.

use std::collections::BTreeMap;
use std::sync::Arc;

/// The names of an image at one time.
#[derive(Clone, Default, Debug)]
pub struct Names {
    /// All packages.
    pub packages: Vec<Arc<KnownPackage>>,
    /// Names and nicknames of packages with their indices.
    pub package_names: BTreeMap<String, usize>,
    /// The index of the package in which forms at top level are read.
    pub current: usize,
    /// All symbols with a home.
    pub symbols: Vec<Arc<KnownSymbol>>,
    /// The places of definitions by name in upper case, the newest first.
    pub definitions: Arc<BTreeMap<String, Vec<Arc<Definition>>>>,
    /// What designators are made of.
    pub descriptions: Arc<Vec<KnownDescription>>,
}

/// The keys of designators of a class, and of a type if that decides.
#[derive(Default, Debug)]
pub struct KnownDescription {
    /// `ACTION`, `MOTION`, `OBJECT` or `LOCATION`.
    pub class: &'static str,
    /// The type in lower case, with its aliases; empty where the type does not matter.
    pub types: Vec<String>,
    /// The keys in lower case, and whether each is needed.
    pub keys: Vec<(String, bool)>,
}

/// A package.
#[derive(Default, Debug)]
pub struct KnownPackage {
    /// Its name.
    pub name: String,
    /// The name that prompts show.
    pub prompt: String,
    /// The symbols that are present in it, as indices, and whether each is exported, by name.
    pub symbols: BTreeMap<String, (usize, bool)>,
    /// Indices of the packages whose exported symbols are inherited.
    pub uses: Vec<usize>,
}

/// A symbol.
#[derive(Clone, Default, Debug)]
pub struct KnownSymbol {
    /// Its name.
    pub name: String,
    /// The index of its home package.
    pub package: usize,
    /// Its function, macro or special operator.
    pub function: Option<KnownFunction>,
    /// Whether it is a variable or a constant.
    pub is_variable: bool,
    /// Its documentation as a variable.
    pub variable_doc: Option<String>,
    /// Whether it names a class or type.
    pub is_class: bool,
    /// What it means to the robot, such as the keys of an action.
    pub topics: String,
}

/// A function, macro or special operator.
#[derive(Clone, Default, Debug)]
pub struct KnownFunction {
    /// What it is.
    pub kind: &'static str,
    /// The lambda list without its parentheses, in lower case.
    pub lambda_list: String,
    /// The documentation.
    pub doc: Option<String>,
    /// Its text, if it belongs to the language and is written in Lisp.
    pub library: Option<LibraryText>,
}

/// A definition of the language that is written in Lisp.
#[derive(Clone, Debug)]
pub struct LibraryText {
    /// File and line in the sources of this program.
    pub place: String,
    /// The form.
    pub text: &'static str,
}

/// A definition in a text.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Definition {
    /// What defines and what is defined, such as `(DEFUN F)`.
    pub label: String,
    /// The name of the text.
    pub source: String,
    /// The line, from one.
    pub line: usize,
    /// The column, from one, in characters.
    pub column: usize,
    /// The form.
    pub text: String,
}

impl KnownSymbol {
    /// Whether it means anything.
    pub fn has_meaning(&self) -> bool {
        self.function.is_some() || self.is_variable || self.is_class || !self.topics.is_empty()
    }

    /// The shape of a call.
    pub fn call(&self) -> Option<String> {
        let list = &self.function.as_ref()?.lambda_list;
        let name = self.name.to_lowercase();
        Some(match list.is_empty() {
            true => format!("({name})"),
            false => format!("({name} {list})"),
        })
    }
}

impl Names {
    /// The index of a package of that name or nickname, in any case.
    pub fn package(&self, name: &str) -> Option<usize> {
        let exact = self.package_names.get(name);
        exact
            .or_else(|| self.package_names.get(&name.to_uppercase()))
            .copied()
    }

    /// The keys of designators of a class and a type, as typed.
    pub fn description(&self, class: &str, of_type: &str) -> Option<&KnownDescription> {
        let (class, of_type) = (class.to_uppercase(), of_type.to_lowercase());
        let mut all = self.descriptions.iter();
        all.find(|known| {
            known.class == class && (known.types.is_empty() || known.types.contains(&of_type))
        })
    }

    /// The symbol accessible under a name in a package.
    pub fn accessible(&self, package: usize, name: &str) -> Option<&KnownSymbol> {
        let this = self.packages.get(package)?;
        let own = this.symbols.get(name).map(|(symbol, _)| *symbol);
        let inherited = || {
            let mut used = this.uses.iter().filter_map(|used| self.packages.get(*used));
            used.find_map(|used| used.symbols.get(name).filter(|(_, external)| *external))
                .map(|(symbol, _)| *symbol)
        };
        let symbol = self.symbols.get(own.or_else(inherited)?)?;
        Some(symbol)
    }

    /// The symbol that is typed so in a package.
    pub fn typed(&self, package: usize, text: &str) -> Option<&KnownSymbol> {
        let upper = text.to_uppercase();
        match upper.rsplit_once(':') {
            None => self.accessible(package, &upper),
            Some((prefix, name)) => {
                let prefix = prefix.trim_end_matches(':');
                self.accessible(self.package(prefix)?, name)
            }
        }
    }

    /// All symbols accessible in a package by name; those of used packages after its own.
    pub fn all_accessible(&self, package: usize) -> impl Iterator<Item = (&str, &KnownSymbol)> {
        let this = self.packages.get(package);
        let own = this.into_iter().flat_map(|package| &package.symbols);
        let used = this.into_iter().flat_map(|package| &package.uses);
        let inherited = used
            .filter_map(|used| self.packages.get(*used))
            .flat_map(|used| &used.symbols)
            .filter(|(_, (_, is_external))| *is_external);
        own.chain(inherited).filter_map(|(name, (symbol, _))| {
            let symbol: &KnownSymbol = self.symbols.get(*symbol)?;
            Some((name.as_str(), symbol))
        })
    }
}

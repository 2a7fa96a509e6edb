//! What is known about all names, as data.

use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::Arc;

use crate::dialogue::{
    Definition, KnownDescription, KnownFunction, KnownPackage, KnownSymbol, LibraryText, Names,
};
use crate::package_name::prompt_name;
use cram::designator::schema;
use cram::designator::schema::TypeRow;
use cram::designator::value::Class;
use lisp::builtin::Entry;
use lisp::builtins::help;
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::package::{PackageId, PackageTable};
use lisp::value::symbol::{FunctionCell, Sym, VariableKind};

use super::{definitions, designators};

/// The definitions in the texts that have been read so far.
#[derive(Default)]
struct Definitions {
    /// Number of texts that have been searched.
    searched: usize,
    found: Arc<BTreeMap<String, Vec<Arc<Definition>>>>,
}

impl Definitions {
    /// Searches the texts that are new.
    fn update(&mut self, image: &Image) -> Arc<BTreeMap<String, Vec<Arc<Definition>>>> {
        let new: Vec<_> = image.sources.programs_from(self.searched).collect();
        self.searched = image.sources.count();
        for (name, text) in new {
            let inside = definitions::find(name, text);
            if inside.is_empty() {
                continue;
            }
            let found = Arc::make_mut(&mut self.found);
            for (defined, definition) in inside {
                let known = found.entry(defined).or_default();
                // A text that is read again, such as a file that has changed.
                known
                    .retain(|old| old.source != definition.source || old.label != definition.label);
                known.insert(0, Arc::new(definition));
            }
        }
        Arc::clone(&self.found)
    }
}

/// What was told about names last. Most of it holds still after an evaluation, and is told again.
#[derive(Default)]
pub(crate) struct ToldNames {
    definitions: Definitions,
    names: Names,
    packages: Vec<PackageId>,
    numbers: BTreeMap<Sym, usize>,
    /// What is told about each symbol comes from this.
    origins: Vec<Origin>,
    /// The types of actions and motions.
    types: Vec<Rc<TypeRow>>,
}

/// What the meaning of a symbol depends on, apart from types of actions and motions.
struct Origin {
    function: FunctionCell,
    kind: VariableKind,
    has_value: bool,
    doc: Option<Rc<str>>,
    is_class: bool,
}

impl Origin {
    fn of(image: &Image, sym: Sym) -> Origin {
        let data = image.symbol(sym);
        Origin {
            function: data.function.clone(),
            kind: data.kind,
            has_value: !data.value.is_unbound(),
            doc: data.variable_doc.clone(),
            is_class: image.class(sym).is_some(),
        }
    }

    /// Whether the same is told about the symbol now.
    fn holds(&self, image: &Image, sym: Sym) -> bool {
        let data = image.symbol(sym);
        let same_function = match (&self.function, &data.function) {
            // Methods and documentation are added to a generic function in place.
            (FunctionCell::Function(old), FunctionCell::Function(new)) => {
                Rc::ptr_eq(old, new) && new.as_generic().is_none()
            }
            (FunctionCell::Macro(old), FunctionCell::Macro(new)) => Rc::ptr_eq(old, new),
            (FunctionCell::Unbound, FunctionCell::Unbound)
            | (FunctionCell::Builtin, FunctionCell::Builtin) => true,
            _ => false,
        };
        let same_doc = match (&self.doc, &data.variable_doc) {
            (Some(old), Some(new)) => Rc::ptr_eq(old, new),
            (old, new) => old.is_none() && new.is_none(),
        };
        same_function
            && same_doc
            && self.kind == data.kind
            && self.has_value != data.value.is_unbound()
            && self.is_class == image.class(sym).is_some()
    }
}

impl ToldNames {
    /// The definitions in all texts.
    pub(super) fn definitions(
        &mut self,
        image: &Image,
    ) -> Arc<BTreeMap<String, Vec<Arc<Definition>>>> {
        self.definitions.update(image)
    }

    /// Forgets what no longer holds for all names.
    fn forget_old(&mut self, image: &Image, packages: Vec<PackageId>) {
        let types = [Class::Action, Class::Motion].map(|class| schema::all(image, class));
        let types: Vec<Rc<TypeRow>> = types.into_iter().flatten().collect();
        let pairs = || types.iter().zip(&self.types);
        let same_types =
            types.len() == self.types.len() && pairs().all(|(new, old)| Rc::ptr_eq(new, old));
        let present: usize = packages
            .iter()
            .map(|id| image.packages.get(*id).symbols.len())
            .sum();
        let has_gone = self.origins.len() > present;
        if !same_types || packages != self.packages || has_gone {
            let definitions = std::mem::take(&mut self.definitions);
            *self = ToldNames {
                definitions,
                packages,
                types,
                ..ToldNames::default()
            };
            self.names.descriptions = Arc::new(descriptions(image));
        }
    }

    /// The number of a symbol, about which what holds now is told.
    fn number(&mut self, image: &mut Image, sym: Sym) -> usize {
        let number = *self.numbers.entry(sym).or_insert(self.origins.len());
        let origin = self.origins.get_mut(number);
        if origin
            .as_ref()
            .is_some_and(|origin| origin.holds(image, sym))
        {
            return number;
        }
        let told = Arc::new(told_symbol(image, sym, &self.packages));
        match (origin, self.names.symbols.get_mut(number)) {
            (Some(origin), Some(symbol)) => {
                *origin = Origin::of(image, sym);
                *symbol = told;
            }
            _ => {
                self.origins.push(Origin::of(image, sym));
                self.names.symbols.push(told);
            }
        }
        number
    }
}

/// What is known about a symbol, as its home package has it.
fn told_symbol(image: &mut Image, sym: Sym, packages: &[PackageId]) -> KnownSymbol {
    let Some(home) = image.symbol(sym).package else {
        return known_symbol(image, sym, None);
    };
    let outside = image.special(known::V_PACKAGE).clone();
    image.set_special(known::V_PACKAGE, Value::Package(home));
    let told = known_symbol(image, sym, packages.iter().position(|id| *id == home));
    image.set_special(known::V_PACKAGE, outside);
    told
}

impl ToldNames {
    /// What is known about all names.
    pub(crate) fn all(&mut self, image: &mut Image) -> Arc<Names> {
        let ids = image.packages.ids();
        let ids: Vec<_> = ids.filter(|id| *id != PackageTable::SYSTEM).collect();
        let index = |wanted| ids.iter().position(|id| *id == wanted);
        let told = self;
        told.forget_old(image, ids.clone());
        told.names.definitions = told.definitions.update(image);
        told.names.current = index(image.current_package()).unwrap_or_default();
        let names = image.packages.names();
        let names = names.filter_map(|(name, id)| Some((name.to_owned(), index(id)?)));
        told.names.package_names = names.collect();
        for (at, id) in ids.iter().enumerate() {
            let symbols = image.packages.get(*id).symbols.iter();
            let symbols: Vec<(Rc<str>, (Sym, bool))> = symbols
                .map(|(name, present)| (Rc::clone(name), *present))
                .collect();
            let listed = symbols
                .into_iter()
                .map(|(name, (sym, is_external))| (name, (told.number(image, sym), is_external)));
            let listed: Vec<(Rc<str>, (usize, bool))> = listed.collect();
            let package = image.packages.get(*id);
            let uses = package
                .uses
                .iter()
                .filter_map(|used| index(*used))
                .collect();
            let prompt = prompt_name(image, *id);
            let known = told.names.packages.get(at);
            let holds = |known: &&Arc<KnownPackage>| {
                let old = known.symbols.iter();
                let old = old.map(|(name, listed)| (name.as_str(), *listed));
                known.prompt == prompt
                    && *known.name == *package.name
                    && known.uses == uses
                    && old.eq(listed.iter().map(|(name, listed)| (&**name, *listed)))
            };
            if known.filter(holds).is_some() {
                continue;
            }
            let listed = listed
                .into_iter()
                .map(|(name, listed)| (name.to_string(), listed));
            let new = Arc::new(KnownPackage {
                name: package.name.to_string(),
                prompt,
                symbols: listed.collect(),
                uses,
            });
            match told.names.packages.get_mut(at) {
                Some(known) => *known = new,
                None => told.names.packages.push(new),
            }
        }
        Arc::new(told.names.clone())
    }
}

/// The keys of all designators.
fn descriptions(image: &Image) -> Vec<KnownDescription> {
    let keys = |class, name: Option<&str>| {
        let keys = designators::keys_of(image, class, name).into_iter();
        keys.map(|key| (key.name.to_lowercase(), key.is_required))
            .collect()
    };
    let mut found: Vec<KnownDescription> = Vec::new();
    for class in [Class::Action, Class::Motion] {
        for row in schema::all(image, class) {
            let types: Vec<String> = row.names().map(str::to_lowercase).collect();
            if !found
                .iter()
                .any(|known| known.class == class.name() && known.types == types)
            {
                found.push(KnownDescription {
                    class: class.name(),
                    types,
                    keys: keys(class, Some(&row.name)),
                });
            }
        }
    }
    found.extend(
        [Class::Object, Class::Location].map(|class| KnownDescription {
            class: class.name(),
            types: Vec::new(),
            keys: keys(class, None),
        }),
    );
    found
}

fn known_symbol(image: &Image, sym: Sym, home: Option<usize>) -> KnownSymbol {
    let data = image.symbol(sym);
    let is_keyword = image.is_keyword(sym);
    let function = match data.function {
        FunctionCell::Unbound => None,
        _ => help::signature(image, sym).map(|signature| KnownFunction {
            kind: signature.kind,
            lambda_list: signature.lambda_list,
            doc: signature.doc,
            library: library_definition(image, sym),
        }),
    };
    let is_variable =
        !is_keyword && (data.kind != VariableKind::Lexical || !data.value.is_unbound());
    let topics = if is_keyword {
        String::new()
    } else {
        help::topics_of(image, sym)
    };
    KnownSymbol {
        name: data.name.to_string(),
        package: home.unwrap_or_default(),
        function,
        is_variable,
        variable_doc: data.variable_doc.as_deref().map(str::to_owned),
        is_class: image.class(sym).is_some(),
        topics,
    }
}

/// The definition of a function of the language that is written in Lisp.
fn library_definition(image: &Image, sym: Sym) -> Option<LibraryText> {
    match image.entry(sym)? {
        Entry::Library(definition) => Some(LibraryText {
            place: definition.location(),
            text: definition.text(),
        }),
        Entry::Builtin(_) | Entry::Operator(_) => None,
    }
}

//! What is known about all names, as data.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::lisp::builtin::Entry;
use crate::lisp::builtins::help;
use crate::lisp::image::Image;
use crate::lisp::value::package::PackageTable;
use crate::lisp::value::symbol::{FunctionCell, Sym, VariableKind};
use crate::plan::designator::schema;
use crate::plan::designator::value::Class;
use crate::session::Session;
use crate::session::dialogue::{
    Definition, KnownDescription, KnownFunction, KnownPackage, KnownSymbol, LibraryText, Names,
};

use super::{definitions, designators};

/// The definitions in the texts that have been read so far.
#[derive(Default)]
pub(in crate::session) struct Definitions {
    /// Number of texts that have been searched.
    searched: usize,
    found: Arc<BTreeMap<String, Vec<Arc<Definition>>>>,
}

impl Definitions {
    /// Searches the texts that are new.
    pub(super) fn update(&mut self, image: &Image) -> Arc<BTreeMap<String, Vec<Arc<Definition>>>> {
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

impl Session {
    /// What is known about all names.
    pub(in crate::session) fn all_names(&mut self) -> Arc<Names> {
        let definitions = self.definitions.update(&self.image);
        let image = &self.image;
        let mut names = Names {
            definitions,
            descriptions: descriptions(image),
            ..Names::default()
        };
        let ids = image.packages.ids();
        let ids: Vec<_> = ids.filter(|id| *id != PackageTable::SYSTEM).collect();
        let index = |wanted| ids.iter().position(|id| *id == wanted);
        names.current = index(image.current_package()).unwrap_or_default();
        for (name, id) in image.packages.names() {
            if let Some(at) = index(id) {
                names.package_names.insert(name.to_owned(), at);
            }
        }
        let mut numbers: BTreeMap<Sym, usize> = BTreeMap::new();
        for id in &ids {
            let package = image.packages.get(*id);
            let mut known = KnownPackage {
                name: package.name.to_string(),
                prompt: self.prompt_name(*id),
                uses: package
                    .uses
                    .iter()
                    .filter_map(|used| index(*used))
                    .collect(),
                ..KnownPackage::default()
            };
            for (name, (sym, is_external)) in &package.symbols {
                let number = *numbers.entry(*sym).or_insert_with(|| {
                    let home = image.symbol(*sym).package.and_then(index);
                    names.symbols.push(known_symbol(image, *sym, home));
                    names.symbols.len() - 1
                });
                known
                    .symbols
                    .insert(name.to_string(), (number, *is_external));
            }
            names.packages.push(known);
        }
        Arc::new(names)
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

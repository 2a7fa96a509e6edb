//! Keeping what forms are compiled to.

use std::collections::BTreeMap;
use std::rc::Rc;

use indexmap::{IndexMap, IndexSet};

use super::encode::{self, Encoding};
use crate::image::Image;
use crate::source::SourceId;
use crate::value::Value;
use crate::value::code::Code;
use crate::value::known;
use crate::value::package::PackageTable;
use crate::value::symbol::Sym;

/// Keeps what the forms of files are compiled to.
#[derive(Default)]
pub struct Precompiler {
    symbols: Symbols,
    /// How many of them files that are loaded whole refer to, at most.
    loaded: usize,
    present: Vec<u32>,
    gensym_counter: u32,
    files: BTreeMap<String, BTreeMap<usize, Option<Vec<u8>>>>,
}

/// The symbols that are referred to, in the order in which they were met, with their homes.
#[derive(Default)]
pub(super) struct Symbols(IndexMap<Sym, (Option<String>, String)>);

impl Symbols {
    /// The number of a symbol; `None` if it cannot be found by its name.
    pub(super) fn number(&mut self, image: &Image, sym: Sym) -> Option<u32> {
        if let Some(number) = self.0.get_index_of(&sym) {
            return u32::try_from(number).ok();
        }
        let data = image.symbol(sym);
        let home = match data.package {
            Some(home) => {
                let (found, _) = image.packages.find_symbol(home, &data.name)?;
                if found != sym {
                    return None;
                }
                Some(image.packages.get(home).name.to_string())
            }
            None => None,
        };
        let (number, _) = self.0.insert_full(sym, (home, data.name.to_string()));
        u32::try_from(number).ok()
    }
}

/// What one form at top level is being compiled to.
pub struct Recording {
    encoding: Option<Encoding>,
}

impl Recording {
    /// Of a form of a file of which all forms are evaluated, one after the other: the functions that it makes
    /// are read when they are first needed.
    pub fn of_loaded(source: SourceId) -> Recording {
        Recording {
            encoding: Some(Encoding::of(Some(source), true)),
        }
    }

    /// Of a form that is evaluated when it is first needed: of a source, or of a text that is read without
    /// places.
    pub fn of_deferred(source: Option<SourceId>) -> Recording {
        Recording {
            encoding: Some(Encoding::of(source, false)),
        }
    }

    /// Adds a part, unless something of it cannot be written down: then there is nothing to keep.
    pub fn add(&mut self, image: &mut Image, code: &Rc<Code>) {
        let Some(mut precompiler) = image.library.precompiler.take() else {
            return;
        };
        let added = self.encoding.as_mut().map(|encoding| {
            let symbols = &mut precompiler.symbols;
            encoding.add(image, symbols, code)
        });
        if added.flatten().is_none() {
            self.encoding = None;
        }
        image.library.precompiler = Some(precompiler);
    }

    /// Keeps it as that of the form of a file that begins at a byte.
    pub fn finish(self, image: &mut Image, file: &str, start: usize) {
        if let Some(precompiler) = &mut image.library.precompiler {
            let forms = precompiler.files.entry(file.to_owned()).or_default();
            forms.insert(start, self.encoding.map(Encoding::into_bytes));
        }
    }
}

impl Precompiler {
    /// Notes which symbols are there, of those that were made from a number on, and where the
    /// counter of `gensym` stands.
    pub fn settle(image: &mut Image, first: usize) {
        let Some(mut precompiler) = image.library.precompiler.take() else {
            return;
        };
        for (sym, data) in image.symbols.iter().skip(first) {
            let is_seen = data
                .package
                .is_some_and(|home| home != PackageTable::SYSTEM);
            if is_seen {
                precompiler
                    .present
                    .extend(precompiler.symbols.number(image, sym));
            }
        }
        precompiler.loaded = precompiler.symbols.0.len();
        if let Value::Int(counter) = image.special(known::V_GENSYM_COUNTER) {
            precompiler.gensym_counter = u32::try_from(*counter).unwrap_or(0);
        }
        image.library.precompiler = Some(precompiler);
    }

    /// All of it, as bytes.
    pub fn finish(self) -> Vec<u8> {
        let mut packages = IndexSet::new();
        packages.extend(
            self.symbols
                .0
                .values()
                .filter_map(|(home, _)| home.as_deref()),
        );
        let mut bytes = Vec::new();
        encode::count(&mut bytes, packages.len());
        for name in &packages {
            encode::text(&mut bytes, name);
        }
        encode::count(&mut bytes, self.symbols.0.len());
        for (home, name) in self.symbols.0.values() {
            let home = home.as_deref().and_then(|home| packages.get_index_of(home));
            encode::count(&mut bytes, home.map_or(0, |number| number + 1));
            encode::text(&mut bytes, name);
        }
        encode::count(&mut bytes, self.loaded);
        encode::count(&mut bytes, self.present.len());
        for number in self.present {
            encode::number(&mut bytes, number);
        }
        encode::number(&mut bytes, self.gensym_counter);
        encode::count(&mut bytes, self.files.len());
        for (name, forms) in self.files {
            encode::text(&mut bytes, &name);
            encode::count(&mut bytes, forms.len());
            for (start, code) in forms {
                encode::count(&mut bytes, start);
                bytes.push(code.is_some().into());
                if let Some(code) = code {
                    encode::slice(&mut bytes, &code);
                }
            }
        }
        bytes
    }
}

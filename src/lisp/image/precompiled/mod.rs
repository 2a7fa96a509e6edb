//! Compiled code of the library and the plans that are built in, made ahead of time.
//!
//! A [`Precompiler`] keeps what the forms of files are compiled to while an image reads and
//! evaluates them. A [`Precompiled`] is that, read again: any image evaluates the same forms from
//! it without reading, expanding or compiling them. A unit is what one form at top level of a file
//! is compiled to. A form whose code has constants that cannot be written down has no unit; it is
//! read from its text, as all forms are if there is nothing made ahead.

mod encode;
mod record;
mod unit;

use std::collections::BTreeMap;
use std::sync::OnceLock;

use super::Image;
use crate::value::Value;
use crate::value::known;
use crate::value::symbol::Sym;

pub use record::{Precompiler, Recording};
use unit::Bytes;
pub use unit::Unit;

/// What all images of the process start from.
static PROVIDED: OnceLock<Option<Precompiled>> = OnceLock::new();

/// Compiled code of files.
pub struct Precompiled {
    symbols: Vec<KnownSymbol>,
    /// How many of them have been found once all files are loaded.
    loaded: u32,
    /// The symbols that are there after loading, by number, in order of creation.
    present: Vec<u32>,
    /// The counter of `gensym` after loading.
    gensym_counter: u32,
    files: BTreeMap<&'static str, Vec<Form>>,
}

/// A symbol that code refers to.
struct KnownSymbol {
    /// Its home package; none if it is uninterned.
    package: Option<&'static str>,
    name: &'static str,
}

/// A form at top level of a file.
pub struct Form {
    /// The byte at which it begins.
    pub start: usize,
    /// What it is compiled to, if that could be written down.
    code: Option<&'static [u8]>,
}

impl Form {
    /// Is there code, or has the form to be read?
    pub fn is_compiled(&self) -> bool {
        self.code.is_some()
    }
}

/// What an image has found of the symbols, by number.
pub type Resolved = Vec<Option<Sym>>;

impl Precompiled {
    /// Reads what [`Precompiler::finish`] has written; `None` if it is something else.
    pub fn read(bytes: &'static [u8]) -> Option<Precompiled> {
        let mut bytes = Bytes(bytes);
        let mut packages = Vec::new();
        for _ in 0..bytes.count()? {
            packages.push(bytes.text()?);
        }
        let mut symbols = Vec::new();
        for _ in 0..bytes.count()? {
            let package = match bytes.count()? {
                0 => None,
                number => Some(*packages.get(number - 1)?),
            };
            let name = bytes.text()?;
            symbols.push(KnownSymbol { package, name });
        }
        let loaded = bytes.number()?;
        let mut present = Vec::new();
        for _ in 0..bytes.count()? {
            present.push(bytes.number()?);
        }
        let gensym_counter = bytes.number()?;
        let mut files = BTreeMap::new();
        for _ in 0..bytes.count()? {
            let (name, mut forms) = (bytes.text()?, Vec::new());
            for _ in 0..bytes.count()? {
                let start = bytes.count()?;
                let code = match bytes.byte()? {
                    0 => None,
                    _ => Some(bytes.slice()?),
                };
                forms.push(Form { start, code });
            }
            files.insert(name, forms);
        }
        bytes.is_empty().then_some(Precompiled {
            symbols,
            loaded,
            present,
            gensym_counter,
            files,
        })
    }

    /// The forms of a file, in the order of the text.
    pub fn file(&self, name: &str) -> Option<&[Form]> {
        self.files.get(name).map(Vec::as_slice)
    }

    /// The form of a file that begins at a byte.
    pub fn form(&self, file: &str, start: usize) -> Option<&Form> {
        let forms = self.files.get(file)?;
        let at = forms.binary_search_by_key(&start, |form| form.start).ok()?;
        forms.get(at)
    }
}

/// Lets all images that are made in this process from now on start from what [`Precompiler::finish`]
/// has written, unless they start from something already.
pub fn provide(bytes: &'static [u8]) {
    PROVIDED.get_or_init(|| Precompiled::read(bytes));
}

/// What images start from.
pub fn provided() -> Option<&'static Precompiled> {
    PROVIDED.get()?.as_ref()
}

impl Image {
    /// After forms of files that are loaded whole: makes the symbols present that reading them
    /// would have made, and counts on the names of `gensym` as expanding them would have done.
    pub fn settle_precompiled(&mut self, precompiled: &'static Precompiled) {
        // What functions refer to that are read later is the same in all copies.
        for number in precompiled
            .present
            .iter()
            .copied()
            .chain(0..precompiled.loaded)
        {
            unit::resolve(self, precompiled, number);
        }
        let counter = i64::from(precompiled.gensym_counter);
        self.set_special(known::V_GENSYM_COUNTER, Value::Int(counter));
    }
}

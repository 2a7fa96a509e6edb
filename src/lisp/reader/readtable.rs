//! Characters to which a program gives a meaning: `set-macro-character`.

use std::borrow::Cow;
use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, BTreeSet};

use super::lexer::is_blank;
use crate::image::Image;
use crate::value::Value;
use crate::value::copy::Copier;
use crate::value::foreign::{Foreign, ForeignCopy, PrintContext};
use crate::value::known;
use crate::value::symbol::Sym;

/// What the reader does with the letters of symbols: `readtable-case`.
#[derive(Clone, Copy, Default, PartialEq, Eq, Debug)]
pub enum LetterCase {
    /// They become capitals.
    #[default]
    Upcase,
    /// They become small.
    Downcase,
    /// They stay as they are.
    Preserve,
    /// If they are all in one case, they change to the other one.
    Invert,
}

impl LetterCase {
    /// All cases, with the keywords that name them.
    const NAMES: [(LetterCase, Sym); 4] = [
        (LetterCase::Upcase, known::K_UPCASE),
        (LetterCase::Downcase, known::K_DOWNCASE),
        (LetterCase::Preserve, known::K_PRESERVE),
        (LetterCase::Invert, known::K_INVERT),
    ];

    /// The keyword that names it.
    pub fn keyword(self) -> Sym {
        let found = LetterCase::NAMES.iter().find(|(case, _)| *case == self);
        found.map_or(known::K_UPCASE, |(_, name)| *name)
    }

    /// The case that a keyword names.
    pub fn named(name: Sym) -> Option<LetterCase> {
        let found = LetterCase::NAMES.iter().find(|(_, other)| *other == name);
        found.map(|(case, _)| *case)
    }

    /// That of the current readtable.
    pub fn current(image: &Image) -> LetterCase {
        let table = image.special(known::V_READTABLE);
        let table = table.as_foreign::<Readtable>();
        table.map_or(LetterCase::Upcase, |table| table.case.get())
    }
}

/// A program's changes to the standard syntax.
#[derive(Default, Clone)]
pub(crate) struct Readtable {
    /// Functions of stream and character, with whether the character may appear inside a
    /// token.
    pub macros: RefCell<BTreeMap<char, (Value, bool)>>,
    /// Functions of stream, sub-character and number, by dispatching character and
    /// sub-character (in upper case).
    pub dispatch: RefCell<BTreeMap<(char, char), Value>>,
    /// Characters that are parts of symbols, whatever they are in the standard syntax.
    pub(crate) constituents: RefCell<BTreeSet<char>>,
    /// What happens to letters.
    pub case: Cell<LetterCase>,
}

impl Readtable {
    /// Takes the syntax of another one.
    pub(crate) fn become_like(&self, other: Readtable) {
        self.macros.replace(other.macros.into_inner());
        self.dispatch.replace(other.dispatch.into_inner());
        self.constituents.replace(other.constituents.into_inner());
        self.case.set(other.case.get());
    }

    /// Characters that end a token.
    pub(crate) fn terminators(&self) -> Vec<char> {
        self.macros
            .borrow()
            .iter()
            .filter(|(_, (_, inside))| !inside)
            .map(|(c, _)| *c)
            .collect()
    }

    /// Characters that are not what they are in the standard syntax: parts of symbols, and blank
    /// macro characters.
    pub(crate) fn significant(&self) -> Vec<char> {
        let constituents = self.constituents.borrow();
        let macros = self.macros.borrow();
        let blank_macros = macros.keys().filter(|c| is_blank(**c));
        constituents.iter().chain(blank_macros).copied().collect()
    }

    pub(crate) fn macro_of(&self, c: char) -> Option<Value> {
        self.macros.borrow().get(&c).map(|(f, _)| f.clone())
    }

    pub(crate) fn dispatch_of(&self, letter: char) -> Option<Value> {
        self.dispatch.borrow().get(&('#', letter)).cloned()
    }
}

/// The text of a token, with escapes before the characters that would escape others although the
/// readtable makes letters of them.
pub fn escaped<'t>(image: &Image, token: &'t str) -> Cow<'t, str> {
    let table = image.special(known::V_READTABLE);
    let Some(table) = table.as_foreign::<Readtable>() else {
        return token.into();
    };
    let constituents = table.constituents.borrow();
    let is_letter = |c: char| matches!(c, '\\' | '|') && constituents.contains(&c);
    if constituents.is_empty() || !token.contains(is_letter) {
        return token.into();
    }
    let escape = |c| is_letter(c).then_some('\\').into_iter().chain([c]);
    token.chars().flat_map(escape).collect()
}

impl Foreign for Readtable {
    fn copied(&self, copier: &mut Copier) -> ForeignCopy {
        let macros = self.macros.borrow();
        let macros = macros.iter().map(|(c, (function, inside))| {
            let copy = copier.value(function);
            (*c, (copy, *inside))
        });
        let macros = macros.collect();
        let dispatch = self.dispatch.borrow();
        let dispatch = dispatch.iter();
        let dispatch = dispatch.map(|(c, function)| (*c, copier.value(function)));
        ForeignCopy::New(Box::new(Readtable {
            macros: RefCell::new(macros),
            dispatch: RefCell::new(dispatch.collect()),
            constituents: self.constituents.clone(),
            case: self.case.clone(),
        }))
    }

    fn type_symbol(&self) -> Sym {
        known::READTABLE
    }

    fn print(&self, _: &dyn PrintContext, _: bool) -> String {
        "#<READTABLE>".to_owned()
    }
}

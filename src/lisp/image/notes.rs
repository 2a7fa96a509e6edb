//! What the compiler notices about a program beside what it needs for its code: the
//! material of checks. Notes are taken only while [`Image::notes`] is there, and never
//! change what is compiled.
//!
//! [`Image::notes`]: crate::lisp::image::Image::notes

use crate::lisp::source::Place;
use crate::lisp::value::Value;
use crate::lisp::value::symbol::Sym;

/// Something that was noticed.
#[derive(Clone)]
pub(crate) struct Note {
    /// The innermost form with a place.
    pub(crate) place: Place,
    /// What it is.
    pub(crate) kind: NoteKind,
}

/// What was noticed.
#[derive(Clone)]
pub(crate) enum NoteKind {
    /// A global function is called with so many arguments, or only named.
    Function(Sym, Option<usize>),
    /// A name is read as a global variable, and the bound name that is nearest to it.
    Variable(Sym, Option<Sym>),
    /// A global variable is assigned.
    Assigned(Sym),
    /// A form whose operator defines something.
    Definition(Value),
    /// A mistake in a form, for people, and the name that is wrong.
    Mistake {
        /// The wrong name in upper case.
        name: String,
        /// What is wrong.
        text: String,
    },
}

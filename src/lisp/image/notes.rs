//! What the compiler notices about a program beyond what it needs to generate code: the material
//! for checks. Notes are taken only while [`Image::notes`] is set, and never change what is
//! compiled.
//!
//! [`Image::notes`]: crate::image::Image::notes

use crate::source::Place;
use crate::value::Value;
use crate::value::symbol::Sym;

/// Something that was noticed.
#[derive(Clone)]
pub struct Note {
    /// The innermost form with a place.
    pub place: Place,
    /// What it is.
    pub kind: NoteKind,
}

/// What was noticed.
#[derive(Clone)]
pub enum NoteKind {
    /// A global function is called by a form.
    Call(Sym, Value),
    /// A global function is named.
    Function(Sym),
    /// A name is read as a global variable; the second name is the closest bound one.
    Variable(Sym, Option<Sym>),
    /// A global variable is assigned.
    Assigned(Sym),
    /// A form whose operator defines something.
    Definition(Value),
    /// A goal that is written in place and not as a value: what begins with a question mark in it is a variable of the
    /// program.
    Goal(Value),
    /// The type that a handler is for.
    Handled(Value),
    /// A variable that a program binds but never reads; is it assigned?
    Unused(Sym, bool),
    /// A form after one that never returns.
    Unreachable,
    /// A `(return)` in an endless `loop` that leaves only the form of this operator, while
    /// nothing leaves the loop.
    CaughtReturn(Sym),
    /// A mistake in a form, described for the user, and the name that is wrong.
    Mistake {
        /// The wrong name in upper case.
        name: String,
        /// What is wrong.
        text: String,
    },
}

//! Forms that are not finished.

use crate::value::known;
use crate::value::symbol::Sym;

/// A form that is not finished.
pub(super) struct Frame {
    pub(super) kind: Kind,
    pub(super) start: usize,
    pub(super) base: usize,
}

#[derive(Clone, Copy, PartialEq)]
pub(super) enum Dot {
    None,
    Expecting,
    Done,
}

#[derive(Clone, Copy)]
pub(super) enum Kind {
    List(Dot),
    Vector(Option<u32>),
    /// `'x`, `#'x`
    Wrap(Sym),
    Backquote,
    Comma(Sym),
    /// `#+` (true) and `#-` (false), before the feature expression.
    Feature(bool),
    /// Before a form that is left out.
    Skip,
    /// Before a whole form that is read as `NIL`: `*read-suppress*`.
    Suppressed,
    Evaluate,
    Array(u32),
    /// `#A` without a number.
    TypedArray,
    Structure,
    Complex,
    Pathname,
    Label(u32),
}

impl Kind {
    pub(super) fn what(self) -> &'static str {
        match self {
            Kind::List(_) => "a list",
            Kind::Vector(_) => "a vector",
            Kind::Wrap(known::FUNCTION) => "the form after #'",
            Kind::Wrap(_) => "the form after '",
            Kind::Backquote => "the form after `",
            Kind::Comma(_) => "the form after ,",
            Kind::Feature(true) => "the feature expression after #+",
            Kind::Feature(false) => "the feature expression after #-",
            Kind::Suppressed => "a form that is left out",
            Kind::Skip => "the form that a feature expression leaves out",
            Kind::Evaluate => "the form after #.",
            Kind::Array(_) | Kind::TypedArray => "the array after #A",
            Kind::Structure => "the structure after #S",
            Kind::Complex => "the number after #C",
            Kind::Pathname => "the pathname after #P",
            Kind::Label(_) => "the form after #n=",
        }
    }
}

//! Where names are used, as data.

use thiserror::Error;

use lisp::source::Location;

/// How something uses a name.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Relation {
    /// A function calls it, or performs actions or motions of that type.
    Calls,
    /// It is what the function of that name calls.
    Callees,
    /// A function reads the variable.
    References,
    /// A function assigns the variable.
    Sets,
    /// A function binds the variable.
    Binds,
    /// A definition uses the macro.
    Expands,
    /// A method is for the class.
    Specializes,
}

/// A place where something is used.
#[derive(Clone, PartialEq, Debug)]
pub struct Use {
    /// The function or method there; for callees, what is called.
    pub label: String,
    /// The place.
    pub place: Option<Location>,
}

/// Calls of this function are compiled in place, and not recorded.
#[derive(Clone, Copy, Debug, Error)]
#[error("calls of it are compiled in place; code does not tell who calls it")]
pub struct Unrecorded;

//! What can be wrong with a control string and its arguments.

use thiserror::Error;

use crate::value::known;
use crate::value::raise::Raise;

/// A wrong control string, or too few arguments for one.
#[derive(Clone, PartialEq, Debug, Error)]
#[error("error in FORMAT: {problem}\n  {control}\n  {}^", " ".repeat(*position))]
pub struct FormatError {
    /// What is wrong.
    pub problem: Problem,
    /// The control string.
    pub control: String,
    /// The index of the character in question.
    pub position: usize,
}

/// What is wrong.
#[derive(Clone, PartialEq, Debug, Error)]
pub enum Problem {
    /// The string ends after a tilde.
    #[error("String ended before directive was found.")]
    Unfinished,
    /// A letter that means nothing.
    #[error("Unknown format directive (character: {0})")]
    Unknown(char),
    /// `~{` without `~}` and the like.
    #[error("No corresponding close {0}.")]
    NotClosed(&'static str),
    /// `~}` without `~{` and the like.
    #[error("No matching open {0}.")]
    NotOpened(&'static str),
    /// `~;` outside `~[` and `~<`.
    #[error("~; directive not contained within either ~[...~] or ~<...~>.")]
    StrayClause,
    /// Directives nested too deeply.
    #[error("Directives are nested more than {0} deep.")]
    TooDeep(usize),
    /// Too few arguments.
    #[error("No more arguments")]
    NoMoreArguments,
    /// `~*` leads outside the arguments.
    #[error("Index {index} is out of bounds: it should have been between 0 and {count}.")]
    OutOfBounds {
        /// The position asked for.
        index: i64,
        /// Number of arguments.
        count: usize,
    },
    /// A parameter that a directive does not have.
    #[error("Too many parameters: at most {most} expected, {given} given")]
    TooManyParameters {
        /// The most parameters that it has.
        most: usize,
        /// Parameters given.
        given: usize,
    },
    /// `~:@[` and the like.
    #[error("Cannot specify both the colon and at-sign modifiers.")]
    BothModifiers,
    /// The wrong number of clauses.
    #[error("{0}")]
    Clauses(&'static str),
    /// An argument that the directive cannot print.
    #[error("{0}")]
    Argument(String),
}

impl From<FormatError> for Box<Raise> {
    fn from(error: FormatError) -> Box<Raise> {
        Raise::new(known::FORMAT_ERROR, error.to_string())
    }
}

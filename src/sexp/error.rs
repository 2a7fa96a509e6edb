//! What can be wrong with a data file.

use thiserror::Error;

/// The first thing that is wrong with a data file.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{file}:{line}:{column}: {problem}")]
pub(crate) struct DataError {
    /// Name of the file as it was given.
    pub(crate) file: String,
    /// Line, from 1.
    pub(crate) line: usize,
    /// Column in bytes, from 1.
    pub(crate) column: usize,
    /// What is wrong.
    pub(crate) problem: Box<DataProblem>,
}

/// What is wrong with a data file.
#[derive(Clone, Debug, PartialEq, Error)]
pub(crate) enum DataProblem {
    /// The text is not a row of s-expressions.
    #[error("{0}")]
    Syntax(String),
    /// A value of another kind stands there.
    #[error("expected {expected}, found {found}")]
    Unexpected {
        /// What would be right.
        expected: String,
        /// What stands there.
        found: String,
    },
    /// A record lacks a key.
    #[error("({record} …) has no :{key}; add it")]
    MissingKey {
        /// Head of the record.
        record: String,
        /// The key without its colon.
        key: String,
    },
    /// A record has a key that means nothing.
    #[error("({record} …) has no key :{key}; it knows {}{}", keys(.known), did_you_mean(.closest))]
    UnknownKey {
        /// Head of the record.
        record: String,
        /// The key without its colon.
        key: String,
        /// The keys that it may have.
        known: Vec<String>,
        /// The nearest of them.
        closest: Option<String>,
    },
    /// A record has a key twice, or the file has a record twice.
    #[error("{0} is given twice; keep one")]
    Repeated(String),
    /// The file lacks a record.
    #[error("the file has no ({0} …); add one")]
    MissingRecord(String),
    /// Something is named that does not exist.
    #[error("there is no {kind} named {name}{}", did_you_mean(.closest))]
    UnknownName {
        /// What is named, such as `link`.
        kind: String,
        /// The unknown name.
        name: String,
        /// The nearest known name.
        closest: Option<String>,
    },
    /// Anything else.
    #[error("{0}")]
    Invalid(String),
}

fn keys(known: &[String]) -> String {
    let keys: Vec<String> = known.iter().map(|k| format!(":{k}")).collect();
    keys.join(" ")
}

fn did_you_mean(closest: &Option<String>) -> String {
    match closest {
        Some(name) => format!("; did you mean {name}?"),
        None => String::new(),
    }
}

//! Errors in data files.

use thiserror::Error;

/// The first error in a data file.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{file}:{line}:{column}: {problem}")]
pub struct DataError {
    /// Name of the file as given.
    pub file: String,
    /// Line, from 1.
    pub line: usize,
    /// Column in bytes, from 1.
    pub column: usize,
    /// The problem.
    pub problem: Box<DataProblem>,
}

/// A problem in a data file.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum DataProblem {
    /// The text is not a sequence of s-expressions.
    #[error("{0}")]
    Syntax(String),
    /// A value of another kind was expected.
    #[error("expected {expected}, found {found}")]
    Unexpected {
        /// What was expected.
        expected: String,
        /// What was found.
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
    /// A record has an unknown key.
    #[error("({record} …) has no key :{key}; it knows {}{}", keys(.known), did_you_mean(.closest))]
    UnknownKey {
        /// Head of the record.
        record: String,
        /// The key without its colon.
        key: String,
        /// The known keys.
        known: Vec<String>,
        /// The known key nearest to it.
        closest: Option<String>,
    },
    /// A key occurs twice in a record, or a record twice in the file.
    #[error("{0} is given twice; keep one")]
    Repeated(String),
    /// The file lacks a record.
    #[error("the file has no ({0} …); add one")]
    MissingRecord(String),
    /// A name refers to nothing that exists.
    #[error("there is no {kind} named {name}{}", did_you_mean(.closest))]
    UnknownName {
        /// The kind of thing named, such as `link`.
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

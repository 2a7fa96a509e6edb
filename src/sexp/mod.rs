//! Our own data files: s-expressions read with lexpr.
//!
//! A file is a row of records `(head thing … :key value …)`. Every value knows its place,
//! so whatever is wrong with a file is said once, with file, line and column. This is not
//! the reader of the plan language.

mod error;
mod file;
mod node;
mod record;

pub(crate) use error::{DataError, DataProblem};
pub(crate) use file::DataFile;
pub(crate) use node::Node;
pub(crate) use record::Record;

//! Our own data files: s-expressions read with lexpr.
//!
//! A file is a sequence of records `(head thing … :key value …)`. Every value knows its place,
//! so errors in a file are reported with file, line and column in one way. This is not the
//! reader of the plan language.

mod error;
mod file;
mod node;
mod record;

pub use error::{DataError, DataProblem};
pub use file::DataFile;
pub use node::Node;
pub use record::Record;

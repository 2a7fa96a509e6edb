//! The faces of a session: the command line, the prompt in a terminal, notebooks, transcripts and
//! the reference manual.

pub(crate) mod command;
pub(crate) mod jupyter;
pub(crate) mod manual;
pub mod measured;
pub(crate) mod prompt;
pub(crate) mod swank;
pub(crate) mod sweep_report;
pub(crate) mod transcript;

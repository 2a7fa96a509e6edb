//! The faces of a session: the command line, the prompt in a terminal, transcripts and the
//! reference manual.

pub mod command;
pub mod manual;
pub mod prompt;
pub mod transcript;

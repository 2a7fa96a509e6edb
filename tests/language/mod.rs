//! The language as a whole session has it.

mod checked;
mod cram_utilities;
mod examples;
mod library;
mod limits;
mod time;

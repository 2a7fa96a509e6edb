//! What programs that write plans can ask for: one table of tools, which assistants use over the Model Context
//! Protocol ([`crate::mcp`]), and editors and tests as plain lines of JSON ([`Lines`]).

mod answer;
mod arguments;
mod check;
pub(crate) mod documents;
mod lines;
mod look;
mod requests;
mod run;
mod run_plan;
mod sweep;
mod table;
mod world;

pub(crate) use answer::Answer;
pub(crate) use arguments::described;
pub(crate) use lines::Lines;
pub(crate) use requests::{MAX_REQUEST, TooLong, next_line};
pub(crate) use table::{TOOLS, called};
pub(crate) use world::{Opened, World};

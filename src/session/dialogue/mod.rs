//! The dialogue between user and evaluator: inputs go in, events come out, and a screen
//! shows the events as text.
//!
//! The prompt, the runner and the replayer of transcripts all use this folder, so that they
//! show the same bytes for the same events. Nothing in here knows Lisp beyond its tokens, nor
//! where the text is finally written.

mod converse;
pub(crate) mod evaluate;
mod evaluate_on;
mod illustrate;
mod input;
mod lambda_list;
mod names;
pub(crate) mod prompt_line;
pub(crate) mod repeat;
pub(crate) mod screen;
mod serve;
mod shown_ahead;
mod uses;

pub(crate) use converse::{Candidate, Completions, Converse};
pub use evaluate::{Abort, ActionStep, Evaluate, Event, Finding, Outcome, Severity, Stop};
pub(crate) use evaluate_on::{evaluate_keeping_abort, evaluate_on};
pub(crate) use illustrate::{Illustrate, Swept, Table};
pub(crate) use input::{ends_in_quotes, is_whole};
pub(crate) use lambda_list::{current_parameter, parameters};
pub(crate) use names::{
    Definition, KnownDescription, KnownFunction, KnownPackage, KnownSymbol, LibraryText, Names,
};
pub(crate) use repeat::Repeat;
pub(crate) use screen::Screen;
pub(crate) use serve::{Beginning, Inspection, Need, ObjectNumber, Serve, StackFrame};
pub(crate) use shown_ahead::ShownAhead;
pub(crate) use uses::{Relation, Unrecorded, Use};

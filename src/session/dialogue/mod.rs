//! The dialogue between user and evaluator: inputs go in, events come out, and a screen
//! shows the events as text.
//!
//! The prompt, the runner and the replayer of transcripts all use this folder, so that they
//! show the same bytes for the same events. Nothing in here knows Lisp beyond its tokens, nor
//! where the text is finally written.

mod converse;
pub mod evaluate;
mod evaluate_on;
mod illustrate;
mod input;
mod lambda_list;
mod names;
pub mod prompt_line;
pub mod repeat;
pub mod screen;
mod serve;
mod shown_ahead;
mod uses;

pub use converse::{Candidate, Completions, Converse};
pub use evaluate::{
    Abort, ActionStep, Evaluate, Event, Finding, Outcome, Severity, Stop, Suggestion,
};
pub use evaluate_on::{evaluate_keeping_abort, evaluate_on};
pub use illustrate::{Illustrate, Swept, Table};
pub use input::{GrowingInput, ends_in_quotes, is_whole};
pub use lambda_list::{current_parameter, parameters};
pub use names::{
    Definition, KnownDescription, KnownFunction, KnownPackage, KnownSymbol, LibraryText, Names,
};
pub use repeat::Repeat;
pub use screen::Screen;
pub use serve::{Beginning, Inspection, Need, ObjectNumber, Serve, StackFrame};
pub use shown_ahead::ShownAhead;
pub use uses::{Relation, Unrecorded, Use};

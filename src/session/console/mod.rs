//! Evaluating inputs, and what the user may do with evaluations that have stopped: a debugger on top
//! of the suspended task, and the choice after an interrupt.
//!
//! All interaction consists of inputs and events, so that a session can be repeated from its
//! inputs alone. Without a user (`is_interactive` is false) nothing ever stops.

mod aside;
mod beside;
mod choice;
mod choices;
mod commands;
mod evaluator;
mod halt;
mod halting;
mod input;
mod inspector;
mod judging;
mod lesson;
mod line_breaks;
mod other_syntax;
pub(crate) mod recovery;
mod replaced_frames;
mod robot_choices;
mod served;
mod settle;
mod shorthand;
mod stack_frames;
mod stopped;
mod text;

pub(crate) use evaluator::{Ended, Evaluator};
pub(crate) use halt::end_of;

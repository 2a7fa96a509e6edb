//! Transcripts: what a person sees at the prompt, kept in files and run as tests.
//!
//! A line that begins with a prompt `NAME> ` starts an input, which goes on over further
//! lines until its parentheses balance; what follows up to the next prompt is the
//! expected output. Text before the first prompt is a comment. In Markdown, fenced
//! blocks marked `session` hold transcripts. Blanks at the end of a line and blank lines
//! before the next prompt are not compared, nor is the prompt's name. A line `...`
//! stands for any number of lines, `[..]` for any text within a line.
//!
//! Nothing in here knows what evaluates the inputs.

mod align;
mod bless;
mod diff;
mod markdown;
mod parse;
mod pattern;
mod replay;
mod verdict;

pub(crate) use bless::blessed;
pub(crate) use parse::Transcript;
#[cfg(test)]
pub(crate) use replay::replay;
pub(crate) use replay::{replay_all, replay_first};
pub(crate) use verdict::Verdict;

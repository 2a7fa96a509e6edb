//! Transcripts: what a user sees at the prompt, kept in files and run as tests.
//!
//! A line that begins with a prompt `NAME> ` starts an input, which continues over further
//! lines until its parentheses balance; everything up to the next prompt is the expected
//! output. Text before the first prompt is a comment. In Markdown, fenced blocks marked
//! `session` hold transcripts. Trailing blanks, blank lines before the next prompt and the name
//! of the prompt are not compared. A line `...` stands for any number of lines, `[..]` for any
//! text within a line.
//!
//! This module does not know what evaluates the inputs.

mod align;
mod bless;
mod diff;
mod markdown;
mod parse;
mod pattern;
mod replay;
mod verdict;

pub(crate) use bless::blessed;
pub(crate) use markdown::session_blocks;
pub(crate) use parse::Transcript;
#[cfg(test)]
pub(crate) use replay::replay;
pub(crate) use replay::{replay_all, replay_first};
pub(crate) use verdict::Verdict;

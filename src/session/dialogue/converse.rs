//! What the prompt needs from an evaluator beyond evaluation: how to continue after a stop, and
//! what could be typed next.

use std::rc::Rc;

use super::repeat::Repeat;
use lisp::image::input::Source;

/// An evaluator for interactive use.
pub trait Converse: Repeat {
    /// Number of stopped evaluations.
    fn level(&self) -> usize;

    /// The input by which a second Ctrl-C abandons what an interrupt has stopped; `None` if no
    /// interrupt has stopped anything.
    fn answer_to_interrupt(&self) -> Option<&'static str>;

    /// A text with which the next input should be prefilled, for editing; returned once.
    fn take_draft(&mut self) -> Option<String>;

    /// The completions at byte `at` of an input.
    fn completions(&self, text: &str, at: usize) -> Completions;

    /// The signature of the form being typed at byte `at`, with the current argument
    /// between two `*`.
    fn hint(&self, text: &str, at: usize) -> Option<String>;

    /// Whether the name is that of a designator type.
    fn is_designator_type(&self, name: &str) -> bool;

    /// Sets who is asked when a program reads from standard input; without anybody, that is at its
    /// end.
    fn set_source(&mut self, source: Option<Rc<Source>>);

    /// A hash of the world's state.
    fn world_hash(&self) -> u64;

    /// How the last input ended: a word, with the class of the condition that ended or stopped it.
    fn last_ending(&self) -> &str;

    /// Names and texts of the files that have been loaded since this was asked last.
    fn take_loaded(&self) -> Vec<(Rc<str>, Rc<str>)>;

    /// Sets whether simulated time passes without waiting for real time, whatever its pace.
    fn set_hurried(&mut self, is_hurried: bool);

    /// Ends what the session still writes, such as a recording; returns the reason if that
    /// failed.
    fn finish(&mut self) -> Result<(), String>;
}

/// The completions at a place.
#[derive(Clone, Default, PartialEq, Eq, Debug)]
pub struct Completions {
    /// First byte of the text that a candidate replaces, up to the cursor.
    pub start: usize,
    /// The candidates in the order in which they are shown.
    pub candidates: Vec<Candidate>,
}

/// A possible completion.
#[derive(Clone, Default, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Candidate {
    /// The text.
    pub text: String,
    /// One line about it; may be empty.
    pub doc: String,
}

//! What the prompt needs from an evaluator beyond evaluation: how to continue after a stop,
//! what could be typed next, and what is needed to repeat a session.

use super::evaluate::Evaluate;

/// An evaluator for interactive use.
pub(crate) trait Converse: Evaluate {
    /// Sets whether an unhandled condition or an interrupt stops the evaluation where it is,
    /// so that the next input says how to continue; by default, both end it.
    fn set_interactive(&mut self, is_interactive: bool);

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

    /// Where the last input was interrupted, if it was; used to repeat that in another session.
    fn interrupted_at(&self) -> Option<u64>;

    /// Makes the next input be interrupted there.
    fn interrupt_next_at(&mut self, at: u64);

    /// A hash of the world's state.
    fn world_hash(&self) -> u64;
}

/// The completions at a place.
#[derive(Clone, Default, PartialEq, Eq, Debug)]
pub(crate) struct Completions {
    /// First byte of the text that a candidate replaces, up to the cursor.
    pub(crate) start: usize,
    /// The candidates in the order in which they are shown.
    pub(crate) candidates: Vec<Candidate>,
}

/// A possible completion.
#[derive(Clone, Default, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) struct Candidate {
    /// The text.
    pub(crate) text: String,
    /// One line about it; may be empty.
    pub(crate) doc: String,
}

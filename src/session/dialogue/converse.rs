//! What the prompt asks of an evaluator beyond evaluating: how to go on where it stopped,
//! what could be typed next, and what is needed to do the same again.

use super::evaluate::Evaluate;

/// An evaluator that a person talks to.
pub(crate) trait Converse: Evaluate {
    /// From here on, a condition that nobody handles and an interrupt stop the evaluation
    /// where it is, and the next input tells how it goes on; or, as by default, they end it.
    fn set_interactive(&mut self, is_interactive: bool);

    /// How many evaluations stand still.
    fn level(&self) -> usize;

    /// Gives up what an interrupt has stopped: what a second Ctrl-C types; none if nothing
    /// was stopped by an interrupt.
    fn answer_to_interrupt(&self) -> Option<&'static str>;

    /// A text that the next input should begin with, to be changed; told once.
    fn take_draft(&mut self) -> Option<String>;

    /// What could stand at byte `at` of an input.
    fn completions(&self, text: &str, at: usize) -> Completions;

    /// The shape of the form that is being typed at byte `at`, with the current argument
    /// between two `*`.
    fn hint(&self, text: &str, at: usize) -> Option<String>;

    /// Is the name known as that of a type of designators?
    fn is_designator_type(&self, name: &str) -> bool;

    /// Where the last input was interrupted, if it was: repeats that in another session.
    fn interrupted_at(&self) -> Option<u64>;

    /// Has the next input interrupted there.
    fn interrupt_next_at(&mut self, at: u64);

    /// A hash of the world's state.
    fn world_hash(&self) -> u64;
}

/// What could stand at a place.
#[derive(Clone, Default, PartialEq, Eq, Debug)]
pub(crate) struct Completions {
    /// First byte of the text that a candidate takes the place of, up to the cursor.
    pub(crate) start: usize,
    /// In the order in which they are shown.
    pub(crate) candidates: Vec<Candidate>,
}

/// One of the texts that could stand at a place.
#[derive(Clone, Default, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) struct Candidate {
    /// The text.
    pub(crate) text: String,
    /// One line about it; may be empty.
    pub(crate) doc: String,
}

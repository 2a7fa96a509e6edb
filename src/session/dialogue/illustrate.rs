//! What a notebook shows beyond what the prompt does.

use super::converse::Converse;
use sweep::Record;
use sweep::summary::Title;
use view::picture::{Image, View};

/// An evaluator for a face that has room for pictures and longer texts.
pub trait Illustrate: Converse {
    /// Lets what is written about errors come as [`Event::ErrorOutput`](super::Event::ErrorOutput) from now on.
    fn show_errors_apart(&mut self);

    /// All that is known about the name at byte `at` of an input, or about the operator of the form
    /// there, in lines.
    fn description(&self, text: &str, at: usize) -> Option<String>;

    /// Up to `most` frames of the stopped evaluation, innermost first, each on a line.
    fn backtrace(&self, most: usize) -> String;

    /// A picture of the world, of that many pixels; none if the world lacks what the view is of.
    fn depicted(&self, view: View, width: usize, height: usize) -> Option<Image>;

    /// The only value of the last form as a table, if it is a list of designators.
    fn table(&self) -> Option<Table>;

    /// What came of a sweep that has ended since the last call.
    fn take_swept(&mut self) -> Option<Swept>;

    /// The simulated time (s).
    fn now(&self) -> f64;
}

/// Things with the same kinds of properties.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Table {
    /// What is in the columns.
    pub head: Vec<String>,
    /// The things, each with a text for each column; an empty one where it has no such property.
    pub rows: Vec<Vec<String>>,
}

/// What came of a sweep.
#[derive(Clone, PartialEq, Debug)]
pub struct Swept {
    /// What it is called and wants.
    pub title: Title,
    /// What came of each world.
    pub records: Vec<Record>,
}

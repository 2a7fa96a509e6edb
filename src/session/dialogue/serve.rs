//! What an editor needs from an evaluator beyond what a prompt needs: the stack, values and names
//! as data instead of text.
//!
//! Whatever changes the evaluator is an input like those that people type; everything in here
//! only tells, or sets what the next input begins with.

use std::ops::Range;
use std::sync::Arc;

use super::converse::Converse;
use super::evaluate::Stop;
use super::names::Names;
use super::uses::{Relation, Unrecorded, Use};
use lisp::source::Location;
use lisp::value::Value;

/// The number of a value that an editor refers to.
pub type ObjectNumber = u64;

/// An evaluator for an editor.
pub trait Serve: Converse {
    /// Sets whether an editor serves as the front: values are kept so that it can refer to them,
    /// and a value that a form asks to inspect is given to it.
    fn set_served(&mut self, is_served: bool);

    /// Lets programs ask that the session be served to an editor.
    fn let_serve(&mut self);

    /// The port by which a program has asked for that, once.
    fn take_port(&mut self) -> Option<u16>;

    /// The stopped evaluations, each with a number that no other has had, innermost last.
    fn stops(&self) -> Vec<u64>;

    /// The last stop.
    fn last_stop(&self) -> Option<Stop>;

    /// Whether a choice at the last stop needs a value, and whether it asks for an edited form.
    fn choice_needs(&self, choice: usize) -> Need;

    /// The frames of the last stop, innermost first.
    fn stack(&self) -> Vec<StackFrame>;

    /// The variables of a frame, with their values as printed.
    fn frame_variables(&mut self, frame: usize) -> Vec<(String, String)>;

    /// The value of a variable of a frame.
    fn frame_variable(&mut self, frame: usize, variable: usize) -> Option<ObjectNumber>;

    /// The condition of the last stop.
    fn stopped_by(&mut self) -> Option<ObjectNumber>;

    /// What the next input begins with.
    fn beginning(&self) -> Beginning;

    /// Sets what the next input begins with.
    fn begin_with(&mut self, beginning: &Beginning);

    /// Makes a package the current one, by name or nickname in any case. Returns false if there is
    /// none.
    fn enter_package(&mut self, name: &str) -> bool;

    /// The current package: its name, and the name that is shown in prompts.
    fn package_names(&self) -> (String, String);

    /// The number that the next value of a form gets.
    fn next_object(&self) -> ObjectNumber;

    /// The last value of the last form.
    fn last_value(&mut self) -> ObjectNumber;

    /// Makes the value the last value of the last form.
    fn set_last_value(&mut self, object: ObjectNumber) -> bool;

    /// The value that a form asked to inspect, once.
    fn take_inspected(&mut self) -> Option<ObjectNumber>;

    /// Forgets values.
    fn forget_objects(&mut self, objects: &[ObjectNumber]);

    /// The value and those of its parts that are in the range; `None` if it is not known.
    fn look_into(&mut self, object: ObjectNumber, parts: Range<usize>) -> Option<Inspection>;

    /// What is known about all names. Takes some milliseconds.
    fn names(&mut self) -> Arc<Names>;

    /// Where a name, as typed in a package, is used in that way.
    fn uses(&mut self, way: Relation, package: &str, name: &str) -> Result<Vec<Use>, Unrecorded>;
}

/// What a choice needs.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Need {
    /// Nothing.
    Nothing,
    /// A form for its value.
    Value,
    /// The text of a form, which only a prompt can offer for editing.
    Text,
}

/// A frame of a stopped evaluation.
#[derive(Clone, Debug)]
pub struct StackFrame {
    /// The call on one line.
    pub call: String,
    /// The package of what was called, or the current one.
    pub package: String,
    /// The form that it was executing.
    pub place: Option<Location>,
}

/// A value with parts.
#[derive(Clone, Default, Debug)]
pub struct Inspection {
    /// What it is.
    pub title: String,
    /// Names and texts of the parts, with their values unless they have none.
    pub parts: Vec<(String, String, Option<ObjectNumber>)>,
    /// Number of all parts.
    pub count: usize,
}

/// What an input begins with: the current package and the latest forms and values.
#[derive(Clone, Default)]
pub struct Beginning(pub(crate) Vec<Value>);

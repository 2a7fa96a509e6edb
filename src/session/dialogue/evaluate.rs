//! The evaluator as the front sees it.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use crate::lisp::source::Location;
use crate::picture::Image;

/// Something that happened while an input was evaluated.
#[derive(Clone, PartialEq, Debug)]
pub enum Event {
    /// Text that the program printed, or log lines; not necessarily whole lines.
    Output(String),
    /// A form has been evaluated: its values as printed text. Empty for no value.
    Values(Vec<String>),
    /// A picture was made; for those who can show it beside the text.
    Picture(Arc<Image>),
    /// A condition reached the top and nobody handled it: the input ends here.
    Aborted(Box<Abort>),
    /// The evaluation stands still, at a condition that nobody handled or an interrupt,
    /// until somebody chooses how it goes on.
    Stopped(Box<Stop>),
    /// An evaluation that had stopped was given up: the condition as it prints.
    Left(String),
    /// A motion goes on: a line that takes the place of the last one.
    Progress(String),
}

/// An evaluation that stands still.
#[derive(Clone, PartialEq, Default, Debug)]
pub struct Stop {
    /// How many evaluations stand still, this one on top.
    pub level: usize,
    /// Why.
    pub abort: Abort,
    /// The ways to go on; each is chosen by its index.
    pub choices: Vec<String>,
    /// What else can be typed, for people.
    pub remark: &'static str,
}

/// What is known about a condition that nobody handled.
#[derive(Clone, PartialEq, Default, Debug)]
pub struct Abort {
    /// The report of the condition, for people; may span lines.
    pub report: String,
    /// The condition as it prints, `#<TYPE-ERROR …>`.
    pub condition: String,
    /// The innermost form with a known place.
    pub place: Option<Location>,
    /// If that is in a plan that comes with the program: the innermost form outside them.
    pub user_place: Option<Location>,
    /// The actions that were being carried out, innermost first.
    pub actions: Vec<ActionStep>,
}

/// An action that was being carried out when a condition was signalled.
#[derive(Clone, PartialEq, Debug)]
pub struct ActionStep {
    /// The call that carries it out, on one line.
    pub call: String,
    /// Where that call stands.
    pub place: Option<Location>,
}

impl Abort {
    /// What is told beside report and place, as lines: where the user's own text comes in,
    /// and the actions around.
    pub fn context(&self) -> Vec<String> {
        let user = self.user_place.iter();
        let user = user.map(|place| format!("called at {place}:\n{}", place.underlined()));
        let actions = self.actions.iter().map(|action| match &action.place {
            Some(place) => format!("in {} at {place}", action.call),
            None => format!("in {}", action.call),
        });
        user.chain(actions).collect()
    }
}

/// A mistake that was found without evaluating.
#[derive(Clone, PartialEq, Debug)]
pub struct Finding {
    /// What is wrong, for people.
    pub message: String,
    /// Where it is.
    pub place: Option<Location>,
    /// How sure it is.
    pub severity: Severity,
}

/// How sure a mistake is that was found without evaluating.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Severity {
    /// The text cannot be read or compiled.
    Error,
    /// The text will fail if evaluation comes there, unless it defines what is missing in
    /// a way that only running it shows.
    Warning,
}

/// How the evaluation of an input ended.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Outcome {
    /// Every form was evaluated.
    Finished,
    /// A condition was not handled; the forms after it were not evaluated.
    Aborted,
    /// The evaluation stands still; the next input tells how it goes on.
    Stopped,
    /// The program asked to leave, with this exit status.
    Quit(u8),
}

/// An evaluator: takes the text of inputs and tells what happens.
pub trait Evaluate {
    /// Evaluates all forms of `text` in order, telling each event to `sink` as it happens.
    ///
    /// `source_name` is the name that places in the text get.
    fn evaluate(&mut self, source_name: &str, text: &str, sink: &mut dyn FnMut(Event)) -> Outcome;

    /// Looks for mistakes in a text without running it, in the order of the text.
    ///
    /// What the text defines is known afterwards, so that texts that build on one another
    /// can be checked in order.
    fn check(&mut self, source_name: &str, text: &str) -> Vec<Finding>;

    /// The name that the prompt shows: that of the current package, or a short one.
    fn prompt(&self) -> String;

    /// While this holds true, a running evaluation ends as soon as it can.
    fn interrupt_handle(&self) -> Arc<AtomicBool>;
}

impl<E: Evaluate + ?Sized> Evaluate for Box<E> {
    fn evaluate(&mut self, source_name: &str, text: &str, sink: &mut dyn FnMut(Event)) -> Outcome {
        (**self).evaluate(source_name, text, sink)
    }

    fn check(&mut self, source_name: &str, text: &str) -> Vec<Finding> {
        (**self).check(source_name, text)
    }

    fn prompt(&self) -> String {
        (**self).prompt()
    }

    fn interrupt_handle(&self) -> Arc<AtomicBool> {
        (**self).interrupt_handle()
    }
}

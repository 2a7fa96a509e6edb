//! The evaluator as the front ends see it.

use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use lisp::source::Location;
use view::picture::Image;

/// An event during the evaluation of an input.
#[derive(Clone, PartialEq, Debug)]
pub enum Event {
    /// Text printed by the program, or log lines; not necessarily whole lines.
    Output(String),
    /// Text that the program has written about errors, if the image's output is to have it apart; otherwise it is
    /// output.
    ErrorOutput(String),
    /// A form has been evaluated: its printed values. Empty if there are none.
    Values(Vec<String>),
    /// A picture was made, for front ends that can show it.
    Picture(Arc<Image>),
    /// A condition reached the top level unhandled: the input ends here.
    Aborted(Box<Abort>),
    /// The evaluation has stopped, at an unhandled condition or an interrupt, until the user
    /// chooses how to continue.
    Stopped(Box<Stop>),
    /// A stopped evaluation was abandoned: its condition as printed.
    Left(String),
    /// Progress of a motion: a line that replaces the previous one.
    Progress(String),
}

/// A stopped evaluation.
#[derive(Clone, PartialEq, Default, Debug)]
pub struct Stop {
    /// Number of stopped evaluations, this one on top.
    pub level: usize,
    /// The reason.
    pub abort: Abort,
    /// The choices for continuing; each is chosen by its index.
    pub choices: Vec<String>,
    /// Those of the choices that the level below offers, too, and that need not be shown again.
    pub folded: Range<usize>,
    /// A remark on what else can be typed.
    pub remark: &'static str,
}

/// What is known about an unhandled condition.
#[derive(Clone, PartialEq, Default, Debug)]
pub struct Abort {
    /// The report of the condition; may span several lines.
    pub report: String,
    /// The name of the condition's class, `TYPE-ERROR`; empty for an interrupt.
    pub class: String,
    /// The condition as printed, `#<TYPE-ERROR …>`.
    pub condition: String,
    /// What may have been meant by a name that means nothing.
    pub hint: Option<String>,
    /// The innermost form with a known place.
    pub place: Option<Location>,
    /// If that is in a built-in plan: the innermost form outside built-in plans.
    pub user_place: Option<Location>,
    /// The actions that were being performed, innermost first.
    pub actions: Vec<ActionStep>,
}

/// An action that was being performed when a condition was signalled.
#[derive(Clone, PartialEq, Debug)]
pub struct ActionStep {
    /// The call that performs it, on one line.
    pub call: String,
    /// The place of that call.
    pub place: Option<Location>,
}

impl Abort {
    /// The place that concerns the user most: the one in the user's own text, if there is one.
    pub fn main_place(&self) -> Option<&Location> {
        self.user_place.as_ref().or(self.place.as_ref())
    }

    /// Lines shown in addition to report and main place: the place in a built-in plan, and the
    /// enclosing actions.
    pub fn context(&self) -> Vec<String> {
        let inner = self
            .user_place
            .as_ref()
            .and(self.place.as_ref())
            .into_iter();
        let inner = inner.map(|place| format!("signalled at {place}"));
        inner.chain(self.performing()).collect()
    }

    /// A line for each of the enclosing actions.
    pub(crate) fn performing(&self) -> impl Iterator<Item = String> {
        self.actions.iter().map(|action| match &action.place {
            Some(place) => format!("in {} at {place}", action.call),
            None => format!("in {}", action.call),
        })
    }
}

/// A mistake found without evaluating.
#[derive(Clone, PartialEq, Debug)]
pub struct Finding {
    /// What is wrong.
    pub message: String,
    /// Where it is.
    pub place: Option<Location>,
    /// How certain it is.
    pub severity: Severity,
    /// What to write instead, if that is known.
    pub suggestion: Option<Suggestion>,
}

/// What to write in place of a part of a text.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Suggestion {
    /// Line where the part begins, from one.
    pub line: usize,
    /// Column, from one, in characters.
    pub column: usize,
    /// The part; empty where something is missing.
    pub wrong: String,
    /// What to write in its place; empty where something is too much.
    pub replacement: String,
}

/// How certain a mistake is that was found without evaluating.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Severity {
    /// The text cannot be read or compiled.
    Error,
    /// The text will fail if evaluation gets there, unless it defines what is missing in a way
    /// that shows only when it runs.
    Warning,
}

/// How the evaluation of an input ended.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Outcome {
    /// Every form was evaluated.
    Finished,
    /// A condition was not handled; later forms were not evaluated.
    Aborted,
    /// The evaluation has stopped; the next input says how to continue.
    Stopped,
    /// The program asked to exit with this status.
    Quit(u8),
}

/// An evaluator: takes the texts of inputs and reports events.
pub trait Evaluate {
    /// Evaluates all forms of `text` in order, passing each event to `sink` as it happens.
    ///
    /// `source_name` is the file name used for places in the text.
    fn evaluate(&mut self, source_name: &str, text: &str, sink: &mut dyn FnMut(Event)) -> Outcome;

    /// Checks a text without running it; returns the mistakes in the order of the text.
    ///
    /// Definitions in the text are known afterwards, so that texts that build on one another
    /// can be checked in order.
    fn check(&mut self, source_name: &str, text: &str) -> Vec<Finding>;

    /// The name shown in the prompt: that of the current package, or a nickname.
    fn prompt(&self) -> String;

    /// While this is true, a running evaluation ends as soon as it can.
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

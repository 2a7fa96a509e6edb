//! Stopped evaluations, as data.

use std::ops::Range;

use super::choice::Choice;
use super::halt::halt_of;
use crate::dialogue::Abort;
use cram::TaskId;
use lisp::evaluator::aside::Aside;
use lisp::reader::Reader;
use lisp::source::Place;
use lisp::value::Value;
use view::watch::{Halt, HaltKind};

/// The stopped evaluations, innermost last, and what the next input is.
#[derive(Default)]
pub(crate) struct Console {
    pub is_interactive: bool,
    pub(super) levels: Vec<Level>,
    /// Number of levels that there have been.
    pub(super) opened: u64,
    /// The form at top level whose evaluation was stopped first.
    pub(super) base: Option<Suspended>,
    pub(super) asking: Asking,
    pub(super) draft: Option<String>,
    /// The form that was typed last while an evaluation was stopped.
    pub(super) typed: Option<String>,
    /// The value being inspected, last, after those through which it was reached.
    pub(super) inspected: Vec<Value>,
    /// The poll at which the next input is to be interrupted.
    pub(crate) interrupt_next: Option<u64>,
    /// How the last input ended.
    pub(crate) last_ending: String,
}

impl Console {
    /// Has nothing ever been stopped or asked?
    pub(crate) fn is_unused(&self) -> bool {
        !self.is_interactive
            && self.opened == 0
            && self.base.is_none()
            && self.draft.is_none()
            && self.typed.is_none()
            && self.inspected.is_empty()
            && self.interrupt_next.is_none()
    }
}

impl Console {
    pub(crate) fn level(&self) -> usize {
        self.levels.len()
    }

    /// The number for the next level.
    pub(super) fn next_number(&mut self) -> u64 {
        self.opened += 1;
        self.opened
    }

    /// Forgets everything that was stopped, without a word.
    pub(crate) fn give_up(&mut self) {
        *self = Console {
            is_interactive: self.is_interactive,
            opened: self.opened,
            ..Console::default()
        };
    }

    /// Why the evaluation does not go on, and the choices.
    pub(super) fn halt(&self) -> Option<Halt> {
        let level = self.levels.last()?;
        let kind = match level.cause {
            Cause::Condition(_) => HaltKind::Stopped,
            Cause::Interrupt => HaltKind::Interrupted,
        };
        Some(Halt {
            choices: level.labels(),
            level: self.levels.len(),
            ..halt_of(kind, &level.abort)
        })
    }

    pub(crate) fn take_draft(&mut self) -> Option<String> {
        self.draft.take()
    }

    /// The input that a second Ctrl-C stands for.
    pub(crate) fn answer_to_interrupt(&self) -> Option<&'static str> {
        match self.levels.last()?.cause {
            Cause::Interrupt => Some("abort"),
            Cause::Condition(_) => None,
        }
    }

    /// What the prompt shows after the package's name.
    pub(crate) fn prompt_suffix(&self) -> String {
        let level = match self.levels.last().map(|level| &level.cause) {
            None => String::new(),
            Some(Cause::Interrupt) => " stopped".to_owned(),
            Some(Cause::Condition(_)) => format!(" {}]", self.levels.len()),
        };
        let asking = match self.asking {
            Asking::Value(_) => " value",
            Asking::Form => " form",
            Asking::Nothing if !self.inspected.is_empty() => " inspect",
            Asking::Nothing => "",
        };
        level + asking
    }
}

/// How the next input is to be understood.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
pub(super) enum Asking {
    /// A command, or a form.
    #[default]
    Nothing,
    /// The value for a choice.
    Value(usize),
    /// The form to evaluate instead.
    Form,
}

/// A form whose evaluation is stopped, and the text that follows it.
pub(crate) struct Suspended {
    pub form: Value,
    pub place: Place,
    pub rest: Reader,
}

/// A stopped evaluation.
pub(super) struct Level {
    /// A number that no other level has had.
    pub(super) number: u64,
    pub(super) cause: Cause,
    pub(super) abort: Abort,
    pub(super) choices: Vec<(Choice, String)>,
    /// Those of the choices that the level below offers, too.
    pub(super) outer: Range<usize>,
    /// The text typed at the level below that has led here.
    pub(super) typed: Option<String>,
    /// The evaluation in progress on top of it.
    pub(super) aside: Option<Aside>,
    /// Index of the selected frame among those shown.
    pub(super) frame: usize,
    pub(super) task: Option<TaskId>,
}

impl Level {
    /// The choices as they are shown.
    pub(super) fn labels(&self) -> Vec<String> {
        match self.cause {
            Cause::Interrupt => ["Continue.", "Abort.", "Abort, and park the arms."]
                .map(str::to_owned)
                .to_vec(),
            Cause::Condition(_) => self
                .choices
                .iter()
                .map(|(_, label)| label.clone())
                .collect(),
        }
    }
}

/// Why an evaluation is stopped.
pub(super) enum Cause {
    Condition(Value),
    Interrupt,
}

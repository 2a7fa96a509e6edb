//! Stopped evaluations, and what the user may do with them: a debugger on top of the
//! suspended task, and the choice after an interrupt.
//!
//! All interaction consists of inputs and events, so that a session can be repeated from its
//! inputs alone. Without a user (`is_interactive` is false) nothing ever stops.

mod aside;
mod beside;
mod choices;
mod commands;
mod inspector;
mod replaced_frames;
mod robot_choices;
mod served;
mod settle;
mod shorthand;
mod stack_frames;

use std::ops::Range;

use super::dialogue::{Abort, Event, Outcome};
use cram::TaskId;
use lisp::evaluator::aside::Aside;
use lisp::reader::Reader;
use lisp::source::Place;
use lisp::value::Value;

use super::Session;
use super::halting::halt_of;
use choices::Choice;
use commands::Command;
use view::watch::{Halt, HaltKind};

/// The stopped evaluations, innermost last, and what the next input is.
#[derive(Default)]
pub(super) struct Console {
    pub is_interactive: bool,
    levels: Vec<Level>,
    /// Number of levels that there have been.
    opened: u64,
    /// The form at top level whose evaluation was stopped first.
    base: Option<Suspended>,
    asking: Asking,
    draft: Option<String>,
    /// The form that was typed last while an evaluation was stopped.
    typed: Option<String>,
    /// The value being inspected, last, after those through which it was reached.
    inspected: Vec<Value>,
    /// The poll at which the next input is to be interrupted.
    pub(crate) interrupt_next: Option<u64>,
}

impl Console {
    /// Has nothing ever been stopped or asked?
    pub(super) fn is_unused(&self) -> bool {
        !self.is_interactive
            && self.opened == 0
            && self.base.is_none()
            && self.draft.is_none()
            && self.typed.is_none()
            && self.inspected.is_empty()
            && self.interrupt_next.is_none()
    }
}

/// How the next input is to be understood.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
enum Asking {
    /// A command, or a form.
    #[default]
    Nothing,
    /// The value for a choice.
    Value(usize),
    /// The form to evaluate instead.
    Form,
}

/// A form whose evaluation is stopped, and the text that follows it.
pub(super) struct Suspended {
    pub form: Value,
    pub place: Place,
    pub rest: Reader,
}

/// A stopped evaluation.
struct Level {
    /// A number that no other level has had.
    number: u64,
    cause: Cause,
    abort: Abort,
    choices: Vec<(Choice, String)>,
    /// Those of the choices that the level below offers, too.
    outer: Range<usize>,
    /// The text typed at the level below that has led here.
    typed: Option<String>,
    /// The evaluation in progress on top of it.
    aside: Option<Aside>,
    /// Index of the selected frame among those shown.
    frame: usize,
    task: Option<TaskId>,
}

enum Cause {
    Condition(Value),
    Interrupt,
}

impl Level {
    /// The choices as they are shown.
    fn labels(&self) -> Vec<String> {
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

impl Console {
    pub(crate) fn level(&self) -> usize {
        self.levels.len()
    }

    /// The number for the next level.
    fn next_number(&mut self) -> u64 {
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

impl Session {
    /// Handles an input while an evaluation is stopped.
    pub(super) fn console_input(
        &mut self,
        source_name: &str,
        text: &str,
        sink: &mut dyn FnMut(Event),
    ) -> Outcome {
        match std::mem::take(&mut self.console.asking) {
            Asking::Nothing => {}
            Asking::Value(choice) => return self.choose(choice, source_name, text, sink),
            Asking::Form => return self.evaluate_instead(source_name, text, sink),
        }
        if self.console.answer_to_interrupt().is_some()
            && let Some(outcome) = self.after_interrupt(text, sink)
        {
            return outcome;
        }
        match Command::of(text) {
            Command::Evaluate(text) => {
                let whole = self.in_full(source_name, text);
                self.console.typed = Some(text.to_owned());
                self.evaluate_aside(source_name, whole.as_deref().unwrap_or(text), sink)
            }
            Command::Choose(number, "") => self.choose_or_ask(number, sink),
            Command::Choose(number, value) => self.choose(number, source_name, value, sink),
            Command::Abort => self.give_up(sink),
            Command::AbortLevel => self.leave_level(sink),
            Command::Continue => self.choose_by_name("CONTINUE", sink),
            Command::Backtrace(count) => self.tell_backtrace(count, sink),
            Command::Frame(number) => self.look_at_frame(Some(number), sink),
            Command::Up => self.look_at_next_frame(1, sink),
            Command::Down => self.look_at_next_frame(-1, sink),
            Command::Locals => self.tell_locals(sink),
            Command::Again => self.tell_stop(sink),
            Command::Choices => self.tell_all_choices(sink),
            Command::Tasks => self.tell_tasks(sink),
            Command::Retry => self.retry_form(sink, false),
            Command::Edit => self.edit_form(sink),
            Command::Return(form) => self.return_from_frame(source_name, form, sink),
            Command::Restart => self.restart_frame(sink),
            Command::Help => self.tell(commands::HELP, sink),
            Command::Wrong(message) => self.tell(message, sink),
        }
    }

    fn tell(&mut self, text: &str, sink: &mut dyn FnMut(Event)) -> Outcome {
        let text = text.trim_end();
        sink(Event::Output(format!("{text}\n")));
        Outcome::Finished
    }

    /// Abandons all levels and returns to the top level.
    fn give_up(&mut self, sink: &mut dyn FnMut(Event)) -> Outcome {
        let condition = self
            .console
            .levels
            .first()
            .map(|level| level.abort.condition.clone());
        self.clear_console(sink);
        sink(Event::Left(condition.unwrap_or_default()));
        self.image.output.begin_line();
        Outcome::Aborted
    }

    /// Ends the stopped evaluations, running cleanup code; returns the form at top level.
    fn clear_console(&mut self, sink: &mut dyn FnMut(Event)) -> Option<Suspended> {
        self.console.levels.clear();
        self.console.inspected.clear();
        self.console.asking = Asking::Nothing;
        self.abort(sink);
        self.flush(sink);
        let base = self.console.base.take();
        if let Some(base) = &base {
            self.shift_forms(&base.form);
        }
        base
    }

    /// Abandons the last level and returns to the one below.
    fn leave_level(&mut self, sink: &mut dyn FnMut(Event)) -> Outcome {
        let below = self.console.levels.iter().rev().nth(1);
        let task = self.console.levels.last().and_then(|level| level.task);
        let leave = below.filter(|level| level.task == task);
        let Some(aside) = leave.and_then(|level| level.aside.clone()) else {
            return self.give_up(sink);
        };
        self.console.levels.pop();
        let evaluation = self.go_on_with(sink, |scheduler, image, host| {
            scheduler.call(image, host, aside.leave(), Vec::new())
        });
        self.settle(evaluation, sink)
    }

    /// Handles an input that means something else after an interrupt than at a condition.
    fn after_interrupt(&mut self, text: &str, sink: &mut dyn FnMut(Event)) -> Option<Outcome> {
        let word = text.trim().to_lowercase();
        let outcome = match (word.trim_start_matches(':'), Command::of(text)) {
            ("0" | "c" | "continue", _) => {
                self.console.levels.pop();
                let evaluation =
                    self.go_on_with(sink, |scheduler, image, host| scheduler.go_on(image, host));
                self.settle(evaluation, sink)
            }
            ("1" | "abort", _) | (_, Command::Abort | Command::AbortLevel) => self.give_up(sink),
            ("2" | "p" | "park", _) => {
                self.give_up(sink);
                self.evaluate_text("park", PARK, sink)
            }
            ("tasks" | "(tasks)", _) => self.tell_tasks(sink),
            (_, Command::Choose(..)) => self.tell(
                "; Type 0 to continue, 1 to abort, or 2 to abort and park.",
                sink,
            ),
            (_, Command::Return(_)) => self.tell(
                "; After an interrupt, no value can be returned from a frame.",
                sink,
            ),
            (_, Command::Restart) => self.tell(
                "; After an interrupt, no frame can be restarted; choose 0 to continue.",
                sink,
            ),
            _ => return None,
        };
        Some(outcome)
    }

    fn tell_tasks(&mut self, sink: &mut dyn FnMut(Event)) -> Outcome {
        let text = self.scheduler.task_tree(&self.image);
        self.tell(&text, sink)
    }

    /// Evaluates the form again, optionally in the world in which it began.
    fn retry_form(&mut self, sink: &mut dyn FnMut(Event), takes_back: bool) -> Outcome {
        match self.clear_console(sink) {
            Some(base) => {
                if takes_back {
                    self.host
                        .person
                        .snapshots
                        .go_back_to_form(&mut self.host.simulation);
                }
                self.evaluate_first(base, sink)
            }
            None => Outcome::Aborted,
        }
    }

    /// Lets the user change what has led to this level and evaluate it again.
    fn edit_form(&mut self, sink: &mut dyn FnMut(Event)) -> Outcome {
        let typed = self
            .console
            .levels
            .last_mut()
            .and_then(|level| level.typed.take());
        if let Some(typed) = typed {
            let outcome = self.leave_level(&mut |event| {
                // The level below is known.
                if !matches!(event, Event::Stopped(_)) {
                    sink(event);
                }
            });
            self.console.draft = Some(typed);
            return outcome;
        }
        let base = self.console.base.as_ref();
        let text = base.and_then(|base| self.image.sources.text(base.place));
        self.console.draft = text.map(str::to_owned);
        self.console.asking = Asking::Form;
        Outcome::Finished
    }

    fn evaluate_instead(
        &mut self,
        source_name: &str,
        text: &str,
        sink: &mut dyn FnMut(Event),
    ) -> Outcome {
        if text.trim().is_empty() {
            return Outcome::Finished;
        }
        self.clear_console(sink);
        self.evaluate_text(source_name, text, sink)
    }
}

/// The form that parks the robot after an interrupt.
const PARK: &str = "(pr2-proj:with-simulated-robot (pp-plans::park-arms))";

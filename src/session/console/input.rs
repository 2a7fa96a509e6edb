//! Handling inputs while an evaluation is stopped.

use super::commands::{self, Command};
use super::evaluator::Evaluator;
use super::stopped::{Asking, Suspended};
use crate::dialogue::{Event, Outcome};

impl Evaluator {
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
                if let Some(local) = self.local_asked(text) {
                    return self.tell(&local, sink);
                }
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

    pub(super) fn tell(&mut self, text: &str, sink: &mut dyn FnMut(Event)) -> Outcome {
        let text = text.trim_end();
        sink(Event::Output(format!("{text}\n")));
        Outcome::Finished
    }

    /// Abandons all levels and returns to the top level.
    pub(super) fn give_up(&mut self, sink: &mut dyn FnMut(Event)) -> Outcome {
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
    pub(super) fn clear_console(&mut self, sink: &mut dyn FnMut(Event)) -> Option<Suspended> {
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
    pub(super) fn leave_level(&mut self, sink: &mut dyn FnMut(Event)) -> Outcome {
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
    pub(super) fn after_interrupt(
        &mut self,
        text: &str,
        sink: &mut dyn FnMut(Event),
    ) -> Option<Outcome> {
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

    pub(super) fn tell_tasks(&mut self, sink: &mut dyn FnMut(Event)) -> Outcome {
        let text = self.scheduler.task_tree(&self.image);
        self.tell(&text, sink)
    }

    /// Evaluates the form again, optionally in the world in which it began.
    pub(super) fn retry_form(&mut self, sink: &mut dyn FnMut(Event), takes_back: bool) -> Outcome {
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
    pub(super) fn edit_form(&mut self, sink: &mut dyn FnMut(Event)) -> Outcome {
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

    pub(super) fn evaluate_instead(
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

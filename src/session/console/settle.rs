//! Handling the result of an evaluation that was continued.

use std::ops::Range;

use super::choices;
use super::evaluator::{Evaluator, interrupted};
use super::stopped::{Asking, Cause, Level, Suspended};
use crate::dialogue::{Abort, Event, Outcome, Stop};
use crate::host::call::HostCall;
use crate::live_host::LiveHost;
use crate::printing;
use crate::printing::on_one_line;
use cram::builtins::combinators::NESTED;
use cram::{Evaluation, Scheduler};
use lisp::evaluator::aside::AsideState;
use lisp::image::Image;
use lisp::print;
use lisp::value::Value;

const DEBUGGER_REMARK: &str =
    "; Type a number, or a form to look around; q aborts, :bt shows the frames, :help the rest.";
const INTERRUPT_REMARK: &str =
    "; Type a number, or a form to look around (:bt, :locals); Ctrl-C aborts.";

impl Evaluator {
    /// Runs the scheduler.
    pub(super) fn go_on_with(
        &mut self,
        sink: &mut dyn FnMut(Event),
        how: impl FnOnce(&mut Scheduler<HostCall>, &mut Image, &mut LiveHost<'_>) -> Evaluation,
    ) -> Evaluation {
        let mut host = LiveHost::new(&mut self.host, sink, self.console.is_interactive);
        let evaluation = how(&mut self.scheduler, &mut self.image, &mut host);
        self.flush(sink);
        evaluation
    }

    /// Handles an evaluation that has stopped for the first time.
    pub(crate) fn open_level(
        &mut self,
        base: Suspended,
        evaluation: Evaluation,
        sink: &mut dyn FnMut(Event),
    ) -> Outcome {
        self.console.base = Some(base);
        self.settle(evaluation, sink)
    }

    /// Handles an evaluation that was continued from a level: it has ended, has returned to a
    /// level, or has stopped again.
    pub(super) fn settle(
        &mut self,
        evaluation: Evaluation,
        sink: &mut dyn FnMut(Event),
    ) -> Outcome {
        match evaluation {
            Evaluation::Values(values) => self.finish(values, sink),
            Evaluation::Unhandled(condition) => self.stopped_at(condition, sink),
            Evaluation::Interrupted => {
                self.console.inspected.clear();
                let number = self.console.next_number();
                self.console.levels.push(Level {
                    number,
                    cause: Cause::Interrupt,
                    abort: interrupted(),
                    choices: Vec::new(),
                    outer: 0..0,
                    typed: None,
                    aside: None,
                    frame: 0,
                    task: None,
                });
                self.tell_stop(sink)
            }
        }
    }

    /// The form at top level has finished; evaluates the forms after it.
    fn finish(&mut self, values: Vec<Value>, sink: &mut dyn FnMut(Event)) -> Outcome {
        self.console.levels.clear();
        self.console.asking = Asking::Nothing;
        let Some(base) = self.console.base.take() else {
            return Outcome::Finished;
        };
        self.shift_forms(&base.form);
        self.shift_values(&values);
        match self.tell_values(&values, sink) {
            Some(outcome) => outcome,
            None => self.evaluate_rest(base.rest, sink),
        }
    }

    fn stopped_at(&mut self, condition: Value, sink: &mut dyn FnMut(Event)) -> Outcome {
        let state_at = |level: &Level| level.aside.as_ref().map(|aside| aside.state());
        let states: Vec<Option<AsideState>> = self.console.levels.iter().map(state_at).collect();
        for (at, state) in states.into_iter().enumerate() {
            match state {
                None | Some(AsideState::Running) => {}
                Some(AsideState::Returned(values)) => {
                    self.come_back(at);
                    return self.tell_aside(&values, sink);
                }
                Some(AsideState::Ended) => {
                    self.come_back(at);
                    return self.tell_stop(sink);
                }
                Some(AsideState::Left) => {
                    self.console.levels.truncate(at);
                    break;
                }
            }
        }
        let task = self.scheduler.stopped_id();
        let known = self.console.levels.iter().position(|level| {
            level.task == task
                && level.aside.is_none()
                && matches!(&level.cause, Cause::Condition(c) if c.is_eq(&condition))
        });
        if let Some(at) = known {
            self.come_back(at);
            return self.tell_stop(sink);
        }
        self.console.inspected.clear();
        let typed = self
            .console
            .typed
            .take()
            .filter(|_| !self.console.levels.is_empty());
        let abort = self.described_in_place(&condition);
        let number = self.console.next_number();
        self.console.levels.push(Level {
            number,
            cause: Cause::Condition(condition),
            abort,
            choices: Vec::new(),
            outer: 0..0,
            typed,
            aside: None,
            frame: 0,
            task,
        });
        let choices = self.choices();
        if let [.., below, last] = self.console.levels.as_mut_slice() {
            last.outer = choices::shared(&choices, &below.choices);
        }
        if let Some(level) = self.console.levels.last_mut() {
            level.choices = choices;
        }
        self.tell_stop(sink)
    }

    fn come_back(&mut self, at: usize) {
        self.console.levels.truncate(at + 1);
        if let Some(level) = self.console.levels.last_mut() {
            level.aside = None;
        }
    }

    /// Reports the values of a form that was evaluated on top of a level.
    pub(super) fn tell_aside(&mut self, values: &[Value], sink: &mut dyn FnMut(Event)) -> Outcome {
        self.shift_values(values);
        self.tell_values(values, sink).unwrap_or(Outcome::Finished)
    }

    /// Reports where the evaluation is stopped, and the choices that only this level has.
    pub(super) fn tell_stop(&mut self, sink: &mut dyn FnMut(Event)) -> Outcome {
        let outer = self.console.levels.last().map(|level| level.outer.clone());
        self.tell_stop_without(outer.unwrap_or_default(), sink)
    }

    /// Reports where the evaluation is stopped, and all choices.
    pub(super) fn tell_all_choices(&mut self, sink: &mut dyn FnMut(Event)) -> Outcome {
        self.tell_stop_without(0..0, sink)
    }

    fn tell_stop_without(&mut self, folded: Range<usize>, sink: &mut dyn FnMut(Event)) -> Outcome {
        let level = self.console.levels.len();
        let Some(last) = self.console.levels.last() else {
            return Outcome::Finished;
        };
        let remark = match last.cause {
            Cause::Interrupt => INTERRUPT_REMARK,
            Cause::Condition(_) => DEBUGGER_REMARK,
        };
        let stop = Stop {
            level,
            abort: last.abort.clone(),
            choices: last.labels(),
            folded,
            remark,
        };
        sink(Event::Stopped(Box::new(stop)));
        self.image.output.begin_line();
        Outcome::Stopped
    }

    /// The report of a condition, with the actions of all tasks that wait for the one that
    /// stopped.
    fn described_in_place(&mut self, condition: &Value) -> Abort {
        let mut abort = printing::describe(&mut self.image, condition);
        if let (Some(base), true) = (&self.console.base, abort.report == NESTED) {
            let plan = on_one_line(&print::to_string(&self.image, &base.form, false));
            abort.hint = Some(format!(
                "{plan} stands still: q abandons it, a restart goes on with it."
            ));
        }
        let actions = self.open_actions();
        if !actions.is_empty() {
            abort.actions = actions;
        }
        abort
    }
}

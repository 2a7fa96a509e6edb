//! What an editor asks of stopped evaluations.

use super::choice::Choice;
use super::evaluator::Evaluator;
use super::stopped::Cause;
use crate::dialogue::{Need, StackFrame, Stop};
use lisp::print;
use lisp::value::Value;

impl Evaluator {
    /// The numbers of the levels, innermost last.
    pub(crate) fn level_numbers(&self) -> Vec<u64> {
        let levels = self.console.levels.iter();
        levels.map(|level| level.number).collect()
    }

    /// The last stop with all its choices.
    pub(crate) fn stop(&self) -> Option<Stop> {
        let last = self.console.levels.last()?;
        Some(Stop {
            level: self.console.levels.len(),
            abort: last.abort.clone(),
            choices: last.labels(),
            folded: 0..0,
            remark: "",
        })
    }

    /// What a choice at the last stop needs.
    pub(crate) fn need_of_choice(&self, number: usize) -> Need {
        let last = self.console.levels.last();
        let choice = last.and_then(|last| last.choices.get(number));
        match choice {
            Some((
                Choice::Restart {
                    takes_value: true, ..
                },
                _,
            )) => Need::Value,
            Some((Choice::EditForm, _)) => Need::Text,
            _ => Need::Nothing,
        }
    }

    /// The condition that opened the last level; none if an interrupt did.
    pub(crate) fn stopping_condition(&self) -> Option<Value> {
        match &self.console.levels.last()?.cause {
            Cause::Condition(condition) => Some(condition.clone()),
            Cause::Interrupt => None,
        }
    }

    /// The frames of the last stop.
    pub(crate) fn stack_frames(&self) -> Vec<StackFrame> {
        let frames = self.frames();
        let image = &self.image;
        let frame = |told: &super::stack_frames::Told| {
            let name = told.view.name.as_symbol();
            let home = name.and_then(|name| image.symbol(name).package);
            let package = home.unwrap_or_else(|| image.current_package());
            StackFrame {
                call: self.call_text(&told.view),
                package: image.packages.get(package).name.to_string(),
                place: image.sources.locate(told.view.place),
            }
        };
        frames.iter().map(frame).collect()
    }

    /// The names and values of the variables of a frame; those without a value left out.
    pub(crate) fn variables_of_frame(&self, number: usize) -> Vec<(String, Value)> {
        let frames = self.frames();
        let Some(told) = frames.get(number) else {
            return Vec::new();
        };
        let fibers = self.scheduler.stopped_fibers();
        let variables = fibers
            .get(told.link)
            .map(|fiber| fiber.variables(told.view.index));
        let variables = variables.unwrap_or_default().into_iter();
        let named = variables
            .filter(|variable| !variable.value.is_unbound())
            .map(|variable| {
                let name = print::to_string(&self.image, &variable.name.into(), true);
                (name, variable.value)
            });
        named.collect()
    }
}

//! Signalling conditions: handlers run on top of the stack of the signalling code.

use std::rc::Rc;

use super::call::Call;
use super::fiber::{Dynamic, Handler};
use super::machine::{Machine, Next};
use super::step::{Resume, Step};
use crate::lisp::condition;
use crate::lisp::source::Place;
use crate::lisp::value::Value;
use crate::lisp::value::raise::Raise;

/// What happens when every handler has declined.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Declined {
    /// `signal`: the call returns `NIL`.
    Return,
    /// `error`: the machine stops, with the stack as it is.
    Stop,
}

/// A signalling under way.
struct Signalling {
    condition: Value,
    declined: Declined,
    /// Entries at and above this index have been searched.
    position: usize,
    /// Handlers of the entry at `position` that have been tried, if it is being searched.
    tried: usize,
}

impl Machine<'_> {
    /// Turns a builtin's error into a condition and signals it as by `error`.
    pub(super) fn raise(&mut self, raise: Box<Raise>) -> Next {
        let place = raise.place();
        match condition::make(self.image, &raise) {
            Ok(condition) => {
                let place = if place.is_some() { place } else { self.place() };
                self.note_place(&condition, place);
                self.offer_restarts(&raise);
                match self.signal(condition, Declined::Stop) {
                    Ok(step) => self.take_step(step, false),
                    Err(raise) => self.raise_again(&raise),
                }
            }
            Err(raise) => self.raise_again(&raise),
        }
    }

    /// A condition could not be made or matched: the reason is the condition then.
    fn raise_again(&mut self, raise: &Raise) -> Next {
        let text = match raise {
            Raise::Make { report, .. } => report.clone(),
            Raise::Condition(_) => None,
        };
        let text = text.unwrap_or_else(|| "An error could not be described.".to_owned());
        Next::Stop(super::machine::Event::Unhandled(Value::string(text)))
    }

    /// Remembers where a condition was signalled, unless that is known.
    pub(crate) fn note_place(&mut self, condition: &Value, place: Place) {
        if place.is_some() && self.image.condition_calls(condition).is_none() {
            let mut calls = self.calls();
            if calls.iter().find(|c| c.place.is_some()).map(|c| c.place) != Some(place) {
                let subject = None;
                calls.insert(0, Call { place, subject });
            }
            self.image.set_condition_calls(condition, calls);
        }
    }

    /// The first step of signalling a condition.
    pub(crate) fn signal(
        &mut self,
        condition: Value,
        declined: Declined,
    ) -> Result<Step, Box<Raise>> {
        let position = self.fiber.dynamic.len();
        let signalling = Signalling {
            condition,
            declined,
            position,
            tried: 0,
        };
        Box::new(signalling).search(self)
    }
}

impl Signalling {
    fn search(mut self: Box<Self>, machine: &mut Machine<'_>) -> Result<Step, Box<Raise>> {
        loop {
            let handlers = if self.tried > 0 {
                match machine.fiber.dynamic.get(self.position) {
                    Some(Dynamic::Handlers(handlers)) => handlers.clone(),
                    _ => Rc::default(),
                }
            } else {
                let Some(position) = self.position.checked_sub(1) else {
                    return Ok(self.decline());
                };
                self.position = position;
                match machine.fiber.dynamic.get(position) {
                    Some(Dynamic::HandlerMask(below)) => {
                        self.position = *below;
                        continue;
                    }
                    Some(Dynamic::Handlers(handlers)) => handlers.clone(),
                    _ => continue,
                }
            };
            if let Some(function) = self.next_match(machine, &handlers)? {
                let args = vec![self.condition.clone()];
                machine
                    .fiber
                    .dynamic
                    .push(Dynamic::HandlerMask(self.position));
                return Ok(Step::Call {
                    function,
                    args,
                    then: self,
                });
            }
            self.tried = 0;
        }
    }

    fn next_match(
        &mut self,
        machine: &mut Machine<'_>,
        handlers: &[Handler],
    ) -> Result<Option<Value>, Box<Raise>> {
        while let Some(handler) = handlers.get(self.tried) {
            self.tried += 1;
            if condition::is_of_type(machine.image, &self.condition, &handler.condition_type)? {
                return Ok(Some(handler.function.clone()));
            }
        }
        Ok(None)
    }

    fn decline(self) -> Step {
        match self.declined {
            Declined::Return => Step::Return(Value::NIL),
            Declined::Stop => Step::Unhandled(self.condition),
        }
    }
}

impl Resume for Signalling {
    fn resume(self: Box<Self>, machine: &mut Machine<'_>, _: Value) -> Result<Step, Box<Raise>> {
        if matches!(machine.fiber.dynamic.last(), Some(Dynamic::HandlerMask(_))) {
            machine.fiber.dynamic.pop();
        }
        self.search(machine)
    }

    fn name(&self) -> &'static str {
        "SIGNAL"
    }
}

//! Signalling conditions: handlers run on top of the stack of the signalling code.

use std::rc::Rc;

use super::entry::Next;
use crate::condition;
use crate::image::open_call::OpenCall;
use crate::source::Place;
use crate::value::Value;
use crate::value::raise::{Raise, is_interrupt};
use crate::vm::computation::{Computation, Progress, compute};
use crate::vm::fiber::{Dynamic, Handler};
use crate::vm::machine::Machine;
use crate::vm::step::Step;

/// What happens when every handler has declined.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Declined {
    /// `signal`: the call returns `NIL`.
    Return,
    /// `error`: the machine stops, with the stack as it is.
    Stop,
}

impl Machine<'_> {
    /// Turns a builtin's error into a condition and signals it as by `error`.
    pub(super) fn raise(&mut self, raise: Box<Raise>) -> Next {
        let place = raise.place();
        match condition::make(self.image, &raise) {
            Ok(condition) if is_interrupt(&condition) => self.stop_interrupted(condition),
            Ok(condition) => {
                let place = if place.is_some() { place } else { self.place() };
                self.note_place(&condition, place);
                self.offer_restarts(&raise);
                match self.signal(condition, Declined::Stop) {
                    Ok(step) => self.take_step(step, false),
                    // A handler's predicate has failed. Its own and the inner handlers are masked,
                    // so this comes to an end.
                    Err(raise) => self.raise(raise),
                }
            }
            Err(raise) => self.raise_again(&raise),
        }
    }

    /// Stops, with the reason as the condition, because a condition could not be made.
    fn raise_again(&mut self, raise: &Raise) -> Next {
        let text = match raise {
            Raise::Make { report, .. } => report.clone(),
            Raise::Condition { .. } => None,
        };
        let text = text.unwrap_or_else(|| "An error could not be described.".to_owned());
        Next::Stop(crate::vm::machine::Event::Unhandled(Value::string(text)))
    }

    /// Remembers where a condition was signalled, unless that is already known.
    pub fn note_place(&mut self, condition: &Value, place: Place) {
        if place.is_some() && !self.image.knows_condition_calls(condition) {
            let mut calls = self.calls();
            if calls.iter().find(|c| c.place.is_some()).map(|c| c.place) != Some(place) {
                let subject = None;
                calls.insert(0, OpenCall { place, subject });
            }
            self.image.set_condition_calls(condition, calls);
        }
    }

    /// The first step of signalling a condition.
    pub fn signal(&mut self, condition: Value, declined: Declined) -> Result<Step, Box<Raise>> {
        let search = Search {
            condition,
            declined,
            position: self.fiber.dynamic.len(),
            tried: 0,
        };
        compute(self, "SIGNAL", search)
    }

    /// Drops the innermost dynamic entry if it masks handlers.
    pub(super) fn unmask_handlers(&mut self) {
        if matches!(self.fiber.dynamic.last(), Some(Dynamic::HandlerMask { .. })) {
            self.fiber.dynamic.pop();
        }
    }
}

/// The search for handlers of a condition, from the innermost outwards.
struct Search {
    condition: Value,
    declined: Declined,
    /// Entries at and above this index have been searched.
    position: usize,
    /// Handlers of the entry at `position` that have been tried, if it is being searched.
    tried: usize,
}

impl Computation for Search {
    type Output = Step;

    const NEEDS_FRAME: bool = true;

    fn advance(
        &mut self,
        machine: &mut Machine<'_>,
        answer: Option<Value>,
    ) -> Result<Progress<Step>, Box<Raise>> {
        if answer.is_some() {
            // A handler has declined.
            machine.unmask_handlers();
        }
        Ok(match self.next(machine)? {
            Some(function) => Progress::Call {
                function,
                args: vec![self.condition.clone()],
            },
            None => Progress::Done(self.declined.step(self.condition.clone())),
        })
    }
}

impl Search {
    /// The next handler whose type the condition matches. During its call, it and all handlers
    /// inside it are masked, as they are for the error of a predicate in a handler's type.
    fn next(&mut self, machine: &mut Machine<'_>) -> Result<Option<Value>, Box<Raise>> {
        loop {
            let handlers = if self.tried > 0 {
                match machine.fiber.dynamic.get(self.position) {
                    Some(Dynamic::Handlers(handlers)) => handlers.clone(),
                    _ => Rc::default(),
                }
            } else {
                let Some(position) = self.position.checked_sub(1) else {
                    return Ok(None);
                };
                self.position = position;
                match machine.fiber.dynamic.get(position) {
                    Some(Dynamic::HandlerMask { below, .. }) => {
                        self.position = *below;
                        continue;
                    }
                    Some(Dynamic::Handlers(handlers)) => handlers.clone(),
                    _ => continue,
                }
            };
            let found = self.next_match(machine, &handlers);
            if !matches!(found, Ok(None)) {
                machine.fiber.dynamic.push(Dynamic::HandlerMask {
                    below: self.position,
                    condition: self.condition.clone(),
                });
                return found;
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
            if crate::evaluator::matching::is_of_type(
                machine.image,
                &self.condition,
                &handler.condition_type,
            )? {
                return Ok(Some(handler.function.clone()));
            }
        }
        Ok(None)
    }
}

impl Declined {
    fn step(self, condition: Value) -> Step {
        match self {
            Declined::Return => Step::Return(Value::NIL),
            Declined::Stop => Step::Unhandled(condition),
        }
    }
}

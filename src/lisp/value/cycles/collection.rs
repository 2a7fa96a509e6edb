//! One collection: counting the references that objects have to each other, and freeing those that
//! have no others.
//!
//! Each step walks what can be reached from the suspects, in a loop: what it has to come back to is
//! all that it keeps; the rest is in the objects' marks.

use super::mark::State;
use super::references::{Objects, empty};
use super::suspect::Suspect;
use crate::guard;
use crate::value::Value;
use crate::value::symbol::SymbolTable;

/// Objects between two looks whether somebody wants to interrupt.
const PACE: usize = 1 << 14;

/// What a collection looks at.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Extent {
    /// What no earlier collection has found alive.
    Young,
    /// Everything.
    Full,
}

/// The collection was given up since somebody wants to interrupt the evaluation.
pub(super) struct Interrupted;

pub(super) struct Collection<'a> {
    extent: Extent,
    objects: Objects<'a>,
    /// The objects that were walked.
    walked: usize,
    /// What is still to be walked.
    stack: Vec<Value>,
    may_be_interrupted: bool,
}

impl<'a> Collection<'a> {
    /// A collection that has not begun. The symbols are those of the image that runs.
    pub(super) fn new(extent: Extent, symbols: Option<&'a mut SymbolTable>) -> Collection<'a> {
        Collection {
            extent,
            objects: Objects::new(symbols),
            walked: 0,
            stack: Vec::new(),
            may_be_interrupted: true,
        }
    }

    /// Lets nobody interrupt it.
    pub(super) fn uninterrupted(mut self) -> Collection<'a> {
        self.may_be_interrupted = false;
        self
    }

    /// Frees all circles among what can be reached from the suspects; returns how many objects that is.
    pub(super) fn run(mut self, suspects: &[Suspect]) -> Result<usize, Interrupted> {
        for (index, suspect) in suspects.iter().enumerate() {
            if let Some(object) = suspect.object()
                && self.count(object).is_err()
            {
                self.give_up(suspects.get(..=index).unwrap_or_default());
                return Err(Interrupted);
            }
        }
        // From here on, the time is about what the counting took.
        suspects.iter().for_each(|suspect| self.scan(suspect));
        suspects.iter().for_each(|suspect| self.free(suspect));
        Ok(self.walked)
    }

    /// Counts the references that an object and all that can be reached from it have to each other.
    fn count(&mut self, object: Value) -> Result<(), Interrupted> {
        let Collection {
            extent,
            objects,
            walked,
            stack,
            may_be_interrupted,
        } = self;
        let is_full = *extent == Extent::Full;
        match objects.mark(&object) {
            Some(mark) if mark.state() == State::Idle && (is_full || !mark.is_old()) => {
                mark.count_from_zero();
            }
            _ => return Ok(()),
        }
        stack.push(object);
        while let Some(object) = stack.pop() {
            *walked += 1;
            if *may_be_interrupted && walked.is_multiple_of(PACE) && guard::is_interrupted() {
                stack.push(object);
                return Err(Interrupted);
            }
            objects.for_each_reference(&object, &mut |held, mark| {
                if !is_full && mark.is_old() {
                    return;
                }
                if mark.state() == State::Idle {
                    mark.count_from_zero();
                    stack.push(held.clone());
                }
                mark.count();
            });
        }
        Ok(())
    }

    /// Finds out who of what was counted is held from outside, and what can be reached from there.
    fn scan(&mut self, suspect: &Suspect) {
        let Some(object) = suspect.object() else {
            return;
        };
        let Collection { objects, stack, .. } = self;
        match objects.mark(&object) {
            Some(mark) if mark.state() == State::Counted => mark.set_unheld(),
            _ => return,
        }
        stack.push(object);
        let mut alive = Vec::new();
        while let Some(object) = stack.pop() {
            let Some(mark) = objects.mark(&object) else {
                continue;
            };
            if mark.state() != State::Unheld {
                continue;
            }
            // One reference is the one here: an object is pushed only once in this state.
            let is_held = mark
                .found()
                .is_none_or(|found| objects.strong_count(&object) > found + 1);
            if !is_held {
                objects.for_each_reference(&object, &mut |held, mark| {
                    if mark.state() == State::Counted {
                        mark.set_unheld();
                        stack.push(held.clone());
                    }
                });
                continue;
            }
            mark.set_old();
            alive.push(object);
            while let Some(object) = alive.pop() {
                objects.for_each_reference(&object, &mut |held, mark| {
                    if mark.state() != State::Idle {
                        mark.set_old();
                        alive.push(held.clone());
                    }
                });
            }
        }
    }

    /// Takes apart what nobody holds.
    fn free(&mut self, suspect: &Suspect) {
        let Some(object) = suspect.object() else {
            return;
        };
        let Collection { objects, stack, .. } = self;
        match objects.mark(&object) {
            Some(mark) if mark.state() == State::Unheld => mark.reset(),
            _ => return,
        }
        stack.push(object);
        while let Some(object) = stack.pop() {
            objects.for_each_reference(&object, &mut |held, mark| {
                if mark.state() == State::Unheld {
                    mark.reset();
                    stack.push(held.clone());
                }
            });
            empty(objects, &object);
        }
    }

    /// Removes the marks of what was counted.
    fn give_up(&mut self, suspects: &[Suspect]) {
        let Collection { objects, stack, .. } = self;
        stack.clear();
        for object in suspects.iter().filter_map(Suspect::object) {
            match objects.mark(&object) {
                Some(mark) if mark.state() != State::Idle => mark.reset(),
                _ => continue,
            }
            stack.push(object);
            while let Some(object) = stack.pop() {
                objects.for_each_reference(&object, &mut |held, mark| {
                    if mark.state() != State::Idle {
                        mark.reset();
                        stack.push(held.clone());
                    }
                });
            }
        }
    }
}

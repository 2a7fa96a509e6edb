//! What ends Rust code that works long: an interrupt, a full heap, a stack that is used up.
//!
//! The machine looks for interrupts and at the heap between operations. Numbers, lists and texts
//! can be of any size, so a Rust function that walks one of them looks, too, with [`look`] or a
//! [`Pace`]. Where there is reason to stop, that function is left by unwinding, up to
//! [`stoppable`] around the machine; until then it has to change nothing that would be missed.
//! Every look at the interrupt flag is counted ([`polls`]), these as well.
//!
//! Rust functions that call themselves for the parts of a form call [`descend`] first.

pub mod heap;
pub mod polls;
pub(crate) mod reclaim;
mod stack;

use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::rc::Rc;
use std::sync::atomic::Ordering;

pub use heap::{Heap, MAX_ELEMENTS};
pub(crate) use heap::{note_exhausted, permit_length, reserve};
use polls::Polls;

pub(crate) use stack::descend;
pub use stack::{TooDeep, set_stack_budget};

thread_local! {
    /// What stops the evaluation that runs on this thread.
    static CURRENT: RefCell<Option<Rc<Limits>>> = const { RefCell::new(None) };
}

/// What stops the evaluations of one image.
#[derive(Default)]
pub struct Limits {
    /// The interrupt flag, with a count of looks at it.
    pub polls: Polls,
    /// The memory that may be in use.
    pub heap: Heap,
}

/// Why a Rust function was left.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Stopped {
    /// The interrupt flag was set; it is no longer.
    Interrupted,
    /// More memory is in use than may be.
    HeapExhausted,
    /// A sequence would have more than [`MAX_ELEMENTS`].
    TooLong,
}

/// Puts limits in force on this thread until it is dropped.
pub struct Watch(Option<Rc<Limits>>);

impl Limits {
    /// The same limit to the memory, and an interrupt flag of its own.
    pub fn copied(&self) -> Limits {
        let limits = Limits::default();
        limits.heap.set_limit(self.heap.limit());
        limits
    }

    /// Puts the limits in force on this thread.
    pub fn watch(self: &Rc<Self>) -> Watch {
        Watch(CURRENT.replace(Some(Rc::clone(self))))
    }

    /// Is there a reason to stop?
    pub fn reason(&self) -> Option<Stopped> {
        if self.polls.take() {
            return Some(Stopped::Interrupted);
        }
        self.heap.is_exhausted().then_some(Stopped::HeapExhausted)
    }

    /// The same for work that soon ends in most cases, such as compiling a form: for a while an
    /// interrupt is put off, since the form can be continued once it runs.
    pub fn patient_reason(&self) -> Option<Stopped> {
        self.reason()
            .filter(|reason| *reason != Stopped::Interrupted || !self.polls.put_off())
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        // At the end of the thread nothing is in force.
        let _ = CURRENT.try_with(|limits| limits.replace(self.0.take()));
    }
}

/// Why what runs on this thread is to stop, if it is.
pub fn reason() -> Option<Stopped> {
    in_force()?.reason()
}

/// The same for work that soon ends in most cases ([`Limits::patient_reason`]).
pub(crate) fn patient_reason() -> Option<Stopped> {
    in_force()?.patient_reason()
}

/// The limits in force on this thread, after memory that is overdue has been given back.
fn in_force() -> Option<Rc<Limits>> {
    // At the end of the thread, when values may still be dropped, nothing is in force.
    let limits = CURRENT.try_with(|limits| limits.borrow().clone());
    let limits = limits.ok().flatten()?;
    reclaim::if_overdue(limits.heap.in_use());
    Some(limits)
}

/// Does somebody want to interrupt what runs on this thread? This is no poll of the flag that counts.
pub(crate) fn is_interrupted() -> bool {
    let is_set = |limits: &Limits| limits.polls.flag().load(Ordering::Relaxed);
    let is_set = CURRENT.try_with(|limits| limits.borrow().as_deref().is_some_and(is_set));
    is_set.unwrap_or(false)
}

/// The bytes in use, if that is known.
pub(crate) fn memory_in_use() -> Option<usize> {
    let in_use = CURRENT.try_with(|limits| limits.borrow().as_ref()?.heap.in_use());
    in_use.ok().flatten()
}

/// Leaves the calling function by unwinding if there is a reason to stop.
pub fn look() {
    if let Some(reason) = reason() {
        leave(reason);
    }
}

/// The same for work that soon ends in most cases ([`Limits::patient_reason`]).
pub(crate) fn look_patiently() {
    if let Some(reason) = patient_reason() {
        leave(reason);
    }
}

/// Leaves the calling function by unwinding.
pub fn leave(reason: Stopped) -> ! {
    resume_unwind(Box::new(reason))
}

/// Runs something that may be left by unwinding.
pub fn stoppable<T>(work: impl FnOnce() -> T) -> Result<T, Stopped> {
    stoppable_on(&mut (), |()| work(), |()| {})
}

/// Like [`stoppable`], for work on a state; `clean_up` is called if a panic comes through.
pub(crate) fn stoppable_on<S, T>(
    state: &mut S,
    work: impl FnOnce(&mut S) -> T,
    clean_up: impl FnOnce(&mut S),
) -> Result<T, Stopped> {
    catch_unwind(AssertUnwindSafe(|| work(state))).map_err(|payload| match payload.downcast() {
        Ok(reason) => *reason,
        Err(payload) => {
            clean_up(state);
            resume_unwind(payload)
        }
    })
}

/// Counts the steps of a walk, and looks once in a while.
#[derive(Default)]
pub struct Pace(usize);

/// Short steps between two looks: about a tenth of a millisecond.
pub const STEPS: usize = 4096;

impl Pace {
    /// To be called for each step.
    #[inline]
    pub fn step(&mut self) {
        if self.is_due() {
            look();
        }
    }

    /// Counts a step; is it time to look?
    #[inline]
    pub fn is_due(&mut self) -> bool {
        self.0 += 1;
        if self.0 == STEPS {
            self.0 = 0;
        }
        self.0 == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::Ordering;

    #[test]
    fn a_walk_without_end_is_left_once_the_flag_is_set() {
        let limits = Rc::new(Limits::default());
        let _watch = limits.watch();
        let mut steps = 0;
        let outcome = stoppable(|| {
            let mut pace = Pace::default();
            loop {
                pace.step();
                steps += 1;
                if steps == 10_000 {
                    limits.polls.flag().store(true, Ordering::Relaxed);
                }
            }
        });
        assert_eq!(outcome.map(|(): ()| ()), Err(Stopped::Interrupted));
        assert_eq!(steps, 3 * STEPS - 1);
        assert!(!limits.polls.flag().load(Ordering::Relaxed));
    }

    #[test]
    fn where_nobody_watches_nothing_stops() {
        assert_eq!(stoppable(|| (look(), 1).1), Ok(1));
    }
}

//! Abandoning the planning of a motion half-way when the user interrupts it.
//!
//! A search for a path may take seconds. Searches test the interrupt flag between two
//! configuration checks and, if it is set, leave the whole tick by unwinding. The caller of
//! the tick then restores the copy of the motion that it took before
//! ([`crate::motion::Motion::before_planning`]), so that nothing has happened. Until a search ends,
//! a tick changes nothing but its motion.

use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// What ends a search, and what it does meanwhile.
#[derive(Clone, Debug, Default)]
pub struct Interruption {
    /// Ends the search when it is set.
    pub flag: Arc<AtomicBool>,
    /// Called wherever a search looks at the flag: a program that has only one thread can do something
    /// else there.
    pub breathe: Option<fn()>,
}

thread_local! {
    /// What ends this thread's searches, while they may be interrupted.
    static CURRENT: RefCell<Option<Interruption>> = const { RefCell::new(None) };
}

/// The payload of the unwinding.
struct GivenUp;

/// Runs something that a search may abandon; returns `None` if one did.
pub fn interruptible<T>(interruption: Interruption, work: impl FnOnce() -> T) -> Option<T> {
    CURRENT.set(Some(interruption));
    let done = catch_unwind(AssertUnwindSafe(work));
    CURRENT.set(None);
    match done {
        Ok(value) => Some(value),
        Err(payload) if payload.is::<GivenUp>() => None,
        Err(payload) => resume_unwind(payload),
    }
}

/// Ends the calling search if an interrupt is pending.
pub fn look() {
    let breathe = CURRENT.with_borrow(|current| current.as_ref().and_then(|c| c.breathe));
    if let Some(breathe) = breathe {
        breathe();
    }
    let is_wanted = CURRENT.with_borrow(|current| {
        let current = current.as_ref();
        current.is_some_and(|current| current.flag.load(Ordering::Relaxed))
    });
    if is_wanted {
        resume_unwind(Box::new(GivenUp));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::AtomicUsize;

    static BREATHS: AtomicUsize = AtomicUsize::new(0);

    #[test]
    fn work_ends_where_it_looks_once_the_flag_is_set() {
        let interruption = Interruption {
            breathe: Some(|| {
                BREATHS.fetch_add(1, Ordering::Relaxed);
            }),
            ..Interruption::default()
        };
        let run = |work: &dyn Fn() -> i32| interruptible(interruption.clone(), work);
        assert_eq!(run(&|| (look(), 1).1), Some(1));
        let steps = AtomicUsize::new(0);
        let done = run(&|| {
            steps.fetch_add(1, Ordering::Relaxed);
            interruption.flag.store(true, Ordering::Relaxed);
            look();
            steps.fetch_add(1, Ordering::Relaxed);
            1
        });
        assert_eq!((done, steps.into_inner()), (None, 1));
        assert_eq!(BREATHS.load(Ordering::Relaxed), 2);
        // Outside, no search is ended, and none breathes.
        look();
        assert_eq!(BREATHS.load(Ordering::Relaxed), 2);
    }
}

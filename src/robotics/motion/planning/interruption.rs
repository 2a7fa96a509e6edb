//! Abandoning the planning of a motion half-way when the user interrupts it.
//!
//! A search for a path may take seconds. Searches test the interrupt flag between two
//! configuration checks and, if it is set, leave the whole tick by unwinding. The caller of
//! the tick then restores the copy of the motion that it took before
//! ([`crate::motion::Motion::before_planning`]), so that nothing has happened. Until a search ends,
//! a tick changes nothing but its motion.

use std::cell::{Cell, RefCell};
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

thread_local! {
    /// The flag that ends this thread's searches, while they may be interrupted.
    static FLAG: RefCell<Option<Arc<AtomicBool>>> = const { RefCell::new(None) };
    /// Called wherever a search looks at the flag.
    static BREATHE: Cell<Option<fn()>> = const { Cell::new(None) };
}

/// Sets what searches of this thread call again and again, so that a program that has only one thread
/// can do something else meanwhile.
pub fn set_breathe(breathe: Option<fn()>) {
    BREATHE.set(breathe);
}

/// The payload of the unwinding.
struct GivenUp;

/// Runs something that a search may abandon; returns `None` if one did.
pub fn interruptible<T>(flag: &Arc<AtomicBool>, work: impl FnOnce() -> T) -> Option<T> {
    FLAG.set(Some(Arc::clone(flag)));
    let done = catch_unwind(AssertUnwindSafe(work));
    FLAG.set(None);
    match done {
        Ok(value) => Some(value),
        Err(payload) if payload.is::<GivenUp>() => None,
        Err(payload) => resume_unwind(payload),
    }
}

/// Ends the calling search if an interrupt is pending.
pub fn look() {
    if let Some(breathe) = BREATHE.get() {
        breathe();
    }
    let is_wanted = FLAG.with_borrow(|flag| {
        flag.as_ref()
            .is_some_and(|flag| flag.load(Ordering::Relaxed))
    });
    if is_wanted {
        resume_unwind(Box::new(GivenUp));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_ends_where_it_looks_once_the_flag_is_set() {
        let flag = Arc::new(AtomicBool::new(false));
        assert_eq!(interruptible(&flag, || (look(), 1).1), Some(1));
        let mut steps = 0;
        let done = interruptible(&flag, || {
            steps += 1;
            flag.store(true, Ordering::Relaxed);
            look();
            steps += 1;
        });
        assert_eq!((done, steps), (None, 1));
        // Outside, no search is ended.
        look();
    }
}

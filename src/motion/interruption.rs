//! Giving up the planning of a motion half-way, because a person wants the robot to stop.
//!
//! A search for a path may take seconds. Searches look at the interrupt flag between two
//! checks of a configuration and, when it is set, leave the whole tick by unwinding. Whoever
//! ticks the motion puts back the copy that it took before ([`super::Motion::before_planning`]),
//! and so nothing has happened. Until a search ends, a tick changes nothing but its motion.

use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

thread_local! {
    /// The flag that ends the searches of this thread, while they may be given up.
    static FLAG: RefCell<Option<Arc<AtomicBool>>> = const { RefCell::new(None) };
}

/// What unwinds.
struct GivenUp;

/// Does something that searches may end early; none if one did.
pub(crate) fn interruptible<T>(flag: &Arc<AtomicBool>, work: impl FnOnce() -> T) -> Option<T> {
    FLAG.set(Some(Arc::clone(flag)));
    let done = catch_unwind(AssertUnwindSafe(work));
    FLAG.set(None);
    match done {
        Ok(value) => Some(value),
        Err(payload) if payload.is::<GivenUp>() => None,
        Err(payload) => resume_unwind(payload),
    }
}

/// Ends the search that calls it, if that is wanted.
pub(super) fn look() {
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
        // Outside nothing ends.
        look();
    }
}

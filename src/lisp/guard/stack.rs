//! The Rust stack of functions that call themselves for the parts of a form.

use std::cell::Cell;

/// Bytes that such functions may use unless told otherwise: a test's thread has two megabytes.
const BUDGET: usize = 1 << 20;

thread_local! {
    /// The highest address at which somebody has asked on this thread: the stack grows downwards.
    static TOP: Cell<usize> = const { Cell::new(0) };
    static BUDGET_HERE: Cell<usize> = const { Cell::new(BUDGET) };
}

/// The stack is used up.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct TooDeep;

/// Sets how many bytes of this thread's stack may be used.
pub fn set_stack_budget(bytes: usize) {
    BUDGET_HERE.set(bytes);
}

/// An error if the stack is used up. To be called by every Rust function that calls itself for
/// the parts of a form, which may be of any depth, and even circular.
pub(crate) fn descend() -> Result<(), TooDeep> {
    let marker = 0_u8;
    let here = std::ptr::from_ref(&marker).addr();
    let top = TOP.get().max(here);
    TOP.set(top);
    if top - here > BUDGET_HERE.get() {
        Err(TooDeep)
    } else {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dig(depth: usize) -> Result<usize, TooDeep> {
        let frame = std::hint::black_box([depth; 8]);
        descend()?;
        let below = dig(depth + 1);
        // The call is not the last thing that happens, so that it needs a frame.
        std::hint::black_box(&frame);
        below
    }

    #[test]
    fn a_recursion_without_end_is_an_error() {
        assert_eq!(dig(0), Err(TooDeep));
        assert_eq!(descend(), Ok(()));
    }
}

//! The calls of a fiber that have not returned.
//!
//! The places beyond the depth are kept for the next calls, which only store into them what they are.

use std::cell::Cell;
use std::mem::{forget, replace, take};
use std::ops::Deref;
use std::rc::Rc;

use super::calls::Suspended;
use crate::value::function::Function;

/// A call that has not returned.
#[derive(Default)]
pub struct Frame {
    /// What continues when a callee returns.
    pub kind: FrameKind,
    /// Where the frame's values start on the stack.
    pub base: usize,
    /// Length to which its return cuts the stack.
    pub cut: usize,
    /// Number of dynamic entries when it was entered.
    pub dynamic: usize,
    /// Does the caller want all values?
    pub(crate) multi: bool,
}

/// What runs in a frame.
#[derive(Default)]
pub enum FrameKind {
    /// Compiled code.
    Code {
        /// The closure that was called.
        function: Rc<Function>,
        /// The next operation. The code that runs sets it before anything else could ask for it.
        pc: Cell<usize>,
    },
    /// A builtin that is waiting for a value.
    Native {
        /// The rest of the builtin.
        then: Box<Suspended>,
        /// Does it want all values?
        all: bool,
    },
    /// Nothing: it has returned.
    #[default]
    Over,
}

impl Frame {
    /// Is there compiled code in it?
    #[inline(always)]
    pub(crate) fn is_of_code(&self) -> bool {
        matches!(self.kind, FrameKind::Code { .. })
    }
}

/// Calls, innermost last; as a slice, those that have not returned.
#[derive(Default)]
pub struct Frames {
    /// Beyond the depth, frames that are over.
    places: Vec<Frame>,
    depth: usize,
}

/// Places that there are at least, once there is a call.
const FEWEST: usize = 16;

impl Frames {
    /// How many frames it has places for.
    pub(crate) fn room(&self) -> usize {
        self.places.len()
    }

    /// Makes a frame the innermost one.
    pub fn push(&mut self, frame: Frame) {
        *self.next() = frame;
    }

    /// Enters a function whose slots are filled from `base` on.
    #[inline(always)]
    pub fn enter(
        &mut self,
        function: Rc<Function>,
        base: usize,
        cut: usize,
        dynamic: usize,
        multi: bool,
    ) {
        let frame = self.next();
        let pc = Cell::new(0);
        // What is over needs not be freed.
        forget(replace(&mut frame.kind, FrameKind::Code { function, pc }));
        frame.base = base;
        frame.cut = cut;
        frame.dynamic = dynamic;
        frame.multi = multi;
    }

    /// The place of the next frame, which is the innermost one from now on.
    #[inline(always)]
    fn next(&mut self) -> &mut Frame {
        if self.depth >= self.places.len() {
            self.grow();
        }
        let frame = &mut self.places[self.depth];
        self.depth += 1;
        frame
    }

    #[cold]
    #[inline(never)]
    fn grow(&mut self) {
        let count = FEWEST.max(2 * self.places.len());
        self.places.resize_with(count, Frame::default);
    }

    /// Ends the innermost frame, if it is one of code.
    #[inline(always)]
    pub fn leave(&mut self) {
        if let [.., frame] = &mut self.places[..self.depth]
            && frame.is_of_code()
        {
            self.depth -= 1;
            match take(&mut frame.kind) {
                FrameKind::Code { function, .. } => drop(function),
                // Were it dropped, all of it would have to be put together in memory.
                other => forget(other),
            }
        }
    }

    /// Takes out the innermost frame.
    pub fn pop(&mut self) -> Option<Frame> {
        self.depth = self.depth.checked_sub(1)?;
        self.places.get_mut(self.depth).map(take)
    }

    /// Ends the innermost frames, down to so many.
    pub fn truncate(&mut self, depth: usize) {
        while self.depth > depth {
            self.depth -= 1;
            match take(&mut self.places[self.depth].kind) {
                FrameKind::Code { function, .. } => drop(function),
                other => drop(other),
            }
        }
    }

    /// Takes out the innermost frames, down to so many.
    pub fn split_off(&mut self, depth: usize) -> Vec<Frame> {
        let above = self.places[depth..self.depth].iter_mut();
        let above = above.map(take).collect();
        self.depth = depth;
        above
    }
}

impl Deref for Frames {
    type Target = [Frame];

    #[inline(always)]
    fn deref(&self) -> &[Frame] {
        &self.places[..self.depth]
    }
}

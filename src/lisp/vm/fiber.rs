//! One line of execution: its value stack, its frames and its dynamic entries.

use std::rc::Rc;

use super::frames::Frames;
use super::stack::Stack;
use crate::image::Image;
use crate::value::Value;
use crate::value::release::put_off_others;
use crate::value::symbol::Sym;

/// A handler: a type of conditions and a function.
pub struct Handler {
    /// The type specifier.
    pub condition_type: Value,
    /// The function of one argument.
    pub function: Value,
}

/// Something with dynamic extent.
pub enum Dynamic {
    /// A binding of a special variable, with the value outside it.
    Bind(Sym, Value),
    /// The start of the bindings of a `progv`.
    ProgvMark,
    /// A block that closures may leave.
    Block {
        /// Its identity.
        id: i64,
        /// Its frame's index.
        frame: usize,
        /// Height of the stack outside it.
        height: usize,
        /// Where the code continues.
        target: u32,
        /// Does its context want all values?
        multi: bool,
    },
    /// A tagbody that closures may jump into.
    Tagbody {
        /// Its identity.
        id: i64,
        /// Its frame's index.
        frame: usize,
        /// Height of the stack inside it.
        height: usize,
        /// The number of its tag table in the code.
        table: u32,
    },
    /// A catch.
    Catch {
        tag: Value,
        /// Its frame's index.
        frame: usize,
        /// Height of the stack outside it.
        height: usize,
        /// Where the code continues.
        target: u32,
        /// Does its context want all values?
        multi: bool,
    },
    /// Code that is protected by cleanup code.
    Unwind {
        /// Its frame's index.
        frame: usize,
        /// Height of the stack outside it.
        height: usize,
        /// Where the cleanup code starts.
        target: u32,
    },
    /// Handlers.
    Handlers(Rc<[Handler]>),
    /// While a handler runs.
    HandlerMask {
        /// Only entries below this index are searched for handlers.
        below: usize,
        /// The condition that it handles.
        condition: Value,
    },
    /// Restarts: a list of restart objects.
    Restarts(Value),
}

/// The destination of an unwinding.
#[derive(Clone, Copy, Debug)]
pub enum Target {
    /// Out of the block or catch at this dynamic index.
    Exit(usize),
    /// To a tag of the tagbody at this dynamic index.
    Tag(usize, u32),
    /// Out of the frame with this index. The value, a list of a function and its arguments, is then
    /// called in place of the frame.
    Frame(usize),
    /// Out of everything.
    Everything,
}

/// An unwinding that waits for cleanup code to finish.
pub struct Pending {
    pub target: Target,
    /// The value it carries.
    pub value: Value,
    /// Number of dynamic entries while the cleanup code runs.
    pub dynamic: usize,
    /// The condition whose handler has begun it, if one has.
    pub cause: Option<Value>,
}

/// A line of execution.
#[derive(Default)]
pub struct Fiber {
    /// The value stack.
    pub stack: Stack,
    /// The frames, innermost last.
    pub frames: Frames,
    /// The dynamic entries, innermost last.
    pub dynamic: Vec<Dynamic>,
    /// Unwindings that wait for cleanup code to finish, innermost last.
    pub pending: Vec<Pending>,
    /// Does the pending request want all values of the answer?
    pub(crate) wants_all: bool,
    /// A value that was on its way to the innermost frame when an interrupt came.
    pub(crate) undelivered: Option<Value>,
    /// Are the fiber's bindings of special variables in force?
    in_force: bool,
}

/// Frames that are cut off at once; more than these are freed later, a part at a time.
const CUT_AT_ONCE: usize = 1000;

/// Places of stack and frames up to which it pays to use a fiber again.
const MAX_PLACES: usize = 256;

impl Fiber {
    /// The fiber for another call, if what it has run is over and it has not become large.
    pub fn idle(mut self) -> Option<Fiber> {
        let is_over = self.stack.is_empty()
            && self.frames.is_empty()
            && self.dynamic.is_empty()
            && self.pending.is_empty()
            && self.undelivered.is_none();
        let is_small = self.stack.room() <= MAX_PLACES && self.frames.room() <= MAX_PLACES;
        self.wants_all = false;
        self.in_force = false;
        (is_over && is_small).then_some(self)
    }

    /// Drops the innermost frames, down to so many.
    pub(crate) fn cut_frames(&mut self, count: usize) {
        while self.frames.len() > count + CUT_AT_ONCE {
            let rest = self.frames.len() - CUT_AT_ONCE;
            put_off_others(self.frames.split_off(rest), CUT_AT_ONCE);
        }
        self.frames.truncate(count);
    }

    /// Puts the fiber's special bindings in force: it is about to run.
    pub fn enter(&mut self, image: &mut Image) {
        if self.in_force {
            return;
        }
        self.in_force = true;
        for entry in &mut self.dynamic {
            swap_binding(image, entry);
        }
    }

    /// Takes the fiber's special bindings out of force: another fiber may run.
    pub fn leave(&mut self, image: &mut Image) {
        if !self.in_force {
            return;
        }
        self.in_force = false;
        for entry in self.dynamic.iter_mut().rev() {
            swap_binding(image, entry);
        }
    }

    /// Binds a special variable for the rest of the fiber's life; to be called before it first
    /// runs.
    pub fn bind(&mut self, sym: Sym, value: Value) {
        self.dynamic.push(Dynamic::Bind(sym, value));
    }
}

impl Drop for Fiber {
    fn drop(&mut self) {
        self.cut_frames(0);
    }
}

fn swap_binding(image: &mut Image, entry: &mut Dynamic) {
    if let Dynamic::Bind(sym, other) = entry {
        std::mem::swap(&mut image.symbols.get_mut(*sym).value, other);
    }
}

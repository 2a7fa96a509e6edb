//! How much memory may be in use.

use std::cell::Cell;

use super::{CURRENT, Stopped, leave, look, reclaim};

/// A limit to the memory in use.
#[derive(Default)]
pub struct Heap {
    limit: Cell<Option<HeapLimit>>,
    /// Has the limit been put up since it was reached?
    is_extended: Cell<bool>,
    /// Has a program been told that memory is exhausted?
    was_exhausted: Cell<bool>,
}

/// A limit to the memory in use, and how to learn how much is.
#[derive(Clone, Copy, Debug)]
pub struct HeapLimit {
    /// Bytes that may be in use.
    pub bytes: usize,
    /// The bytes in use, as the program's allocator counts them.
    pub in_use: fn() -> usize,
}

/// What part of the limit has to be free after a collection.
const MIN_ROOM: usize = 32;

/// By what part of the limit it is put up once it has been reached: for handlers, and for people
/// who look around and let go of what they do not need. It is put up only once.
const EXTENSION: usize = 16;

impl Heap {
    /// Sets the limit.
    pub fn set_limit(&self, limit: Option<HeapLimit>) {
        self.limit.set(limit);
        self.is_extended.set(false);
    }

    /// The limit.
    pub(super) fn limit(&self) -> Option<HeapLimit> {
        self.limit.get()
    }

    /// Whether a program has been told that memory is exhausted since this was last asked. What it
    /// has done after that depends on the limit, whether it has handled the condition or not.
    pub fn take_exhausted(&self) -> bool {
        self.was_exhausted.take()
    }

    /// Is more in use than may be? Says so once, and every time when a sixteenth more is in use.
    pub(super) fn is_exhausted(&self) -> bool {
        self.would_exhaust(0)
    }

    /// Whether so many bytes more would exceed the limit. Unlike [`Heap::would_exhaust`], this says
    /// so every time: for what multiplies, each of which would otherwise take its share of the
    /// extensions.
    pub fn lacks_room_for(&self, more: usize) -> bool {
        let limit = self.limit.get();
        limit.is_some_and(|limit| (limit.in_use)().saturating_add(more) >= limit.bytes)
    }

    /// The bytes in use, if that is known.
    pub(crate) fn in_use(&self) -> Option<usize> {
        self.limit.get().map(|limit| (limit.in_use)())
    }

    /// Is so much free that it is worth going on? A collection for each few bytes would take most of the
    /// time.
    pub(crate) fn has_room(&self) -> bool {
        let least = self.limit.get().map_or(0, |limit| limit.bytes / MIN_ROOM);
        !self.lacks_room_for(least)
    }

    /// Would so many bytes more be too many, even if everything is freed that can be?
    pub(crate) fn would_exhaust(&self, more: usize) -> bool {
        let Some(limit) = self.limit.get() else {
            return false;
        };
        if !self.exceeds(&limit, more) {
            return false;
        }
        reclaim::all();
        if self.has_room() && !self.exceeds(&limit, more) {
            return false;
        }
        if (limit.in_use)() >= limit.bytes {
            self.is_extended.set(true);
        }
        true
    }

    fn exceeds(&self, limit: &HeapLimit, more: usize) -> bool {
        let in_use = (limit.in_use)();
        if in_use < limit.bytes {
            self.is_extended.set(false);
        }
        let extension = match self.is_extended.get() {
            true => limit.bytes / EXTENSION,
            false => 0,
        };
        in_use.saturating_add(more) >= limit.bytes.saturating_add(extension)
    }
}

/// Notes that the program that runs on this thread is told that memory is exhausted.
pub(crate) fn note_exhausted() {
    CURRENT.with_borrow(|limits| {
        if let Some(limits) = limits {
            limits.heap.was_exhausted.set(true);
        }
    });
}

/// The most elements that a sequence may have, so that nothing that is done with a sequence takes
/// longer than people wait for Ctrl-C.
pub const MAX_ELEMENTS: usize = 1 << 25;

/// Bytes from which on an allocation is worth a look: to fill them takes longer than that.
const LARGE: usize = 1 << 16;

/// Leaves the calling function by unwinding if a sequence may not have so many elements.
pub(crate) fn permit_length(elements: usize) {
    if elements > MAX_ELEMENTS && CURRENT.with_borrow(Option::is_some) {
        leave(Stopped::TooLong);
    }
}

/// Leaves the calling function by unwinding if there is no room for so many bytes more, or if there
/// is another reason to stop and they are many. To be called before a single allocation whose size
/// a program decides.
pub(crate) fn reserve(bytes: usize) {
    if bytes > LARGE {
        look();
    }
    let is_too_much =
        CURRENT.with_borrow(|limits| limits.as_ref().is_some_and(|l| l.heap.would_exhaust(bytes)));
    if is_too_much {
        leave(Stopped::HeapExhausted);
    }
}

//! How much memory may be in use.

use std::cell::Cell;

use super::{CURRENT, Stopped, leave, look};

/// A limit to the memory in use.
#[derive(Default)]
pub struct Heap {
    limit: Cell<Option<HeapLimit>>,
    /// How often the limit has been put up since more than the limit is in use.
    extensions: Cell<usize>,
}

/// A limit to the memory in use, and how to learn how much is.
#[derive(Clone, Copy, Debug)]
pub struct HeapLimit {
    /// Bytes that may be in use.
    pub bytes: usize,
    /// The bytes in use, as the program's allocator counts them.
    pub in_use: fn() -> usize,
}

/// By what part of the limit it is put up once it has been reached: for handlers, and for people
/// who look around and let go of what they do not need.
const EXTENSION: usize = 16;

impl Heap {
    /// Sets the limit.
    pub fn set_limit(&self, limit: Option<HeapLimit>) {
        self.limit.set(limit);
        self.extensions.set(0);
    }

    /// The limit.
    pub(super) fn limit(&self) -> Option<HeapLimit> {
        self.limit.get()
    }

    /// Is more in use than may be? Says so once, and again when a sixteenth more is in use.
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

    /// Would so many bytes more be too many?
    pub(crate) fn would_exhaust(&self, more: usize) -> bool {
        let Some(limit) = self.limit.get() else {
            return false;
        };
        let in_use = (limit.in_use)();
        if in_use < limit.bytes {
            self.extensions.set(0);
        }
        let extensions = self.extensions.get();
        let extended = limit.bytes + limit.bytes / EXTENSION * extensions;
        if in_use.saturating_add(more) < extended {
            return false;
        }
        if in_use >= limit.bytes {
            self.extensions
                .set((in_use - limit.bytes) / (limit.bytes / EXTENSION).max(1) + 1);
        }
        true
    }
}

/// The most elements that a sequence may have, so that nothing that is done with a sequence takes
/// longer than people wait for Ctrl-C.
pub const MOST_ELEMENTS: usize = 1 << 25;

/// Bytes from which on an allocation is worth a look: to fill them takes longer than that.
const LARGE: usize = 1 << 16;

/// Leaves the calling function by unwinding if a sequence may not have so many elements.
pub(crate) fn permit_length(elements: usize) {
    if elements > MOST_ELEMENTS && CURRENT.with_borrow(Option::is_some) {
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

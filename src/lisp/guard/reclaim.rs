//! How memory is given back that values hold without anybody reaching them. The rooms of values, which
//! are above this one, know how; an image provides it.

use std::sync::OnceLock;

/// What gives memory back.
#[derive(Debug)]
pub(crate) struct Reclaim {
    /// Frees all that nobody can reach.
    pub(crate) all: fn(),
    /// Frees some of it if that is due, given the bytes in use, if they are known.
    pub(crate) if_overdue: fn(Option<usize>),
}

static RECLAIM: OnceLock<Reclaim> = OnceLock::new();

/// Provides what gives memory back; only the first call counts.
pub(crate) fn provide(reclaim: Reclaim) {
    RECLAIM.get_or_init(|| reclaim);
}

/// Frees all that nobody can reach.
pub(super) fn all() {
    if let Some(reclaim) = RECLAIM.get() {
        (reclaim.all)();
    }
}

/// Frees some of it if that is due.
pub(super) fn if_overdue(in_use: Option<usize>) {
    if let Some(reclaim) = RECLAIM.get() {
        (reclaim.if_overdue)(in_use);
    }
}

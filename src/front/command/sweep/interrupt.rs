//! Ctrl-C during a sweep: the first one ends it in good order, the second one at once.

use super::super::watching::INTERRUPTED;
use std::sync::atomic::{AtomicBool, Ordering};

static HAS_COME: AtomicBool = AtomicBool::new(false);

/// Takes interrupts from now on.
pub(super) fn expect() {
    // Without a handler an interrupt ends the process: no more is lost than that.
    let _ = ctrlc::set_handler(|| {
        if HAS_COME.swap(true, Ordering::Relaxed) {
            std::process::exit(INTERRUPTED);
        }
    });
}

/// Whether one has come.
pub(super) fn has_come() -> bool {
    HAS_COME.load(Ordering::Relaxed)
}

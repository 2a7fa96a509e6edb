//! Interrupting what the kernel does, from any thread.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// The evaluator's flag, and whether there is anything to interrupt.
#[derive(Clone)]
pub(crate) struct Interrupter {
    flag: Arc<AtomicBool>,
    /// Requests that are being evaluated or wait for that.
    requests: Arc<AtomicUsize>,
    is_ending: Arc<AtomicBool>,
}

impl Interrupter {
    /// For an evaluator with that flag.
    pub(crate) fn new(flag: Arc<AtomicBool>) -> Interrupter {
        Interrupter {
            flag,
            requests: Arc::default(),
            is_ending: Arc::default(),
        }
    }

    /// Interrupts the evaluation. If there is none, nothing happens, now or later.
    pub(crate) fn interrupt(&self) {
        if self.requests.load(Ordering::SeqCst) > 0 {
            self.flag.store(true, Ordering::SeqCst);
        }
    }

    /// Whether an interrupt has not been noticed yet.
    pub(crate) fn is_interrupted(&self) -> bool {
        self.flag.load(Ordering::SeqCst)
    }

    /// A request has come that will be evaluated.
    pub(super) fn expect(&self) {
        self.requests.fetch_add(1, Ordering::SeqCst);
    }

    /// A request has been answered. What was to interrupt it does not interrupt the next one.
    pub(super) fn finish(&self) {
        self.requests.fetch_sub(1, Ordering::SeqCst);
        if !self.is_ending() {
            self.flag.store(false, Ordering::SeqCst);
        }
    }

    /// Ends the kernel: what is being evaluated is interrupted, and nothing more is begun.
    pub(crate) fn end(&self) {
        self.is_ending.store(true, Ordering::SeqCst);
        self.flag.store(true, Ordering::SeqCst);
    }

    /// Whether the kernel ends.
    pub(crate) fn is_ending(&self) -> bool {
        self.is_ending.load(Ordering::SeqCst)
    }
}

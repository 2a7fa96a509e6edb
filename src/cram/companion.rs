//! What goes on beside the plans while simulated time passes, such as a world that is written in the
//! language: functions that are called at regular times.

use lisp::value::Value;
use lisp::value::copy::{Copied, Copier};

use crate::state::Plan;

/// A function that is called again and again.
#[derive(Clone)]
pub(crate) struct Companion {
    /// When it is called next, in simulated seconds.
    next: f64,
    /// Simulated seconds between two calls.
    period: f64,
    function: Value,
}

impl Companion {
    /// One that is called for the first time after a period.
    pub(crate) fn new(now: f64, period: f64, function: Value) -> Companion {
        Companion {
            next: now + period,
            period,
            function,
        }
    }

    /// The function that is called.
    pub(crate) fn function(&self) -> Value {
        self.function.clone()
    }

    /// The same, to be called a period from now.
    pub(crate) fn again(self, now: f64) -> Companion {
        Companion {
            next: now + self.period,
            ..self
        }
    }

    /// Whether both call the same function.
    pub(crate) fn is_like(&self, other: &Companion) -> bool {
        self.function.is_eql(&other.function)
    }

    pub(crate) fn copied(&self, copier: &mut Copier) -> Companion {
        Companion {
            function: self.function.copied(copier),
            ..self.clone()
        }
    }
}

/// The time at which the next companion is called; `None` if there are none.
pub(crate) fn next_call(plan: &Plan) -> Option<f64> {
    let companions = plan.companions.borrow();
    let times = companions.iter().map(|companion| companion.next);
    times.min_by(f64::total_cmp)
}

/// The companions whose time has come, in the order in which they came; they are put aside until
/// [`Plan::add_companion`] puts them back.
pub(crate) fn take_due(plan: &Plan) -> Vec<Companion> {
    let now = plan.now();
    let all = plan.companions.take();
    let (due, later): (Vec<_>, Vec<_>) = all.into_iter().partition(|c| c.next <= now);
    *plan.companions.borrow_mut() = later;
    due
}

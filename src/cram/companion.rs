//! What goes on beside the plans while simulated time passes, such as a world that is written in the
//! language: functions that are called at regular times.

use lisp::evaluator::nested::call_nested;
use lisp::image::Image;
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

/// Calls the companions whose time has come, in the order in which they came; were there any?
pub(crate) fn call_due(image: &mut Image) -> bool {
    let plan = Plan::of(image);
    let now = plan.now();
    let mut called = false;
    for mut companion in plan.companions.take() {
        if companion.next > now {
            plan.companions.borrow_mut().push(companion);
            continue;
        }
        called = true;
        companion.next = now + companion.period;
        let goes_on = call_nested(image, companion.function.clone(), Vec::new());
        // It goes on after an interrupt, too.
        if goes_on.map_or(true, |value| !value.is_nil()) {
            plan.add_companion(companion);
        }
    }
    called
}

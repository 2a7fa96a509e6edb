//! The interface to the world, which carries out requests while simulated time passes.

#[cfg(test)]
use std::convert::Infallible;

use super::task::TaskId;
use crate::designator::MotionRequest;
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::raise::Raise;

/// A pending request of a task.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct Ticket(pub u64);

/// The result of a request: its value, or the condition to signal in the task.
pub type Outcome = Result<Value, Box<Raise>>;

/// The host's reply to a request.
pub enum Reply {
    /// It is completed.
    Now(Outcome),
    /// It takes simulated time: [`Host::advance`] reports its completion.
    Later(Ticket),
}

/// It is completed with a value.
impl From<Value> for Reply {
    fn from(value: Value) -> Reply {
        Reply::Now(Ok(value))
    }
}

/// What happened while simulated time passed.
pub struct Advance {
    /// The time now, in simulated seconds.
    pub now: f64,
    /// Requests that are completed.
    pub done: Vec<(Ticket, Outcome)>,
}

/// Carries out tasks' requests to the world.
pub trait Host {
    /// A call of a builtin that acts on the world.
    type Call: 'static;

    /// Carries out such a call.
    fn call(&mut self, image: &mut Image, task: TaskId, call: Self::Call) -> Reply;

    /// Carries out a motion.
    fn perform(&mut self, image: &mut Image, task: TaskId, motion: MotionRequest) -> Reply;

    /// Lets simulated time pass from `now` until a request is completed or until the given time, in
    /// seconds. Called only when every task is blocked and a request is pending. Returns early if
    /// the image's interrupt flag is set, and leaves it set.
    fn advance(&mut self, image: &mut Image, now: f64, until: Option<f64>) -> Advance;

    /// Lets simulated time jump from `now` to `until`, in seconds: no request is pending and every
    /// task sleeps. Returns the time at which to continue: `until`, or an earlier one if the
    /// image's interrupt flag is set.
    fn idle(&mut self, image: &mut Image, now: f64, until: f64) -> f64;

    /// Shows what the program has written.
    fn show_output(&mut self, image: &mut Image) {
        let _ = image;
    }

    /// Cancels a request for which no task waits any more.
    fn cancel(&mut self, image: &mut Image, ticket: Ticket);

    /// Lets simulated time pass from `now` until nothing moves any more of what was cancelled or
    /// paused. What was neither goes on meanwhile, and may be completed.
    fn stand_still(&mut self, image: &mut Image, now: f64) -> Advance {
        let _ = image;
        Advance {
            now,
            done: Vec::new(),
        }
    }

    /// Pauses a request because the task that made it is suspended.
    fn pause(&mut self, image: &mut Image, ticket: Ticket) {
        let _ = (image, ticket);
    }

    /// Resumes a request because the task that made it is woken up.
    fn wake(&mut self, image: &mut Image, ticket: Ticket) {
        let _ = (image, ticket);
    }
}

/// A host without a world.
#[cfg(test)]
#[derive(Default, Clone, Copy, Debug)]
pub(crate) struct NullHost;

#[cfg(test)]
impl Host for NullHost {
    type Call = Infallible;

    fn call(&mut self, _: &mut Image, _: TaskId, call: Infallible) -> Reply {
        match call {}
    }

    fn perform(&mut self, _: &mut Image, _: TaskId, _: MotionRequest) -> Reply {
        Reply::Now(Err(Raise::control("There is no world to act in.")))
    }

    fn advance(&mut self, _: &mut Image, now: f64, until: Option<f64>) -> Advance {
        Advance {
            now: until.unwrap_or(now),
            done: Vec::new(),
        }
    }

    fn idle(&mut self, _: &mut Image, _: f64, until: f64) -> f64 {
        until
    }

    fn cancel(&mut self, _: &mut Image, _: Ticket) {}
}

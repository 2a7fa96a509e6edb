//! The world as the scheduler sees it: something that carries out requests while simulated
//! time passes.

use std::any::Any;

use super::task::TaskId;
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::raise::Raise;

/// A request of a task that the host is working on.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub(crate) struct Ticket(pub(crate) u64);

/// What became of a request: its value, or the condition to signal in the task.
pub(crate) type Outcome = Result<Value, Box<Raise>>;

/// The host's answer to a request.
pub(crate) enum Reply {
    /// It is done.
    Now(Outcome),
    /// It takes simulated time: [`Host::advance`] tells when it is done.
    Later(Ticket),
}

/// What happened while simulated time passed.
pub(crate) struct Advance {
    /// The time now, in simulated seconds.
    pub(crate) now: f64,
    /// Requests that are done.
    pub(crate) done: Vec<(Ticket, Outcome)>,
}

/// Carries out what tasks request of the world.
pub(crate) trait Host {
    /// A request that the scheduler does not know itself.
    fn request(&mut self, image: &mut Image, task: TaskId, request: Box<dyn Any>) -> Reply;

    /// Lets simulated time pass from `now` until a request is done or until the given
    /// time, in seconds. Called only when every task is blocked and a request is open;
    /// returns without either when the image's interrupt flag is set, which it leaves set.
    fn advance(&mut self, image: &mut Image, now: f64, until: Option<f64>) -> Advance;

    /// Simulated time jumps from `now` to `until`, in seconds: no request is open and
    /// every task sleeps. Returns the time at which to go on: `until`, or an earlier one
    /// if the image's interrupt flag is set.
    fn idle(&mut self, image: &mut Image, now: f64, until: f64) -> f64;

    /// Nobody waits for the request any more: stop working on it.
    fn cancel(&mut self, image: &mut Image, ticket: Ticket);

    /// The task that made the request is suspended: hold still.
    fn pause(&mut self, image: &mut Image, ticket: Ticket) {
        let _ = (image, ticket);
    }

    /// The task that made the request goes on.
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
    fn request(&mut self, _: &mut Image, _: TaskId, _: Box<dyn Any>) -> Reply {
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

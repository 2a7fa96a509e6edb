//! What a program asks for, with its type.

use std::any::Any;

use crate::designator::MotionRequest;
use crate::request::Request;

/// What a program asks for; `C` is a call of the host.
pub(super) enum Asked<C> {
    /// Something of the scheduler.
    Scheduler(Request),
    /// A motion.
    Motion(MotionRequest),
    /// A call of the host.
    Host(C),
}

impl<C: 'static> Asked<C> {
    /// The machine carries what is asked for without knowing its type, which it gets back here;
    /// `None` if it is nothing that can be waited for.
    pub(super) fn of(request: Box<dyn Any>) -> Option<Self> {
        let request = match request.downcast() {
            Ok(request) => return Some(Self::Scheduler(*request)),
            Err(request) => request,
        };
        let request = match request.downcast() {
            Ok(call) => return Some(Self::Host(*call)),
            Err(request) => request,
        };
        let motion = request.downcast().ok()?;
        Some(Self::Motion(*motion))
    }
}

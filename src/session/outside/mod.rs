//! What a session has outside itself: files, a clock, and a robot elsewhere.
//!
//! Nothing else in a session opens a file or asks for the real time. A program that embeds a session
//! where there is no file system or no clock of the machine's gives it others.

mod clock;
mod robot_link;

use std::rc::Rc;
use std::sync::Arc;

use lisp::files::{Disk, Files};
use lisp::image::extension::Extension;
use lisp::value::copy::Copier;

pub use clock::{Clock, MachineClock};
pub use robot_link::{
    FingersReport, GoalTicket, PartGoal, RobotEnd, RobotLink, RobotState, SeenObject,
    TrajectoryPoint,
};

/// What a session has outside itself.
#[derive(Clone, Debug)]
pub struct Outside {
    /// The files that plans, pictures and recordings can use.
    pub files: Arc<dyn Files>,
    /// The clock that measures real time. It affects when something is shown, never what happens.
    pub clock: Arc<dyn Clock>,
    /// Called again and again while the session works, on its thread: a program that has only one thread
    /// can do something else there, such as notice that its user wants to interrupt.
    pub breathe: Option<fn()>,
}

impl Extension for Outside {
    fn copied(self: Rc<Self>, _: &mut Copier) -> Rc<dyn Extension> {
        self
    }
}

impl Default for Outside {
    /// The files and the clock of the machine.
    fn default() -> Outside {
        Outside {
            files: Arc::new(Disk),
            clock: Arc::new(MachineClock),
            breathe: None,
        }
    }
}

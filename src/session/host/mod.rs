//! The interface between plans and the world: tasks' requests are carried out here, and the
//! world advances while all tasks wait.
//!
//! The state is divided between three owners: [`Simulation`] has the world and its motions,
//! [`Person`] the state of the prompt, [`Audience`] the outputs that show the session. A
//! builtin asks for the one that it needs; see [`call`].

pub(crate) mod call;
pub(super) mod parts;
mod request;

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use crate::audience::Audience;
use crate::bounds::{Bounds, Limits};
use crate::person::Person;
use crate::simulation::Simulation;
use cram::TaskId;
use cram::designator::perform::MotionsBegun;
use lisp::image::Image;
use lisp::value::copy::Copier;

/// Everything outside Lisp that a task can use.
pub struct SimulationHost {
    /// The robot in its world.
    pub(crate) simulation: Simulation,
    /// The state of the prompt.
    pub(crate) person: Person,
    /// The outputs that show the session.
    pub(crate) audience: Audience,
    /// The limits of the evaluation under way.
    pub(crate) bounds: Bounds,
    /// Are edits of the world refused?
    pub(crate) is_closed: bool,
    /// The task whose request is being carried out.
    asking: TaskId,
}

impl SimulationHost {
    /// A host for the simulation.
    pub(crate) fn new(simulation: Simulation, audience: Audience) -> Self {
        Self {
            simulation,
            person: Person::default(),
            audience,
            bounds: Bounds::default(),
            is_closed: false,
            asking: TaskId(0),
        }
    }

    /// Puts limits in force for an evaluation with an interrupt flag.
    pub(crate) fn begin_bounds(&self, limits: &Limits, flag: &Arc<AtomicBool>) {
        let step = self.simulation.world().steps();
        self.bounds.begin(limits, flag, self.simulation.now(), step);
    }

    /// Interrupts the evaluation if it has reached a limit. To be called when time may have passed.
    pub(crate) fn check_bounds(&self) {
        let step = self.simulation.world().steps();
        self.bounds.check(self.simulation.now(), step);
    }
}

impl SimulationHost {
    /// The same host for a copy of the image, shown to nobody.
    pub(super) fn copied(&self, copier: &mut Copier, audience: Audience) -> Self {
        if !self.audience.is_empty() {
            copier.refuse("a session that is shown");
        }
        Self {
            simulation: self.simulation.copied(copier),
            person: self.person.copied(copier),
            audience,
            bounds: Bounds::default(),
            is_closed: self.is_closed,
            asking: self.asking,
        }
    }
}

/// Tells the image how many motions have begun, by which it distinguishes later events from
/// earlier ones.
fn note_motions(simulation: &Simulation, image: &mut Image) {
    image.extend(MotionsBegun(simulation.motions_begun()));
}

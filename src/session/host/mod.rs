//! The interface between plans and the world: tasks' requests are carried out here, and the
//! world advances while all tasks wait.
//!
//! The state is divided between three owners: [`Simulation`] has the world and its motions,
//! [`Person`] the state of the prompt, [`Audience`] the outputs that show the session. A
//! builtin asks for the one that it needs; see [`call`].

pub(crate) mod call;
pub(super) mod parts;
mod request;

use crate::lisp::image::Image;
use crate::lisp::value::copy::Copier;
use crate::plan::TaskId;
use crate::plan::designator::perform::MotionsBegun;
use crate::session::audience::Audience;
use crate::session::person::Person;
use crate::session::simulation::Simulation;

/// Everything outside Lisp that a task can use.
pub(crate) struct SimulationHost {
    /// The robot in its world.
    pub(crate) simulation: Simulation,
    /// The state of the prompt.
    pub(crate) person: Person,
    /// The outputs that show the session.
    pub(crate) audience: Audience,
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
            asking: TaskId(0),
        }
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
            asking: self.asking,
        }
    }
}

/// Tells the image how many motions have begun, by which it distinguishes later events from
/// earlier ones.
fn note_motions(simulation: &Simulation, image: &mut Image) {
    image.extend(MotionsBegun(simulation.motions_begun()));
}

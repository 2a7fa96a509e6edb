//! Where plans meet the world: requests of tasks are carried out here, and the world moves
//! on while all tasks wait.
//!
//! What there is belongs to three owners: the [`Simulation`] is the world and its motions, the
//! [`Person`] what was done at the prompt, the [`Audience`] who watches. A builtin asks for
//! the one that it needs, see [`call`].

pub(crate) mod call;
pub(super) mod parts;
mod request;

use crate::lisp::image::Image;
use crate::plan::TaskId;
use crate::plan::designator::perform::MotionsBegun;
use crate::session::audience::Audience;
use crate::session::person::Person;
use crate::session::simulation::Simulation;

/// All that a task can ask for beside Lisp.
pub(crate) struct SimulationHost {
    /// The robot in its world.
    pub(crate) simulation: Simulation,
    /// What the person at the prompt did.
    pub(crate) person: Person,
    /// Who watches.
    pub(crate) audience: Audience,
    /// The task whose request is carried out.
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

/// The number of motions that were begun, for the image: what happens later is told from what
/// happened before by it.
fn note_motions(simulation: &Simulation, image: &mut Image) {
    image.extend(MotionsBegun(simulation.jobs.begun));
}

//! Builtins that act on the world: they are requests that the session carries out.

use super::SimulationHost;
use crate::audience::Audience;
use crate::person::Person;
use crate::simulation::Simulation;
use cram::Reply;
use lisp::typed::{self, Owner};

/// The request to call a function on the host.
pub(crate) type HostCall = typed::HostCall<SimulationHost>;

impl typed::Host for SimulationHost {
    type Reply = Reply;
}

impl Owner for SimulationHost {
    type Host = SimulationHost;

    fn of(host: &mut SimulationHost) -> &mut Self {
        host
    }
}

impl Owner for Simulation {
    type Host = SimulationHost;

    fn of(host: &mut SimulationHost) -> &mut Self {
        &mut host.simulation
    }
}

impl Owner for Person {
    type Host = SimulationHost;

    fn of(host: &mut SimulationHost) -> &mut Self {
        &mut host.person
    }
}

impl Owner for Audience {
    type Host = SimulationHost;

    fn of(host: &mut SimulationHost) -> &mut Self {
        &mut host.audience
    }
}

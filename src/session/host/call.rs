//! Builtins that act on the world: they are requests that the session carries out.

use super::SimulationHost;
use crate::audience::Audience;
use crate::person::Person;
use crate::simulation::Simulation;
use cram::Reply;
use lisp::typed::{self, Owner};
use lisp::value::Value;
use lisp::value::raise::Raise;

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

/// A control builtin that requests a call of a function, whose first parameter determines the
/// [`Owner`] that it acts on.
macro_rules! host {
    ($function:path) => {
        $crate::host::call::host!($function, false)
    };
    ($function:path, $is_edit:expr) => {
        |_, args| {
            Ok(lisp::vm::step::Step::request(
                $crate::host::call::HostCall {
                    call: |host, image, args| $function(lisp::typed::Owner::of(host), image, args),
                    args,
                    is_edit: $is_edit,
                },
            ))
        }
    };
}
pub(crate) use host;

/// The same for a function that a closed session refuses: it changes the world otherwise than the robot
/// could, or opens a door to the outside.
macro_rules! edit {
    ($function:path) => {
        $crate::host::call::host!($function, true)
    };
}
pub(crate) use edit;

/// The reply of a completed call.
pub(crate) fn done(value: impl Into<Value>) -> Result<Reply, Box<Raise>> {
    Ok(Reply::Now(Ok(value.into())))
}

//! Builtins that act on the world: they are requests that the session carries out.

use super::SimulationHost;
use crate::audience::Audience;
use crate::person::Person;
use crate::simulation::Simulation;
use cram::Reply;
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::raise::Raise;

/// A function that acts on the host.
pub(crate) type HostFn = fn(&mut SimulationHost, &mut Image, &[Value]) -> Result<Reply, Box<Raise>>;

/// The request to call a function on the host.
pub(crate) struct HostCall {
    /// The function.
    pub call: HostFn,
    /// Its arguments.
    pub args: Vec<Value>,
    /// Does it change the world otherwise than the robot could, or open a door to the outside?
    pub is_edit: bool,
}

/// What a builtin acts on: one of the host's parts, or the whole host if it needs several.
pub(crate) trait Owner {
    /// That part of the host.
    fn of(host: &mut SimulationHost) -> &mut Self;
}

impl Owner for SimulationHost {
    fn of(host: &mut SimulationHost) -> &mut Self {
        host
    }
}

impl Owner for Simulation {
    fn of(host: &mut SimulationHost) -> &mut Self {
        &mut host.simulation
    }
}

impl Owner for Person {
    fn of(host: &mut SimulationHost) -> &mut Self {
        &mut host.person
    }
}

impl Owner for Audience {
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
                    call: |host, image, args| {
                        $function($crate::host::call::Owner::of(host), image, args)
                    },
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

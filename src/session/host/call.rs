//! Builtins that act on the world: they are requests, which the session carries out.

use super::SimulationHost;
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::raise::Raise;
use crate::plan::Reply;
use crate::session::audience::Audience;
use crate::session::person::Person;
use crate::session::simulation::Simulation;

/// A function on what there is beside Lisp.
pub(crate) type HostFn = fn(&mut SimulationHost, &mut Image, &[Value]) -> Result<Reply, Box<Raise>>;

/// The request to call a function on what there is beside Lisp.
pub(crate) struct HostCall {
    /// The function.
    pub(crate) call: HostFn,
    /// Its arguments.
    pub(crate) args: Vec<Value>,
}

/// What a builtin may get at: one of the host's owners, or the host where it needs several.
pub(crate) trait Owner {
    /// The owner of that kind.
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

/// The control builtin that requests a call of a function, whose first parameter says which
/// [`Owner`] it works on.
macro_rules! host {
    ($function:path) => {
        |_, args| {
            Ok($crate::lisp::vm::step::Step::request(
                $crate::session::host::call::HostCall {
                    call: |host, image, args| {
                        $function($crate::session::host::call::Owner::of(host), image, args)
                    },
                    args,
                },
            ))
        }
    };
}
pub(crate) use host;

/// The reply of a call that is done.
pub(crate) fn done(value: impl Into<Value>) -> Result<Reply, Box<Raise>> {
    Ok(Reply::Now(Ok(value.into())))
}

//! Builtins that act on the world: they are requests that the session carries out.

use super::SimulationHost;
use crate::audience::Audience;
use crate::person::Person;
use crate::simulation::Simulation;
use cram::Reply;
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::raise::Raise;

/// A function that acts on a part of the host.
pub(crate) type OwnerFn<O> = fn(&mut O, &mut Image, &[Value]) -> Result<Reply, Box<Raise>>;

/// A function that acts on the host.
pub(crate) type HostFn = OwnerFn<SimulationHost>;

/// The request to call a function on the host.
pub(crate) struct HostCall {
    /// The name of the function, in Rust.
    pub name: &'static str,
    /// Whether its reply is all that comes of it, besides changes of the physical state: then the
    /// tape answers for it.
    pub(crate) is_answered: bool,
    /// The function.
    pub call: HostFn,
    /// Its arguments.
    pub args: Vec<Value>,
}

/// What a builtin acts on: one of the host's parts, or the whole host if it needs several.
pub(crate) trait Owner {
    /// Whether the tape answers for calls of its functions. Where it does not, a function is called
    /// also while answers are played, and must not look at the physical state by itself.
    const IS_ANSWERED: bool = false;

    /// That part of the host.
    fn of(host: &mut SimulationHost) -> &mut Self;
}

impl Owner for SimulationHost {
    fn of(host: &mut SimulationHost) -> &mut Self {
        host
    }
}

impl Owner for Simulation {
    const IS_ANSWERED: bool = true;

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

/// Whether the tape answers for a function, as its first parameter says.
pub(crate) fn is_answered<O: Owner>(_: OwnerFn<O>) -> bool {
    O::IS_ANSWERED
}

/// A control builtin that requests a call of a function, whose first parameter determines the
/// [`Owner`] that it acts on. With `answered`, the tape answers for a function of the whole host:
/// its reply and changes of the physical state are all that comes of it. With `repeated`, it does not
/// answer for a function that changes something besides the physical state, at which it does not
/// look.
macro_rules! host {
    ($function:path) => {
        $crate::host::call::host!($function, $crate::host::call::is_answered($function))
    };
    (answered $function:path) => {
        $crate::host::call::host!($function, true)
    };
    (repeated $function:path) => {
        $crate::host::call::host!($function, false)
    };
    ($function:path, $is_answered:expr) => {
        |_, args| {
            Ok(lisp::vm::step::Step::request(
                $crate::host::call::HostCall {
                    name: stringify!($function),
                    is_answered: $is_answered,
                    call: |host, image, args| {
                        $function($crate::host::call::Owner::of(host), image, args)
                    },
                    args,
                },
            ))
        }
    };
}
pub(crate) use host;

/// The reply of a completed call.
pub(crate) fn done(value: impl Into<Value>) -> Result<Reply, Box<Raise>> {
    Ok(Reply::Now(Ok(value.into())))
}

//! Builtins that act on the world: they are requests, which the session carries out.

use super::Simulation;
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::raise::Raise;
use crate::plan::Reply;

/// A function on the world.
pub(crate) type HostFn = fn(&mut Simulation, &mut Image, &[Value]) -> Result<Reply, Box<Raise>>;

/// The request to call a function on the world.
pub(crate) struct HostCall {
    /// The function.
    pub(crate) call: HostFn,
    /// Its arguments.
    pub(crate) args: Vec<Value>,
}

/// The control builtin that requests a call of a [`HostFn`].
macro_rules! host {
    ($function:path) => {
        |_, args| {
            Ok($crate::lisp::vm::step::Step::request(
                $crate::session::simulation::call::HostCall {
                    call: $function,
                    args,
                },
            ))
        }
    };
}
pub(super) use host;

/// The reply of a call that is done.
pub(super) fn done(value: impl Into<Value>) -> Result<Reply, Box<Raise>> {
    Ok(Reply::Now(Ok(value.into())))
}

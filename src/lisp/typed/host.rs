//! What builtins act on that is outside of the image.

use crate::image::Image;
use crate::value::Value;
use crate::value::raise::Raise;

/// Carries out the calls of builtins that act on the world.
pub trait Host: Sized + 'static {
    /// The reply to a call: a value, or that it is still to come.
    type Reply: From<Value>;
}

/// What a builtin acts on: a part of a host, or the whole host if it needs several.
pub trait Owner {
    /// The host.
    type Host: Host;

    /// That part of the host.
    fn of(host: &mut Self::Host) -> &mut Self;
}

/// The host of an owner.
pub type HostOf<T> = <T as Owner>::Host;

/// The reply to a call that acts on an owner.
pub type ReplyTo<T> = <HostOf<T> as Host>::Reply;

/// The function that carries out a call.
pub type HostFn<H> = fn(&mut H, &mut Image, &[Value]) -> Result<<H as Host>::Reply, Box<Raise>>;

/// The request to call a builtin that acts on the world.
pub struct HostCall<H: Host> {
    /// The function.
    pub call: HostFn<H>,
    /// Its arguments.
    pub args: Vec<Value>,
    /// Does it change the world otherwise than the robot could, or open a door to the outside?
    pub is_edit: bool,
}

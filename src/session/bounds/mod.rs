//! What bounds an evaluation: limits, and interrupts from other threads.

mod in_force;
mod interrupt_handle;
mod limits;
mod running;

pub(crate) use in_force::Bounds;
pub use interrupt_handle::InterruptHandle;
pub use limits::{Limit, Limits};

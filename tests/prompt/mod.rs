//! A session as a person talks to it.

mod after_interrupt;
mod flattened;
mod flattened_tutorial;
mod recovery;
mod reference;
mod resume;
mod session;
mod shorthand;
mod soak;
mod standing_still;
mod talk;

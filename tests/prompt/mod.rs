//! A session as a person talks to it.

mod reference;
mod session;

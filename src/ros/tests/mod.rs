//! Tests of layouts, of their encoding, and of the messages that a session sends.

mod encoding;
#[cfg(feature = "wire")]
mod loopback;
mod messages;
mod tables;

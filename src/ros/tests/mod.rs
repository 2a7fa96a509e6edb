//! Tests of layouts, of their encoding, and of the messages that a session sends.

mod encoding;
mod messages;
mod tables;

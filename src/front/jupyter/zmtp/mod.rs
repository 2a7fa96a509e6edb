//! The transport of notebooks: the sockets of ZMTP 3.0 (RFC 23) that a kernel needs, over TCP.
//!
//! A socket listens; each peer has a thread that reads and one that writes. What a peer sends is
//! bounded before it is stored: no announced length is believed until the bytes are there. What
//! is sent to a peer waits in a queue, and nothing in it is ever dropped while the peer lives;
//! whoever produces much asks [`Socket::wait_for_room`] first.

mod frame;
mod handshake;
mod outbox;
mod socket;

pub(crate) use socket::{Kind, PeerNumber, Socket};

#[cfg(any(test, fuzzing))]
pub(crate) use frame::{encoded, read_frame};

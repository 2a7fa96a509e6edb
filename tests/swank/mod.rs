//! The server for Emacs, from the other end of its connections.

mod client;
mod conversation;
mod cross_references;
mod debugging;
mod hostile_clients;
mod interrupts;
mod several_clients;

//! A server for SLIME, the Lisp mode of Emacs, in its protocol, Swank.
//!
//! The session lives in one thread, which evaluates for all clients, one request after another.
//! Each connection has a thread that reads and one that writes. What needs no evaluation, such as
//! completions, is answered from [`Names`](session::dialogue::Names): by the session's
//! thread, or, while that evaluates something, by the connection's own.
//!
//! Nothing that a client sends ends the server, and no client can hold up another one's
//! connection. Every request gets exactly one answer.

mod answer;
mod autodoc;
mod compilation;
mod completion;
mod connection;
mod cross_references;
mod debugger;
mod definitions;
mod documentation;
mod engine;
mod framing;
mod hub;
mod inspector;
mod keep;
mod known_names;
mod levels;
mod outbox;
mod package_text;
mod question;
mod repl;
mod requests;
mod secret;
mod server;
mod sexp;
mod version;

pub(crate) use hub::Ended;
pub(crate) use keep::Keep;
pub(crate) use secret::{Secret, secret};
pub(crate) use server::{Server, ServerError, ServerOptions, Stopper};
pub(crate) use version::Version;

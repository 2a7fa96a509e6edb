//! Notebooks: a kernel for Jupyter, which evaluates the cells that clients send it.
//!
//! The session lives in one thread, which takes the requests of the shell channel one after the
//! other. The control channel is answered by threads of its own, so that an interrupt reaches a
//! running cell. Nothing here is printed: what is to be seen goes to the clients.

mod answers;
mod cell;
mod connection;
mod display;
mod executed;
mod history;
mod install;
mod interrupter;
mod kernel;
mod kernel_info;
mod message;
mod notebook;
mod publisher;
mod question;
mod settings;
mod signature;
mod watchdog;
pub(crate) mod zmtp;

pub(crate) use connection::Connection;
pub(crate) use executed::{NotebookError, outputs};
pub(crate) use install::{InstallError, Place, Specification};
pub(crate) use interrupter::Interrupter;
pub(crate) use kernel::{Kernel, KernelError};
pub(crate) use notebook::notebook;
pub(crate) use settings::Settings;
pub(crate) use watchdog::watch;

#[cfg(test)]
pub(crate) use message::Author;
#[cfg(any(test, fuzzing))]
pub(crate) use signature::Signer;

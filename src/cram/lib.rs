//! CRAM's plan language: tasks that run in parallel, fluents that they wait for, failures and their
//! handling.
//!
//! [`install()`] installs the language in an image; a [`Scheduler`] runs its programs. This layer
//! does not know about robots: when a task asks the world for something, the scheduler passes the
//! request to its [`Host`].

pub mod builtins;
mod companion;
pub mod designator;
mod failure_table;
mod fluent;
mod handlers;
pub mod host;
mod install;
pub mod journal;
mod library;
mod names;
pub(crate) mod open_action;
mod overview;
pub mod package;
pub mod package_table;
pub mod packages;
pub mod pose;
pub mod prolog;
mod request;
mod scheduler;
mod state;
mod task;
mod trace;
mod tree;

pub use handlers::Handlers;
#[cfg(test)]
pub(crate) use host::NullHost;
pub use host::{Advance, Host, Reply, Ticket};
pub use install::install;
pub use overview::tell_overview;
pub use scheduler::{Evaluation, Scheduler};
pub use state::Plan;
pub use task::{Status, TaskId, TaskRef};

type Result<T> = std::result::Result<T, Box<lisp::value::raise::Raise>>;

#[cfg(test)]
mod tests;

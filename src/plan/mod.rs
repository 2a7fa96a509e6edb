//! CRAM's plan language: tasks that run in parallel, fluents that they wait for, failures and their
//! handling.
//!
//! [`install()`] installs the language in an image; a [`Scheduler`] runs its programs. This layer
//! does not know about robots: when a task asks the world for something, the scheduler passes the
//! request to its [`Host`].

pub(crate) mod builtins;
pub(crate) mod designator;
mod failure_table;
mod fluent;
mod handlers;
pub(crate) mod host;
mod install;
pub(crate) mod journal;
mod library;
mod names;
pub(crate) mod open_action;
mod overview;
pub(crate) mod package;
pub(crate) mod packages;
pub(crate) mod pose;
pub(crate) mod prolog;
mod request;
mod scheduler;
mod state;
mod task;
mod tree;

pub(crate) use handlers::Handlers;
#[cfg(test)]
pub(crate) use host::NullHost;
pub(crate) use host::{Advance, Host, Reply, Ticket};
pub(crate) use install::install;
pub(crate) use overview::tell_overview;
pub(crate) use scheduler::{Evaluation, Scheduler};
pub(crate) use state::Plan;
pub(crate) use task::{Status, TaskId, TaskRef};

type Result<T> = std::result::Result<T, Box<crate::lisp::value::raise::Raise>>;

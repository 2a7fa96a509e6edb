//! CRAM's plan language: tasks that run in parallel, fluents that they wait for, failures
//! and how plans handle them.
//!
//! [`install`] brings the language into an image; a [`Scheduler`] runs what uses it. The
//! layer knows nothing of robots: what a task asks of the world is a request that the
//! scheduler hands to its [`Host`].

pub mod builtins;
pub mod designator;
mod failure_table;
mod fluent;
pub mod host;
mod install;
mod journal;
mod macros;
mod names;
mod overview;
pub mod package;
pub mod packages;
pub mod pose;
pub mod prolog;
mod request;
mod scheduler;
mod state;
mod step;
mod task;
mod tree;

pub use fluent::{Fluent, FluentRef};
pub use host::{Advance, Host, NullHost, Outcome, Reply, Ticket};
pub use install::install;
pub use journal::TaskChange;
pub(crate) use overview::overview_step;
pub use scheduler::{Evaluation, Scheduler, TaskInfo};
pub use state::Plan;
pub use task::{Status, Task, TaskId, TaskName, TaskRef};
pub use tree::{NodeObject, TreeNode};

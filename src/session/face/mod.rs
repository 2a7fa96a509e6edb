//! The face for programs: a session without text that has to be read.
//!
//! [`Session::run_file`](crate::Session::run_file), [`run`](crate::Session::run) and
//! [`call`](crate::Session::call) return values as [`Datum`] or a typed [`Failure`];
//! [`within`](crate::Session::within) puts [`Limits`](crate::Limits) around them.

mod datum;
mod edits;
mod failure;
mod followers;
mod from_value;
mod into_value;
mod kept_output;
mod names;
mod observer;
mod picture;
mod plan_event;
mod run;
mod snapshot;
mod task_log;

pub use datum::{Datum, FramedPose};
pub use failure::{Failure, Unhandled};
pub use followers::ObserverId;
pub use kept_output::KeptOutput;
pub(crate) use observer::Observer;
pub use plan_event::{PlanEvent, PlanEventKind, TaskBegin, TaskEnd};
pub use run::Within;
pub use snapshot::{RestoreError, Snapshot};
pub use task_log::{TaskLog, TaskNode};

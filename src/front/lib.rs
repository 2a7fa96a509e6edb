//! planwright: an interactive shell for programming a simulated kitchen robot in a
//! Common-Lisp-like plan language.
//!
//! A program that embeds it creates a [`Session`], runs plans in it, and asks where things are.
//! The [`guide`] has three whole programs.
//!
//! ```
//! use planwright::{Datum, Failure, Limits, Pose, Session, SessionOptions};
//!
//! planwright::use_compiled_library();
//! let mut session = Session::new(&SessionOptions::default())?;
//! session.run("setup", "(in-package :pp-tut)")?;
//! session.spawn("bottle", "bottle-1", Pose::translation(-1.6, -0.9, 0.82))?;
//! let plan = "(with-simulated-robot
//!               (perform (a motion (type moving-torso) (joint-angle 0.3))))
//!             (list (btr-utils:object-exists 'bottle-1) 0.3)";
//! let limits = Limits { simulated_time: Some(60.0), ..Limits::NONE };
//! let values = session.within(limits).run("my plan", plan)?;
//! assert_eq!(values, [Datum::list([Datum::True, Datum::Single(0.3)])]);
//! let torso = session.joint_position("torso_lift_joint").expect("the PR2 has a torso");
//! assert!((torso - 0.3).abs() < 0.001);
//! let bottle = session.object_pose("BOTTLE-1").expect("the bottle has been spawned");
//! assert!((bottle.translation.x - -1.6).abs() < 0.001);
//!
//! let failure = session.call("car", &[Datum::from(5)]).unwrap_err();
//! assert!(failure.unhandled().is_some_and(|condition| condition.is_a("TYPE-ERROR")));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The same calls with the same [`seed`](SessionOptions::seed) always have the same result, to the
//! bit.
//!
//! # Threads
//!
//! A [`Session`] stays in the thread that made it: it is neither `Send` nor `Sync`, because its
//! values share memory by counts that are not atomic (`Rc`). So are what refers to one:
//! [`Snapshot`], [`TaskLog`], [`Within`]. A program may have any number of sessions, each in a
//! thread with 2 MB of stack or more, and exchange data with them through channels. When a thread
//! with a session ends, all its memory is free again.
//!
//! ```compile_fail,E0277
//! fn sent<T: Send>() {}
//! sent::<planwright::Session>();
//! ```
//!
//! All data may go anywhere: [`SessionOptions`], [`Datum`], [`Failure`], [`Limits`],
//! [`PlanEvent`], [`TaskNode`], [`Picture`] and [`InterruptHandle`] are `Send` and `Sync`.
//!
//! # Units
//!
//! Lengths are in metres, angles in radians, times in seconds, efforts in newtons. Poses without a
//! frame are in the map frame: its origin is on the floor, x points forward, y to the left, z up.

#![warn(missing_docs)]

mod command;
mod grade_report;
mod jupyter;
mod manual;
mod mcp;
#[doc(hidden)]
pub mod measured;
mod precompiled;
mod prompt;
mod swank;
mod sweep_report;
mod tools;
mod transcript;

#[doc(hidden)]
pub use command::main;
pub use lisp::files;
pub use lisp::guard::heap::HeapLimit;
pub use lisp::source::Location;
pub use precompiled::use_compiled_library;
pub use robotics::robot::Side;
pub use session::dialogue::{
    Abort, ActionStep, Evaluate, Event, Finding, Outcome, Severity, Stop, Suggestion,
};
pub use session::outside::{Clock, MachineClock, Outside};
pub use session::{
    Datum, Failure, FramedPose, InterruptHandle, KeptOutput, Limit, Limits, ObserverId, PlanEvent,
    PlanEventKind, RestoreError, Snapshot, TaskBegin, TaskEnd, TaskLog, TaskNode, Unhandled,
    Within,
};
pub use session::{LogLevel, Session, SessionError, SessionOptions, WatchError};
pub use spatial::{Pose, pose};
pub use view::picture::{Image as Picture, View, ViewError};
pub use view::watch::{About, TaskId, TaskState};

#[doc = include_str!("guide.md")]
pub mod guide {}

/// What `tests/fuzz/coverage` feeds.
#[cfg(all(fuzzing, not(test)))]
#[doc(hidden)]
#[path = "../../tests/fuzz/mod.rs"]
pub mod fuzz;

/// White-box tests, in one binary; `tests/command_line` tests the program.
#[cfg(test)]
#[path = "../../tests"]
#[allow(clippy::print_stdout)]
mod tests {
    #[allow(unreachable_pub, reason = "another program feeds the same targets")]
    mod fuzz;
    mod jupyter;
    mod language;
    mod plans;
    mod prompt;
    mod replay;
    mod swank;
    mod view;
    mod waiting;

    /// A folder for files that tests write.
    fn scratch_folder() -> std::path::PathBuf {
        let folder = std::env::temp_dir().join(format!("planwright-tests-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder can be made");
        folder
    }
}

//! planwright: an interactive shell for programming a simulated kitchen robot in a
//! Common-Lisp-like plan language.
//!
//! A program that embeds it creates a [`Session`], has it evaluate plan-language text, and then
//! asks where things are:
//!
//! ```
//! use planwright::{Evaluate, Outcome, Session, SessionOptions};
//!
//! let mut session = Session::new(&SessionOptions::default())?;
//! let plan = "(in-package :pp-tut)
//!             (spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)))
//!             (with-simulated-robot (perform (a motion (type moving-torso) (joint-angle 0.3))))";
//! let outcome = session.evaluate("my plan", plan, &mut |event| println!("{event:?}"));
//! assert_eq!(outcome, Outcome::Finished);
//! let bottle = session.object_pose("BOTTLE-1").expect("the bottle has been spawned");
//! assert!((bottle.translation.x - -1.6).abs() < 0.001);
//! let torso = session.joint_position("torso_lift_joint").expect("the PR2 has a torso");
//! assert!((torso - 0.3).abs() < 0.001);
//! # Ok::<(), planwright::SessionError>(())
//! ```
//!
//! What happens during evaluation is reported as [`Event`]s: output, values, pictures, and the
//! [`Abort`] of an unhandled condition. The same text with the same
//! [`seed`](SessionOptions::seed) always has the same result, to the bit.

#![warn(missing_docs)]

mod command;
mod jupyter;
mod manual;
#[doc(hidden)]
pub mod measured;
mod prompt;
mod swank;
mod sweep_report;
mod transcript;

#[doc(hidden)]
pub use command::main;
pub use lisp::guard::heap::HeapLimit;
pub use lisp::source::Location;
pub use robotics::robot::Side;
pub use session::dialogue::{Abort, ActionStep, Evaluate, Event, Finding, Outcome, Severity, Stop};
pub use session::{LogLevel, Session, SessionError, SessionOptions};
pub use spatial::Pose;
pub use view::picture::Image as Picture;

/// White-box tests, in one binary; `tests/command_line` tests the program.
#[cfg(test)]
#[path = "../../tests"]
#[allow(clippy::print_stdout)]
mod tests {
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

//! planwright: an interactive shell for programming a simulated kitchen robot in a
//! Common-Lisp-like plan language.

#![warn(unreachable_pub)]

mod closest_name;
mod front;
mod lisp;
mod motion;
mod perception;
mod picture;
mod plan;
mod robot;
mod session;
mod sexp;
mod spatial;
mod watch;
mod world;

#[doc(hidden)]
pub use front::command::main;
pub use lisp::source::Location;
pub use picture::Image as Picture;
pub use session::dialogue::{Abort, ActionStep, Evaluate, Event, Finding, Outcome, Severity, Stop};
pub use session::{LogLevel, Session, SessionError, SessionOptions};
pub use spatial::Pose;

/// The tests that look inside, in one binary; `tests/command_line` has those of the program.
#[cfg(test)]
#[path = "../tests"]
#[allow(clippy::print_stdout)]
mod tests {
    mod language;
    pub(crate) mod motion;
    mod plans;
    mod prompt;
    mod replay;
    mod robot;
    mod view;
    pub(crate) mod world;

    /// A folder for files that tests write.
    fn scratch_folder() -> std::path::PathBuf {
        let folder = std::env::temp_dir().join(format!("planwright-tests-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder can be made");
        folder
    }
}

//! Ending the process: when a client has asked for it and the kernel does not, or when the program
//! that has started the kernel is gone, so that nobody else would end it.

use std::env;
use std::io;
use std::path::Path;
use std::thread;
use std::time::{Duration, Instant};

use super::interrupter::Interrupter;

/// How often to look whether the kernel is to end.
const LOOK: Duration = Duration::from_millis(100);
/// How often to look whether the parent is gone.
const LOOK_AT_PARENT: Duration = Duration::from_secs(1);
/// How long the kernel may take to end by itself: clients kill it soon after.
const PATIENCE: Duration = Duration::from_millis(900);

/// Starts the thread that ends the process.
pub(crate) fn watch(interrupter: Interrupter) -> io::Result<()> {
    let parent = Parent::named();
    let watch = move || {
        let mut looked = Instant::now();
        while !interrupter.is_ending() {
            thread::sleep(LOOK);
            if looked.elapsed() >= LOOK_AT_PARENT {
                looked = Instant::now();
                if parent.as_ref().is_some_and(Parent::is_gone) {
                    break;
                }
            }
        }
        let begin = Instant::now();
        while begin.elapsed() < PATIENCE {
            // What is done at an interrupt may have no end, either.
            interrupter.end();
            thread::sleep(LOOK);
        }
        std::process::exit(0);
    };
    thread::Builder::new().spawn(watch)?;
    Ok(())
}

/// The program that has started the kernel.
struct Parent {
    /// Its number, as Jupyter names it.
    named: String,
    /// The number of the process above this one, where the system tells.
    above: Option<u32>,
}

impl Parent {
    /// The parent, if Jupyter names one.
    fn named() -> Option<Parent> {
        let named = env::var("JPY_PARENT_PID").ok()?;
        Some(Parent {
            named,
            above: above(),
        })
    }

    /// Whether this process has been passed on to another one, or the parent is not listed any more.
    fn is_gone(&self) -> bool {
        let processes = Path::new("/proc");
        let is_unlisted = || !processes.join(&self.named).exists();
        above() != self.above || processes.join("self").exists() && is_unlisted()
    }
}

#[cfg(unix)]
fn above() -> Option<u32> {
    Some(std::os::unix::process::parent_id())
}

#[cfg(not(unix))]
fn above() -> Option<u32> {
    None
}

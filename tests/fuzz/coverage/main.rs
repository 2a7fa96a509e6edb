//! Fuzzing by coverage: inputs that reach code which none has reached are kept, and others are made of them.
//!
//! `tests/fuzz/coverage/run` builds this program with counters at all edges of the code, and runs it:
//!
//! ```text
//! tests/fuzz/coverage/run TARGET SECONDS
//! ```
//!
//! Without a target, it names them; `all` gives each its part of the time. What has been kept stands in
//! `target/fuzz/coverage/TARGET`, where the next run goes on; beside that folder stand inputs that fail, the one
//! under way and how many there have been in all runs.

#[cfg(fuzzing)]
mod counters;
#[cfg(fuzzing)]
mod search;

#[cfg(fuzzing)]
fn main() {
    search::main();
}

#[cfg(not(fuzzing))]
fn main() {
    eprintln!("tests/fuzz/coverage/run builds this program with the counters that it needs");
    std::process::exit(2);
}

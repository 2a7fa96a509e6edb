//! Fuzzing by coverage: inputs that reach code which none has reached are kept, and others are made of them.
//!
//! `tests/fuzz/coverage/run` builds this program with counters at all edges of the code, and runs it:
//!
//! ```text
//! tests/fuzz/coverage/run TARGET SECONDS
//! ```
//!
//! Without a target, it names them. What has been kept stands in `target/fuzz/coverage/TARGET`, where the next
//! run goes on; inputs that fail stand beside that folder.

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

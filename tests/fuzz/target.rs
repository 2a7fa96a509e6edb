//! What is fed with inputs.

use std::thread;

use lisp::guard::set_stack_budget;

/// A part of the program that reads.
pub struct Target {
    /// Its name.
    pub name: &'static str,
    /// Of a thousand executions of the short run, how many are of this target.
    pub share: u64,
    /// Of a hundred pieces of the corpus as they are, how many must be read: what refuses everything at its
    /// beginning is not tried by inputs made of it.
    pub least_read: usize,
    /// Words that mean something to it.
    pub words: &'static [&'static str],
    /// What inputs are made of.
    pub corpus: fn() -> Vec<Vec<u8>>,
    /// A fresh one, which takes one input after the other.
    pub open: fn() -> Taker,
}

/// What became of an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Taken {
    /// It was what the target reads.
    Read,
    /// It was refused.
    Refused,
}

impl Taken {
    /// Read, if it was.
    pub(super) fn if_read(is_read: bool) -> Self {
        match is_read {
            true => Self::Read,
            false => Self::Refused,
        }
    }
}

/// Takes an input; an error says what is wrong with the program.
pub type Taker = Box<dyn FnMut(&[u8]) -> Result<Taken, String>>;

/// Has an input taken; a panic is an error, too.
pub fn attempt(take: &mut Taker, input: &[u8]) -> Result<Taken, String> {
    match defect::caught(|| take(input)) {
        Ok(taken) => taken,
        Err(defect) => Err(format!("it panics: {defect}")),
    }
}

/// Runs something on a thread like those of the program's commands.
pub fn with_large_stack<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    thread::scope(|scope| {
        let thread = thread::Builder::new().stack_size(64 << 20);
        let work = || {
            set_stack_budget(48 << 20);
            work()
        };
        let thread = thread
            .spawn_scoped(scope, work)
            .expect("a thread can be made");
        thread.join().expect("the thread does not panic")
    })
}

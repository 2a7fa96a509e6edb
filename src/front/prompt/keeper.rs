//! Keeps a session's inputs in its journal, and says so when that fails.

use std::io::{self, Write};

use super::journal::{Earlier, End, Journal, Loaded, Recorded, copied};
use lisp::visible::visible;
use session::dialogue::Converse;

/// Keeps inputs in a journal, if there is one.
#[derive(Debug, Default)]
pub(crate) struct Keeper {
    journal: Option<Journal>,
    /// Whether the last attempt to write failed.
    is_failing: bool,
}

impl Keeper {
    pub(crate) fn new(journal: Option<Journal>) -> Keeper {
        let is_failing = journal.as_ref().is_some_and(Journal::is_behind);
        Keeper {
            journal,
            is_failing,
        }
    }

    /// The evaluation of an input begins.
    pub(crate) fn begun(&mut self, text: &str, stops: bool) {
        self.write(|journal| journal.begun(text, stops));
    }

    /// The evaluation has ended.
    pub(crate) fn ended(&mut self, evaluator: &(impl Converse + ?Sized)) {
        let (at, hash) = (evaluator.interrupted_at(), evaluator.world_hash());
        let loaded = evaluator.take_loaded().into_iter();
        let loaded = loaded
            .map(|(file, text)| Loaded::of(&file, &text))
            .collect();
        let ending = evaluator.last_ending();
        self.write(|journal| journal.ended(at, Some(hash), Some(ending), loaded));
    }

    /// The evaluation of an input of an earlier session has ended otherwise than before, which is
    /// not to count.
    pub(super) fn ended_as_before(&mut self, input: &Recorded) {
        let End::Ended(hash) = input.end else {
            return;
        };
        let (at, ending) = (input.interrupted_at, input.ending.as_deref());
        self.write(|journal| journal.ended(at, hash, ending, input.loaded.clone()));
    }

    /// The evaluation of that input of an earlier session, counted from one, begins again.
    pub(super) fn again(&mut self, number: usize) {
        self.write(|journal| journal.again(number));
    }

    /// That input of an earlier session, counted from one, is left out.
    pub(super) fn skipped(&mut self, number: usize) {
        self.write(|journal| journal.skipped(number));
    }

    /// From here on, keeps a session that consists of these inputs of the earlier one; in a journal
    /// of its own, so that the earlier one stays whole. Returns a remark about it.
    pub(super) fn part_of(&mut self, earlier: &Earlier, inputs: Vec<Recorded>) -> String {
        let (journal, remark) = copied(&earlier.beginning, &inputs);
        *self = Keeper::new(journal);
        format!(
            "; The inputs after it are not evaluated, but {} keeps them.\n{remark}",
            earlier.path.display(),
        )
    }

    /// Writes to the journal. Says when that fails for the first time, and when it succeeds
    /// again; what could not be written is then written, too.
    fn write(&mut self, write: impl FnOnce(&mut Journal) -> io::Result<()>) {
        let Some(journal) = &mut self.journal else {
            return;
        };
        let path = journal.path().display().to_string();
        let message = match write(journal) {
            Ok(()) if self.is_failing => {
                format!("; What is typed is kept again in {path}; nothing is missing.")
            }
            Err(error) if !self.is_failing => format!(
                "; What is typed from here on is not kept: cannot write to {path}: {error}. Every input tries again."
            ),
            Ok(()) | Err(_) => return,
        };
        self.is_failing = !self.is_failing;
        // If standard error is closed, the message is lost.
        let _ = writeln!(io::stderr(), "{}", visible(&message));
    }
}

//! Keeps a session's inputs in its journal, and says so when that fails; and what the world
//! answered on the tape beside it.

use std::io::{self, Write};
use std::rc::Rc;

use super::journal::{Earlier, End, Journal, Lineage, Recorded, Tape, Taped, copied, fingerprint};
use session::dialogue::Converse;
use session::tape::Frame;

/// Keeps inputs in a journal, if there is one.
#[derive(Debug, Default)]
pub(crate) struct Keeper {
    journal: Option<Journal>,
    /// Whether the last attempt to write failed.
    is_failing: bool,
    /// The tape, unless none can be kept.
    tape: Option<Tape>,
    /// That of the inputs that have ended.
    lineage: Lineage,
    /// The input that is being evaluated, and whether conditions stop it.
    current: Option<(String, bool)>,
}

impl Keeper {
    pub(crate) fn new(journal: Option<Journal>) -> Keeper {
        Keeper {
            journal,
            ..Keeper::default()
        }
    }

    /// Keeps a tape beside the journal, with inputs of an earlier session and their states, and
    /// the lineage of these inputs.
    pub(crate) fn begin_tape(
        &mut self,
        evaluator: &(impl Converse + ?Sized),
        inputs: Vec<Taped>,
        states: Vec<Rc<Frame>>,
        lineage: Lineage,
    ) {
        self.lineage = lineage;
        self.tape = self.journal.as_ref().and_then(|journal| {
            let fingerprint = fingerprint(evaluator.fingerprint());
            // A session without a tape is resumed more slowly, that is all.
            Tape::create(journal.path(), fingerprint, inputs, states).ok()
        });
    }

    /// Keeps a tape of a session without inputs.
    pub(crate) fn begin_fresh_tape(&mut self, evaluator: &(impl Converse + ?Sized)) {
        self.begin_tape(evaluator, Vec::new(), Vec::new(), Lineage::default());
    }

    /// The evaluation of an input begins.
    pub(crate) fn begun(
        &mut self,
        text: &str,
        stops: bool,
        evaluator: &mut (impl Converse + ?Sized),
    ) {
        self.current = Some((text.to_owned(), stops));
        evaluator.record_next(self.tape.is_some());
        self.write(|journal| journal.begun(text, stops));
    }

    /// The evaluation has ended.
    pub(crate) fn ended(&mut self, evaluator: &mut (impl Converse + ?Sized)) {
        let (at, hash) = (evaluator.interrupted_at(), evaluator.world_hash());
        self.write(|journal| journal.ended(at, hash));
        let Some((text, stops)) = self.current.take() else {
            return;
        };
        self.lineage = self.lineage.after(&text, stops, at);
        if let (Some(tape), Some(part)) = (&mut self.tape, evaluator.recorded())
            && tape.add(self.lineage, part).is_err()
        {
            self.tape = None;
        }
    }

    /// The evaluation of that input of an earlier session, counted from one, begins again, with
    /// the physics.
    pub(super) fn again(
        &mut self,
        number: usize,
        input: &Recorded,
        evaluator: &mut (impl Converse + ?Sized),
    ) {
        self.current = Some((input.text.clone(), input.stops));
        evaluator.record_next(self.tape.is_some());
        self.write(|journal| journal.again(number));
    }

    /// That input of an earlier session, counted from one, is about to be played.
    pub(super) fn about_to_play(&mut self, number: usize) {
        self.write(|journal| journal.again(number));
    }

    /// It was played, with the hash of the world that is known.
    pub(super) fn played(&mut self, input: &Recorded) {
        if let End::Ended(Some(hash)) = input.end {
            self.write(|journal| journal.ended(input.interrupted_at, hash));
        }
    }

    /// The user has interrupted the input that was being played.
    pub(super) fn stopped(&mut self, evaluator: &(impl Converse + ?Sized)) {
        let (at, hash) = (evaluator.interrupted_at(), evaluator.world_hash());
        self.write(|journal| journal.ended(at, hash));
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
        let _ = writeln!(io::stderr(), "{message}");
    }
}

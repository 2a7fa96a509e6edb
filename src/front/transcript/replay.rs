//! Runs transcripts.

use std::collections::BTreeMap;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

use super::parse::Transcript;
use super::verdict::Verdict;
use session::dialogue::repeat::{Repeat, split_interrupt};
use session::dialogue::screen::input_name;
use session::dialogue::{Outcome, Screen};

/// Runs the inputs of a transcript one after the other.
///
/// After an input that ends the session, the remaining ones have no output. Where the next
/// prompt shows that an evaluation is stopped, conditions and interrupts stop this one; elsewhere
/// they end it.
pub(crate) fn replay(transcript: &Transcript, evaluator: &mut impl Repeat) -> Vec<Verdict> {
    replay_first(transcript, transcript.entries.len(), evaluator)
}

/// Like [`replay`], for the first `count` inputs only.
pub(crate) fn replay_first(
    transcript: &Transcript,
    count: usize,
    evaluator: &mut impl Repeat,
) -> Vec<Verdict> {
    let mut left = false;
    transcript
        .entries
        .iter()
        .take(count)
        .enumerate()
        .map(|(number, entry)| {
            let mut output = String::new();
            // A prompt without an input only shows how the input before it ended.
            if !left && !entry.input.trim().is_empty() {
                let next = transcript.entries.get(number + 1);
                evaluator.set_interactive(next.is_some_and(|next| next.is_stopped));
                let name = input_name(number + 1);
                let outcome;
                (output, outcome) = evaluate(evaluator, &name, &entry.input);
                left = matches!(outcome, Outcome::Quit(_));
            }
            Verdict::of(entry, &output)
        })
        .collect()
}

/// What the screen shows for an input.
fn evaluate(evaluator: &mut impl Repeat, name: &str, input: &str) -> (String, Outcome) {
    let (input, interrupted_at) = split_interrupt(input);
    if let Some(at) = interrupted_at {
        evaluator.interrupt_next_at(at);
    }
    let mut screen = Screen::new(Vec::new());
    screen.begin_input(name, input);
    let outcome = evaluator.evaluate(name, input, &mut |event| {
        // Writing to memory does not fail.
        let _ = screen.show(&event);
    });
    let output = String::from_utf8_lossy(&screen.into_inner()).into_owned();
    (output, outcome)
}

/// Bytes of stack for a thread that runs transcripts.
const STACK_BYTES: usize = 64 << 20;

/// Runs transcripts on up to `jobs` threads, each in an evaluator of its own, and reports their
/// verdicts in the order of the transcripts, each as soon as possible.
///
/// `report` gets the transcript and the verdicts of its entries in order, or the reason why there
/// is no evaluator; once it returns false, no further transcript is started.
pub(crate) fn replay_all<V, E>(
    transcripts: &[Transcript],
    jobs: NonZeroUsize,
    open: impl Fn() -> Result<V, E> + Sync,
    mut report: impl FnMut(&Transcript, Result<Vec<Verdict>, E>) -> bool,
) where
    V: Repeat,
    E: Send,
{
    let next = AtomicUsize::new(0);
    let (sender, receiver) = mpsc::channel();
    thread::scope(|scope| {
        for _ in 0..jobs.get().min(transcripts.len()) {
            let (sender, next, open) = (sender.clone(), &next, &open);
            let run = move || {
                loop {
                    let number = next.fetch_add(1, Ordering::Relaxed);
                    let Some(transcript) = transcripts.get(number) else {
                        break;
                    };
                    let actual = open().map(|mut evaluator| replay(transcript, &mut evaluator));
                    if sender.send((number, actual)).is_err() {
                        break;
                    }
                }
            };
            // Forms may be nested deeply. If no thread can be created, the others do the work.
            let _ = thread::Builder::new()
                .stack_size(STACK_BYTES)
                .spawn_scoped(scope, run);
        }
        drop(sender);
        let mut waiting = BTreeMap::new();
        let mut reported = 0;
        for (number, actual) in receiver {
            waiting.insert(number, actual);
            while let Some(actual) = waiting.remove(&reported) {
                let continues = transcripts
                    .get(reported)
                    .is_some_and(|transcript| report(transcript, actual));
                if !continues {
                    next.store(transcripts.len(), Ordering::Relaxed);
                }
                reported += 1;
            }
        }
    });
}

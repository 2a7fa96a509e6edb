//! Resuming an earlier session: its inputs are evaluated again.

use std::io::{self, Write};

use super::journal::{Earlier, End, Recorded};
use super::keeper::Keeper;
use crate::session::dialogue::Converse;
use crate::session::dialogue::screen::input_name;

/// What to do with an input of which nobody knows whether it ended.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Doubt {
    /// Leave it out.
    Skip,
    /// Evaluate it again.
    Retry,
}

/// Decides what becomes of inputs without an end; `ask` gets the number and the text of each.
pub(crate) fn settle_doubts(
    earlier: &mut Earlier,
    keeper: &mut Keeper,
    mut ask: impl FnMut(usize, &str) -> io::Result<Doubt>,
) -> io::Result<()> {
    for (at, input) in earlier.inputs.iter_mut().enumerate() {
        if input.end == End::Unknown && ask(at + 1, &input.text)? == Doubt::Skip {
            input.end = End::Skipped;
            keeper.skipped(at + 1);
        }
    }
    Ok(())
}

/// Evaluates the inputs of an earlier session again without showing their output; `number`
/// becomes the number of the last one.
///
/// Where the user interrupts, the session continues without the inputs after that. With
/// `shows_progress`, a line says how far it is.
pub(crate) fn resume(
    evaluator: &mut dyn Converse,
    keeper: &mut Keeper,
    earlier: &Earlier,
    number: &mut usize,
    mut out: impl Write,
    shows_progress: bool,
) -> io::Result<()> {
    let inputs = &earlier.inputs;
    let skips = inputs.iter().any(|input| input.end == End::Skipped);
    let count = inputs.len();
    let erase = if shows_progress { "\r\x1b[2K" } else { "" };
    let mut differs_from = None;
    let mut resumed = 0;
    for (at, input) in inputs.iter().enumerate() {
        *number += 1;
        if input.end == End::Skipped {
            continue;
        }
        if shows_progress {
            write!(out, "{erase}; Input {} of {count} …", at + 1)?;
            out.flush()?;
        }
        keeper.again(at + 1);
        let interrupted_at = evaluate_again(evaluator, &input_name(*number), input);
        let hash = evaluator.world_hash();
        keeper.ended(evaluator);
        resumed += 1;
        if interrupted_at.is_some() && interrupted_at != input.interrupted_at {
            writeln!(out, "{erase}; Interrupted at input {} of {count}.", at + 1)?;
            if at + 1 < count {
                let end = End::Ended(Some(hash));
                writeln!(
                    out,
                    "{}",
                    keeper.part_from(earlier, at, interrupted_at, end)
                )?;
            }
            return Ok(());
        }
        if matches!(input.end, End::Ended(Some(recorded)) if recorded != hash) {
            differs_from.get_or_insert(at + 1);
        }
    }
    if count > 0 {
        let hash = evaluator.world_hash();
        writeln!(
            out,
            "{erase}; Resumed {resumed} inputs; the world's hash is {hash:016x}."
        )?;
    }
    if let Some(number) = differs_from.filter(|_| !skips) {
        writeln!(
            out,
            "; The world is not the same as in the earlier session since input {number}: a loaded file or planwright itself may have changed."
        )?;
    }
    Ok(())
}

/// Returns where the evaluation was interrupted.
fn evaluate_again(evaluator: &mut dyn Converse, name: &str, input: &Recorded) -> Option<u64> {
    evaluator.set_interactive(input.stops);
    if let Some(at) = input.interrupted_at {
        evaluator.interrupt_next_at(at);
    }
    evaluator.evaluate(name, &input.text, &mut |_| {});
    evaluator.interrupted_at()
}

/// The first lines of an input, to be shown.
pub(crate) fn excerpt(text: &str) -> String {
    const MOST_LINES: usize = 8;
    const LONGEST_LINE: usize = 100;
    let mut lines: Vec<String> = text
        .lines()
        .take(MOST_LINES)
        .map(|line| match line.char_indices().nth(LONGEST_LINE) {
            Some((end, _)) => format!(";   {} …", line.get(..end).unwrap_or(line)),
            None => format!(";   {line}"),
        })
        .collect();
    if text.lines().count() > MOST_LINES {
        lines.push(";   …".to_owned());
    }
    lines.join("\n")
}

//! Resuming an earlier session: its inputs are evaluated again.

use std::io::{self, Write};

use super::journal::{Earlier, End, Recorded};
use super::keeper::Keeper;
use session::dialogue::screen::input_name;
use session::dialogue::{Converse, Event};

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

/// How a resume goes on, told on one line of a terminal that is written again and again.
struct Progress<W> {
    out: W,
    is_shown: bool,
    count: usize,
}

impl<W: Write> Progress<W> {
    /// What takes away the line.
    fn erase(&self) -> &'static str {
        if self.is_shown { "\r\x1b[2K" } else { "" }
    }

    /// Tells which input is being evaluated, by its index, and what happens in it.
    fn show(&mut self, at: usize, what: &str) -> io::Result<()> {
        if self.is_shown {
            let (erase, count) = (self.erase(), self.count);
            write!(self.out, "{erase}; Input {} of {count} {what}", at + 1)?;
            self.out.flush()?;
        }
        Ok(())
    }

    fn tell(&mut self, text: &str) -> io::Result<()> {
        writeln!(self.out, "{}{text}", self.erase())
    }
}

/// Evaluates the inputs of an earlier session again without showing their output, and without
/// waiting for real time; `number` becomes the number of the last one.
///
/// Where the user interrupts, the session continues without the inputs after that. With
/// `shows_progress`, a line says how far it is.
pub(crate) fn resume(
    evaluator: &mut dyn Converse,
    keeper: &mut Keeper,
    earlier: &Earlier,
    number: &mut usize,
    out: impl Write,
    shows_progress: bool,
) -> io::Result<()> {
    let mut progress = Progress {
        out,
        is_shown: shows_progress,
        count: earlier.inputs.len(),
    };
    evaluator.set_hurried(true);
    let resumed = evaluate_all(evaluator, keeper, earlier, number, &mut progress);
    evaluator.set_hurried(false);
    resumed
}

/// Evaluates the inputs again, and tells how that ended.
fn evaluate_all(
    evaluator: &mut dyn Converse,
    keeper: &mut Keeper,
    earlier: &Earlier,
    number: &mut usize,
    progress: &mut Progress<impl Write>,
) -> io::Result<()> {
    let inputs = &earlier.inputs;
    let mut differs = None;
    for (at, input) in inputs.iter().enumerate() {
        *number += 1;
        if input.end == End::Skipped {
            continue;
        }
        keeper.again(at + 1);
        let name = input_name(*number);
        let interrupted_at = evaluate_again(evaluator, &name, input, at, progress)?;
        let hash = evaluator.world_hash();
        keeper.ended(evaluator);
        if interrupted_at.is_some() && interrupted_at != input.interrupted_at {
            let state = (at, interrupted_at.unwrap_or_default(), hash);
            return tell_interrupt(keeper, earlier, state, progress);
        }
        if matches!(input.end, End::Ended(Some(recorded)) if recorded != hash) {
            differs.get_or_insert(at + 1);
        }
    }
    tell_end(evaluator, inputs, differs, progress)
}

/// The user has interrupted the input with that index, at that place and with that hash of the
/// world: the session is what was evaluated up to there.
fn tell_interrupt(
    keeper: &mut Keeper,
    earlier: &Earlier,
    (at, interrupted_at, hash): (usize, u64, u64),
    progress: &mut Progress<impl Write>,
) -> io::Result<()> {
    let count = progress.count;
    progress.tell(&format!("; Interrupted at input {} of {count}.", at + 1))?;
    if at + 1 < count {
        let mut part = earlier.inputs.get(..=at).unwrap_or_default().to_vec();
        if let Some(last) = part.last_mut() {
            last.interrupted_at = Some(interrupted_at);
            last.end = End::Ended(Some(hash));
        }
        let remark = keeper.part_of(earlier, part);
        progress.tell(&remark)?;
    }
    Ok(())
}

/// Tells what has been resumed, and since which input, by its number, the world differs.
fn tell_end(
    evaluator: &dyn Converse,
    inputs: &[Recorded],
    differs: Option<usize>,
    progress: &mut Progress<impl Write>,
) -> io::Result<()> {
    if inputs.is_empty() {
        return Ok(());
    }
    let resumed = inputs.iter().filter(|input| input.end != End::Skipped);
    let resumed = match resumed.count() {
        1 => "1 input".to_owned(),
        count => format!("{count} inputs"),
    };
    let hash = evaluator.world_hash();
    progress.tell(&format!(
        "; Resumed {resumed}; the world's hash is {hash:016x}."
    ))?;
    let skips = inputs.iter().any(|input| input.end == End::Skipped);
    if let Some(number) = differs.filter(|_| !skips) {
        progress.tell(&format!(
            "; The world is not the same as in the earlier session since input {number}: a loaded file or planwright itself may have changed."
        ))?;
    }
    Ok(())
}

/// Evaluates an input again; `at` is its index. Returns where the evaluation was interrupted.
fn evaluate_again(
    evaluator: &mut dyn Converse,
    name: &str,
    input: &Recorded,
    at: usize,
    progress: &mut Progress<impl Write>,
) -> io::Result<Option<u64>> {
    progress.show(at, "…")?;
    evaluator.set_interactive(input.stops);
    if let Some(at) = input.interrupted_at {
        evaluator.interrupt_next_at(at);
    }
    let mut told = Ok(());
    evaluator.evaluate(name, &input.text, &mut |event| {
        if let Event::Progress(text) = event
            && told.is_ok()
        {
            told = progress.show(at, &text);
        }
    });
    told?;
    Ok(evaluator.interrupted_at())
}

/// The first lines of an input, to be shown.
pub(crate) fn excerpt(text: &str) -> String {
    const MAX_LINES: usize = 8;
    const MAX_LINE_LENGTH: usize = 100;
    let mut lines: Vec<String> = text
        .lines()
        .take(MAX_LINES)
        .map(|line| match line.char_indices().nth(MAX_LINE_LENGTH) {
            Some((end, _)) => format!(";   {} …", line.get(..end).unwrap_or(line)),
            None => format!(";   {line}"),
        })
        .collect();
    if text.lines().count() > MAX_LINES {
        lines.push(";   …".to_owned());
    }
    lines.join("\n")
}

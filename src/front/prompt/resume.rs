//! Resuming an earlier session: its inputs are evaluated again.

use std::io::{self, Write};

use super::journal::{Earlier, End, Loaded, Recorded};
use super::keeper::Keeper;
use lisp::visible::visible;
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
            let what = visible(what);
            write!(self.out, "{erase}; Input {} of {count} {what}", at + 1)?;
            self.out.flush()?;
        }
        Ok(())
    }

    fn tell(&mut self, text: &str) -> io::Result<()> {
        writeln!(self.out, "{}{}", self.erase(), visible(text))
    }
}

/// How far a session has been resumed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Resumed {
    /// As far as the user wanted.
    Whole,
    /// Up to the input with that number, from one, which ended otherwise than before.
    UpTo(usize),
}

/// Evaluates the inputs of an earlier session again without showing their output, and without
/// waiting for real time; `number` becomes the number of the last one.
///
/// Where the user interrupts, the session continues without the inputs after that. At the first input
/// that ends otherwise than before, `ask` decides whether to go on. With `shows_progress`, a line says
/// how far it is.
pub(crate) fn resume(
    evaluator: &mut dyn Converse,
    keeper: &mut Keeper,
    earlier: &Earlier,
    number: &mut usize,
    out: impl Write,
    shows_progress: bool,
    ask: &mut dyn FnMut() -> bool,
) -> io::Result<Resumed> {
    let mut progress = Progress {
        out,
        is_shown: shows_progress,
        count: earlier.inputs.len(),
    };
    evaluator.set_hurried(true);
    let resumed = evaluate_all(evaluator, keeper, earlier, number, &mut progress, ask);
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
    ask: &mut dyn FnMut() -> bool,
) -> io::Result<Resumed> {
    let inputs = &earlier.inputs;
    // Without inputs that are left out, later ones end as they must.
    let skips = inputs.iter().any(|input| input.end == End::Skipped);
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
        if interrupted_at.is_some() && interrupted_at != input.interrupted_at {
            keeper.ended(evaluator);
            let ended = Recorded {
                interrupted_at,
                end: End::Ended(Some(hash)),
                ending: Some(evaluator.last_ending().to_owned()),
                ..input.clone()
            };
            tell_interrupt(keeper, earlier, (at, ended), progress)?;
            return Ok(Resumed::Whole);
        }
        if differs.is_none()
            && !skips
            && let Some(what) = difference(evaluator, input)
        {
            differs = Some(at + 1);
            progress.tell(&format!(
                "; Input {} has ended otherwise than in the earlier session: {what}. A file that it \
                 has read, or planwright itself, may have changed.",
                at + 1
            ))?;
            if !ask() {
                keeper.ended_as_before(input);
                return Ok(Resumed::UpTo(at + 1));
            }
        }
        keeper.ended(evaluator);
    }
    tell_end(evaluator, inputs, progress)?;
    Ok(Resumed::Whole)
}

/// What is different from how an input ended in the earlier session, as far as that is known.
fn difference(evaluator: &dyn Converse, input: &Recorded) -> Option<String> {
    let now = evaluator.last_ending();
    if let Some(before) = input.ending.as_deref().filter(|before| *before != now) {
        return Some(format!("it {now}, not {before}"));
    }
    match input.end {
        End::Ended(Some(before)) if before != evaluator.world_hash() => {
            Some("the world is another one".to_owned())
        }
        _ => None,
    }
}

/// From here on, keeps the session that consists of the earlier one's inputs up to that with a number,
/// from one. Returns a remark about it.
pub(super) fn keep_up_to(
    evaluator: &dyn Converse,
    keeper: &mut Keeper,
    earlier: &Earlier,
    number: usize,
) -> String {
    let mut part = earlier.inputs.get(..number).unwrap_or_default().to_vec();
    if let Some(last) = part.last_mut() {
        last.end = End::Ended(Some(evaluator.world_hash()));
        last.ending = Some(evaluator.last_ending().to_owned());
        let loaded = evaluator.take_loaded().into_iter();
        last.loaded = loaded
            .map(|(file, text)| Loaded::of(&file, &text))
            .collect();
    }
    keeper.part_of(earlier, part)
}

/// The user has interrupted the input with that index, which has ended so: the session is what was
/// evaluated up to there.
fn tell_interrupt(
    keeper: &mut Keeper,
    earlier: &Earlier,
    (at, ended): (usize, Recorded),
    progress: &mut Progress<impl Write>,
) -> io::Result<()> {
    let count = progress.count;
    progress.tell(&format!("; Interrupted at input {} of {count}.", at + 1))?;
    if at + 1 < count {
        let mut part = earlier.inputs.get(..at).unwrap_or_default().to_vec();
        part.push(ended);
        let remark = keeper.part_of(earlier, part);
        progress.tell(&remark)?;
    }
    Ok(())
}

/// Tells what has been resumed.
fn tell_end(
    evaluator: &dyn Converse,
    inputs: &[Recorded],
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
    ))
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
    visible(&lines.join("\n")).into_owned()
}

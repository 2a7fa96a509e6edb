//! Evaluates standard input when it is not a terminal.

use std::io::{self, BufRead, IsTerminal, Read, Write};

use super::failure::{CommandError, Status};
use super::open::open_session;
use super::options::Options;
use super::prompt::{PromptOptions, changed, open_journals};
use super::watching::{self, WatchArguments};
use crate::prompt::{Doubt, JournalError, Keeper, Opened, Resumed, excerpt, resume, settle_doubts};
use lisp::files::{MAX_PLAN_BYTES, permit_plan_length};
use lisp::visible::visible;
use session::dialogue::screen::input_name;
use session::dialogue::{Converse, GrowingInput, Outcome, Repeat, Screen, evaluate_on};

/// Takes inputs as the prompt would, each as soon as it is complete, and prints what the prompt
/// would print. Continues after an unhandled condition. Keeps a journal only if the user asks
/// for one, or resumes a session.
pub(crate) fn evaluate_standard_input(
    mut options: Options,
    wanted: &PromptOptions,
    watch: &WatchArguments,
) -> Result<Status, CommandError> {
    let journals = if wanted.resume.is_some() || wanted.journal.is_some() {
        open_journals(&mut options, wanted)?
    } else {
        Opened::default()
    };
    if let Some(path) = changed(&journals, wanted)? {
        return Err(JournalError::Changed(path).into());
    }
    let mut session = open_session(&options)?;
    let watched = watching::begin(&mut session, watch)?;
    if watch.real_robot.is_some() {
        let _ = watching::finish_at_interrupt(&session, watch, &watched);
    }
    let mut screen = Screen::new(io::BufWriter::new(io::stdout()));
    screen.set_cautious(io::stdout().is_terminal());
    let mut keeper = Keeper::new(journals.journal);
    for remark in &journals.remarks {
        writeln!(io::stderr(), "{}", visible(remark))?;
    }
    let mut number = 0;
    if let Some(mut earlier) = journals.earlier {
        settle_doubts(&mut earlier, &mut keeper, |number, text| {
            let shown = excerpt(text);
            writeln!(
                io::stderr(),
                "; Input {number} began, but nothing says that it ended. It is left out:\n{shown}"
            )?;
            Ok(Doubt::Skip)
        })?;
        let progress = io::stderr();
        let resumed = resume(
            &mut session,
            &mut keeper,
            &earlier,
            &mut number,
            progress,
            false,
            &mut || wanted.despite_changes,
        )?;
        if let Resumed::UpTo(number) = resumed {
            let path = earlier.path;
            return Err(JournalError::Differs { path, number }.into());
        }
        session.set_interactive(false);
    }
    let stdin = io::stdin().lock();
    let status = evaluate_lines(stdin, &mut session, &mut screen, &mut keeper, number)?;
    watching::linger(&session, watched);
    session.end_recording()?;
    session.end_with_process();
    Ok(status)
}

fn evaluate_lines(
    mut lines: impl BufRead,
    session: &mut impl Converse,
    screen: &mut Screen<impl Write>,
    keeper: &mut Keeper,
    mut number: usize,
) -> Result<Status, CommandError> {
    let mut status = Status::Good;
    let mut text = String::new();
    let mut input = GrowingInput::default();
    loop {
        let at_end = read_line(&mut lines, &mut text)? == 0;
        if !at_end && !input.is_whole(&text) {
            continue;
        }
        if !text.trim().is_empty() {
            number += 1;
            // Nobody could decide how to continue: conditions end this input also when it is
            // resumed.
            keeper.begun(&text, false);
            let outcome = evaluate_on(screen, session, &input_name(number), &text)?;
            keeper.ended(session);
            match outcome {
                Outcome::Finished => {}
                Outcome::Aborted | Outcome::Stopped => status = Status::Bad,
                Outcome::Quit(code) => return Ok(Status::Left(code)),
            }
        }
        if at_end {
            return Ok(status);
        }
        text.clear();
        input = GrowingInput::default();
    }
}

/// Appends a line; bytes that are not UTF-8 become replacement characters.
fn read_line(lines: &mut impl BufRead, text: &mut String) -> Result<usize, CommandError> {
    let mut bytes = Vec::new();
    let failed = |error| CommandError::Read {
        path: "standard input".into(),
        error,
    };
    // One byte more than may be tells that there are more.
    let mut lines = lines.by_ref().take(MAX_PLAN_BYTES + 1);
    let count = lines.read_until(b'\n', &mut bytes).map_err(failed)?;
    text.push_str(&String::from_utf8_lossy(&bytes));
    permit_plan_length(text.len() as u64).map_err(failed)?;
    Ok(count)
}

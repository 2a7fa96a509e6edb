//! Evaluates standard input when it is not a terminal.

use std::io::{self, BufRead, Write};

use super::failure::{CommandError, Status};
use super::open::open_session;
use super::options::Options;
use super::prompt::{PromptOptions, open_journals};
use super::watching::{self, WatchArguments};
use crate::prompt::{Doubt, Keeper, Opened, excerpt, resume, settle_doubts};
use session::dialogue::screen::input_name;
use session::dialogue::{Converse, Outcome, Repeat, Screen, evaluate_on, is_whole};

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
    let mut session = open_session(&options)?;
    let has_browser = watching::begin(&mut session, watch)?;
    let mut screen = Screen::new(io::BufWriter::new(io::stdout()));
    let mut keeper = Keeper::new(journals.journal);
    for remark in &journals.remarks {
        writeln!(io::stderr(), "{remark}")?;
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
        resume(
            &mut session,
            &mut keeper,
            &earlier,
            &mut number,
            progress,
            false,
        )?;
        session.set_interactive(false);
    }
    let stdin = io::stdin().lock();
    let status = evaluate_lines(stdin, &mut session, &mut screen, &mut keeper, number)?;
    watching::linger(&session, has_browser);
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
    loop {
        let at_end = read_line(&mut lines, &mut text)? == 0;
        if !at_end && !is_whole(&text) {
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
    }
}

/// Appends a line; bytes that are not UTF-8 become replacement characters.
fn read_line(lines: &mut impl BufRead, text: &mut String) -> Result<usize, CommandError> {
    let mut bytes = Vec::new();
    let count = lines
        .read_until(b'\n', &mut bytes)
        .map_err(|error| CommandError::Read {
            path: "standard input".into(),
            error,
        })?;
    text.push_str(&String::from_utf8_lossy(&bytes));
    Ok(count)
}

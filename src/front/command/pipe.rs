//! Evaluates standard input when it is not a terminal.

use std::io::{self, BufRead};

use super::arguments::{Options, WatchArguments};
use super::failure::{CommandError, Status};
use super::open::open_session;
use super::watching;
use crate::session::dialogue::screen::input_name;
use crate::session::dialogue::{Evaluate, Outcome, Screen, evaluate_on, is_whole};

/// Takes inputs as the prompt would, each as soon as it is complete, and prints what the prompt
/// would print. Continues after an unhandled condition.
pub(crate) fn evaluate_standard_input(
    options: &Options,
    watch: &WatchArguments,
) -> Result<Status, CommandError> {
    let mut session = open_session(options)?;
    let has_browser = watching::begin(&mut session, watch)?;
    let mut screen = Screen::new(io::BufWriter::new(io::stdout()));
    let stdin = io::stdin().lock();
    let status = evaluate_lines(stdin, &mut session, &mut screen)?;
    watching::linger(&session, has_browser);
    Ok(status)
}

fn evaluate_lines(
    mut lines: impl BufRead,
    session: &mut impl Evaluate,
    screen: &mut Screen<impl io::Write>,
) -> Result<Status, CommandError> {
    let mut status = Status::Good;
    let mut text = String::new();
    let mut number = 0;
    loop {
        let at_end = read_line(&mut lines, &mut text)? == 0;
        if !at_end && !is_whole(&text) {
            continue;
        }
        if !text.trim().is_empty() {
            number += 1;
            match evaluate_on(screen, session, &input_name(number), &text)? {
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

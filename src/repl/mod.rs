//! The prompt: reads inputs with a line editor, evaluates them, shows what happens.
//!
//! An input may span lines: Enter evaluates it when it is whole and begins a further line
//! when it is not. Ctrl-C clears the input, or interrupts an evaluation, and never ends
//! the session; Ctrl-D ends it.

mod assist;
mod editor;
mod highlight;
mod history;
mod indent;
mod pasted;

use std::io::{self, IsTerminal, Write};
use std::sync::Arc;
use std::sync::atomic::Ordering;

use rustyline::error::ReadlineError;
use thiserror::Error;

use crate::dialogue::screen::input_name;
use crate::dialogue::{Evaluate, Outcome, Screen, evaluate_on};
use crate::viewer::InlinePictures;
use editor::LineEditor;
use pasted::Inputs;

/// Why the prompt cannot be used.
#[derive(Debug, Error)]
pub enum ReplError {
    /// Standard output takes no more.
    #[error("cannot write: {0}")]
    Write(#[from] io::Error),
    /// The terminal does not do as the line editor needs.
    #[error("the terminal cannot be used: {0}")]
    Terminal(#[from] ReadlineError),
    /// Ctrl-C cannot be caught.
    #[error("cannot listen to Ctrl-C: {0}")]
    Interrupt(#[from] ctrlc::Error),
}

const BANNER: &str = concat!(
    "planwright ",
    env!("CARGO_PKG_VERSION"),
    ": a simulated PR2 in its kitchen, programmed in plans.\n",
    "Enter evaluates a whole form; Ctrl-C interrupts, Ctrl-D leaves.\n",
);

/// Reads and evaluates inputs until the user or the program leaves; returns the exit
/// status.
pub fn run(mut evaluator: impl Evaluate, colored: bool) -> Result<u8, ReplError> {
    let interrupt = evaluator.interrupt_handle();
    let handle = Arc::clone(&interrupt);
    ctrlc::set_handler(move || handle.store(true, Ordering::Relaxed))?;

    let mut editor = LineEditor::new(colored)?;
    let mut screen = Screen::new(io::stdout());
    screen.set_detailed(true);
    if io::stdout().is_terminal() {
        let pictures = InlinePictures::detect(|name| std::env::var(name).ok());
        screen.set_pictures(pictures);
    }
    io::stdout().write_all(BANNER.as_bytes())?;
    let mut number = 0;
    loop {
        let text = match editor.read(&evaluator.prompt()) {
            Ok(text) => text,
            Err(ReadlineError::Interrupted) => continue,
            Err(ReadlineError::Eof) => return Ok(0),
            Err(error) => return Err(error.into()),
        };
        let inputs = Inputs::of(&text);
        match inputs.output_lines {
            0 => {}
            1 => writeln!(io::stdout(), "; 1 line of pasted output is left out")?,
            n => writeln!(io::stdout(), "; {n} lines of pasted output are left out")?,
        }
        // An interrupt ends the rest of what was pasted, too.
        interrupt.store(false, Ordering::Relaxed);
        for input in inputs.inputs {
            number += 1;
            match evaluate_on(
                &mut screen,
                &mut evaluator,
                &input_name(number),
                input.trim_end(),
            )? {
                Outcome::Quit(code) => return Ok(code),
                Outcome::Finished | Outcome::Aborted => {}
            }
            if interrupt.load(Ordering::Relaxed) {
                break;
            }
        }
    }
}

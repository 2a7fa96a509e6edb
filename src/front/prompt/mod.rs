//! The prompt: reads inputs with a line editor, evaluates them and shows the results.
//!
//! An input may span lines: Enter evaluates a complete input and continues any other on a new
//! line. Ctrl-C clears the input or interrupts an evaluation and never ends the session; Ctrl-D
//! ends it.

mod assist;
mod drawing;
mod editor;
mod highlight;
mod history;
pub(crate) mod indent;
mod journal;
mod keeper;
mod keys;
mod layout;
mod menu;
mod open_forms;
pub(crate) mod pasted;
mod resume;
mod serving;
mod shape;
mod tty;
mod typed_ahead;

use std::cell::RefCell;
use std::io::{self, IsTerminal, Write};
use std::rc::Rc;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use rustyline::error::ReadlineError;
use thiserror::Error;

use assist::Shared;
use editor::LineEditor;
use lisp::visible::visible;
use pasted::Inputs;
use resume::keep_up_to;
use serving::Serving;
use session::dialogue::screen::input_name;
use session::dialogue::{Outcome, Screen, Serve, evaluate_on};
use view::picture::InlinePictures;

pub(crate) use history::lessons_file;
pub(crate) use journal::{Beginning, Earlier, JournalError, Loaded, Opened, Wanted, open};
pub(crate) use keeper::Keeper;
pub(crate) use resume::{Doubt, Resumed, excerpt, resume, settle_doubts};

/// Why the prompt cannot be used.
#[derive(Debug, Error)]
pub(crate) enum ReplError {
    /// Standard output cannot be written to.
    #[error("cannot write: {0}")]
    Write(#[from] io::Error),
    /// The terminal lacks something that the line editor needs.
    #[error("the terminal cannot be used: {0}")]
    Terminal(#[from] ReadlineError),
    /// Ctrl-C cannot be caught.
    #[error("cannot listen for Ctrl-C: {0}")]
    Interrupt(#[from] ctrlc::Error),
}

const BANNER: &str = concat!(
    "planwright ",
    env!("CARGO_PKG_VERSION"),
    ": a simulated robot in its kitchen, programmed in plans.\n",
    "Enter evaluates a whole form; Tab completes; Ctrl-C interrupts; Ctrl-D leaves.\n",
    "(help) lists what you can do; (tour) guides you through a first session.\n",
);

/// The input that brings back for editing what was left out of a pasted text.
const BRING_BACK: &str = ":pasted";
/// How many lines of that are shown.
const SHOWN_LINES: usize = 3;

/// If an interrupt takes longer than this, the user is told why.
const SOON: Duration = Duration::from_millis(90);

/// How the prompt starts.
#[derive(Debug, Default)]
pub(crate) struct ReplOptions {
    /// Whether to use colours.
    pub(crate) is_colored: bool,
    /// Where inputs are saved before they are evaluated, and the session to resume.
    pub(crate) journals: Opened,
    /// A remark to print before the first prompt.
    pub(crate) remark: Option<String>,
    /// Number of inputs evaluated before the prompt.
    pub(crate) inputs_before: usize,
    /// Whether a session is resumed although it is not the same any more.
    pub(crate) despite_changes: bool,
}

/// Reads and evaluates inputs until the user or the program exits; returns the exit status.
pub(crate) fn run(evaluator: impl Serve + 'static, options: ReplOptions) -> Result<u8, ReplError> {
    let interrupt = evaluator.interrupt_handle();
    let handle = Arc::clone(&interrupt);
    let serving = Serving::default();
    let served = serving.clone();
    let is_evaluating = Arc::new(AtomicBool::new(false));
    let evaluating = Arc::clone(&is_evaluating);
    ctrlc::set_handler(move || {
        if served.stop() {
            return;
        }
        handle.store(true, Ordering::Relaxed);
        thread::sleep(SOON);
        if handle.load(Ordering::Relaxed) && evaluating.load(Ordering::Relaxed) {
            // If standard error is closed, the message is lost.
            let _ = write!(io::stderr(), "\r\n; Stopping …");
        }
    })?;

    let evaluator: Shared = Rc::new(RefCell::new(evaluator));
    evaluator.borrow_mut().set_interactive(true);
    let mut editor = LineEditor::new(
        Rc::clone(&evaluator),
        options.is_colored,
        Arc::clone(&interrupt),
    )?;
    let mut screen = Screen::new(io::stdout());
    screen.set_detailed(true);
    let is_terminal = io::stdout().is_terminal();
    screen.set_terminal(is_terminal);
    screen.set_colored(options.is_colored);
    if is_terminal {
        let pictures = InlinePictures::detect(|name| std::env::var(name).ok());
        screen.set_pictures(pictures);
    }
    io::stdout().write_all(BANNER.as_bytes())?;
    let Opened {
        journal,
        earlier,
        remarks,
    } = options.journals;
    for remark in options.remark.iter().chain(&remarks) {
        writeln!(io::stdout(), "{}", visible(remark))?;
    }
    let mut repl = Repl {
        evaluator,
        interrupt,
        is_evaluating,
        screen,
        keeper: Keeper::new(journal),
        number: options.inputs_before,
        left_out: None,
        draft: None,
        serving,
        despite_changes: options.despite_changes,
    };
    repl.evaluator.borrow_mut().let_serve();
    if let Some(mut earlier) = earlier {
        repl.resume(&mut earlier, &mut editor)?;
    }
    // An earlier session that was served is not served again.
    repl.evaluator.borrow_mut().take_port();
    let status = repl.converse(&mut editor)?;
    if let Err(reason) = repl.evaluator.borrow_mut().finish() {
        // If standard error is closed, the message is lost.
        let _ = writeln!(io::stderr(), "; {reason}.");
    }
    Ok(status)
}

/// What the prompt works with besides the line editor.
struct Repl {
    evaluator: Shared,
    interrupt: Arc<AtomicBool>,
    is_evaluating: Arc<AtomicBool>,
    screen: Screen<io::Stdout>,
    keeper: Keeper,
    /// Number of the latest input.
    number: usize,
    /// What was left out of the text pasted last.
    left_out: Option<String>,
    /// What is offered for editing next.
    draft: Option<String>,
    /// The server for an editor, while there is one.
    serving: Serving,
    /// Whether a session is resumed although it is not the same any more.
    despite_changes: bool,
}

impl Repl {
    /// Reads and evaluates inputs; returns the exit status.
    fn converse(&mut self, editor: &mut LineEditor) -> Result<u8, ReplError> {
        loop {
            let (prompt, draft, level, answer) = {
                let mut evaluator = self.evaluator.borrow_mut();
                let draft = self.draft.take().or_else(|| evaluator.take_draft());
                let answer = evaluator.answer_to_interrupt();
                (evaluator.prompt(), draft, evaluator.level(), answer)
            };
            // A second Ctrl-C may come before the line editor is ready for it.
            let is_hurried = self.interrupt.swap(false, Ordering::Relaxed);
            let read = match answer {
                Some(_) if is_hurried => Err(ReadlineError::Interrupted),
                _ => editor.read(&prompt, draft.as_deref()),
            };
            let text = match read {
                Ok(text) => text,
                Err(ReadlineError::Interrupted) => match answer {
                    Some(answer) => answer.to_owned(),
                    None => continue,
                },
                Err(ReadlineError::Eof) if level == 0 => return Ok(0),
                Err(ReadlineError::Eof) => {
                    if editor.confirm("An evaluation is suspended. Leave anyway?") {
                        return Ok(0);
                    }
                    continue;
                }
                Err(error) => return Err(error.into()),
            };
            if let Some(code) = self.take(&text)? {
                return Ok(code);
            }
            if let Some(code) = self.serve_if_asked()? {
                return Ok(code);
            }
        }
    }

    /// Evaluates typed or pasted text; returns the exit status if that ends the session.
    fn take(&mut self, text: &str) -> Result<Option<u8>, ReplError> {
        if text.trim() == BRING_BACK {
            self.draft = std::mem::take(&mut self.left_out);
            if self.draft.is_none() {
                writeln!(io::stdout(), "; Nothing was left out of what was pasted.")?;
            }
            return Ok(None);
        }
        let Inputs {
            inputs,
            left_out,
            unfinished,
        } = Inputs::of(text);
        if inputs.len() > 1 || !unfinished.is_empty() || !left_out.is_empty() {
            self.left_out = None;
        }
        self.leave_out("it is not finished", unfinished)?;
        self.leave_out("it looks like output", left_out)?;
        let count = inputs.len();
        let level = self.evaluator.borrow().level();
        for (at, input) in inputs.iter().enumerate() {
            let input = input.trim_end();
            if count > 1 {
                // Typed text already follows a prompt; pasted inputs get one each.
                let prompt = self.evaluator.borrow().prompt();
                writeln!(io::stdout(), "{prompt}> {}", visible(input))?;
            }
            // A pasted session continues after a condition, as it did when it was recorded, unless
            // a plan stands still that this would end.
            let stops = level > 0 || at + 1 == count;
            let outcome = self.evaluate(input, stops)?;
            if let Outcome::Quit(code) = outcome {
                return Ok(Some(code));
            }
            let is_over = self.interrupt.load(Ordering::Relaxed)
                || self.was_interrupted()
                || level > 0 && outcome == Outcome::Stopped;
            if is_over {
                let rest = inputs.iter().skip(at + 1);
                let rest = rest.flat_map(|input| input.lines().map(str::to_owned));
                self.leave_out("an input before it failed", rest.collect())?;
                break;
            }
        }
        Ok(None)
    }

    /// Shows lines of a pasted text that are not evaluated, and keeps them.
    fn leave_out(&mut self, reason: &str, lines: Vec<String>) -> io::Result<()> {
        if lines.is_empty() {
            return Ok(());
        }
        let mut out = io::stdout();
        writeln!(
            out,
            "; Not evaluated, since {reason}; {BRING_BACK} brings it back:"
        )?;
        for line in lines.iter().take(SHOWN_LINES) {
            writeln!(out, ";   {}", visible(line))?;
        }
        if lines.len() > SHOWN_LINES {
            writeln!(out, ";   …")?;
        }
        let before = self.left_out.take().into_iter();
        self.left_out = Some(before.chain(lines).collect::<Vec<_>>().join("\n"));
        Ok(())
    }

    fn was_interrupted(&self) -> bool {
        self.evaluator.borrow().interrupted_at().is_some()
    }

    fn evaluate(&mut self, input: &str, stops: bool) -> Result<Outcome, ReplError> {
        let mut evaluator = self.evaluator.borrow_mut();
        self.keeper.begun(input, stops);
        self.number += 1;
        let name = input_name(self.number);
        evaluator.set_interactive(stops);
        self.is_evaluating.store(true, Ordering::Relaxed);
        let outcome = evaluate_on(&mut self.screen, &mut *evaluator, &name, input);
        self.is_evaluating.store(false, Ordering::Relaxed);
        evaluator.set_interactive(true);
        // What ended because nobody sees its output was not interrupted by the user.
        let outcome = outcome?;
        self.keeper.ended(&*evaluator);
        Ok(outcome)
    }

    /// Evaluates the inputs of an earlier session again without showing their output. Asks
    /// about those that may have ended the program.
    fn resume(&mut self, earlier: &mut Earlier, editor: &mut LineEditor) -> Result<(), ReplError> {
        settle_doubts(earlier, &mut self.keeper, |number, text| {
            writeln!(
                io::stdout(),
                "; Input {number} began, but nothing says that it ended:\n{}",
                excerpt(text)
            )?;
            let again = editor.is_wanted("Evaluate it again? If not, it is left out.");
            Ok(if again { Doubt::Retry } else { Doubt::Skip })
        })?;
        let despite_changes = self.despite_changes;
        let resumed = resume(
            &mut *self.evaluator.borrow_mut(),
            &mut self.keeper,
            earlier,
            &mut self.number,
            io::stdout(),
            true,
            &mut || {
                despite_changes
                    || editor
                        .is_wanted("Go on with the inputs after it? If not, they are left out.")
            },
        )?;
        if let Resumed::UpTo(number) = resumed {
            let evaluator = self.evaluator.borrow();
            let remark = keep_up_to(&*evaluator, &mut self.keeper, earlier, number);
            writeln!(io::stdout(), "{}", visible(&remark))?;
        }
        let mut evaluator = self.evaluator.borrow_mut();
        evaluator.set_interactive(true);
        if evaluator.level() > 0 {
            // An empty input shows again where the evaluation is suspended.
            let name = input_name(self.number);
            evaluate_on(&mut self.screen, &mut *evaluator, &name, "")?;
        }
        Ok(())
    }
}

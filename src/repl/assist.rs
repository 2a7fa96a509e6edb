//! What the line editor asks about the text being typed.

use std::borrow::Cow;
use std::cell::Cell;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use rustyline::completion::Completer;
use rustyline::highlight::{CmdKind, Highlighter};
use rustyline::hint::Hinter;
use rustyline::validate::{ValidationContext, ValidationResult, Validator};
use rustyline::{Cmd, ConditionalEventHandler, Event, EventContext, Helper, RepeatCount, Result};

use super::highlight::highlighted;
use super::indent::indentation;
use super::pasted::Inputs;

/// Tells whether an input is whole, and colours it.
pub(super) struct Assist {
    colored: bool,
    /// The input is being left as it is: nothing stands out at the cursor any more.
    is_settled: Cell<bool>,
}

impl Assist {
    pub(super) fn new(colored: bool) -> Self {
        Assist {
            colored,
            is_settled: Cell::new(false),
        }
    }
}

impl Helper for Assist {}

impl Hinter for Assist {
    type Hint = String;
}

impl Completer for Assist {
    type Candidate = String;
}

impl Validator for Assist {
    fn validate(&self, context: &mut ValidationContext<'_>) -> Result<ValidationResult> {
        Ok(if Inputs::of(context.input()).are_whole() {
            ValidationResult::Valid(None)
        } else {
            ValidationResult::Incomplete
        })
    }
}

impl Highlighter for Assist {
    fn highlight<'l>(&self, line: &'l str, pos: usize) -> Cow<'l, str> {
        if self.colored {
            let cursor = (!self.is_settled.get()).then_some(pos);
            Cow::Owned(highlighted(line, cursor))
        } else {
            Cow::Borrowed(line)
        }
    }

    fn highlight_prompt<'b, 's: 'b, 'p: 'b>(&'s self, prompt: &'p str, _: bool) -> Cow<'b, str> {
        if self.colored {
            Cow::Owned(format!("\x1b[1m{prompt}\x1b[0m"))
        } else {
            Cow::Borrowed(prompt)
        }
    }

    fn highlight_char(&self, _: &str, _: usize, kind: CmdKind) -> bool {
        self.is_settled.set(kind == CmdKind::ForcedRefresh);
        self.colored
    }
}

/// What Enter does: indents the next line of an input that is not whole.
pub(super) struct Enter {
    /// Columns that the prompt takes.
    pub(super) prompt_width: Arc<AtomicUsize>,
}

impl ConditionalEventHandler for Enter {
    fn handle(
        &self,
        _: &Event,
        _: RepeatCount,
        _: bool,
        context: &EventContext<'_>,
    ) -> Option<Cmd> {
        let line = context.line();
        if Inputs::of(line).are_whole() {
            return None;
        }
        let before = line.get(..context.pos())?;
        let width = self.prompt_width.load(Ordering::Relaxed);
        let indent = " ".repeat(indentation(before, width));
        Some(Cmd::Insert(1, format!("\n{indent}")))
    }
}

//! Answers the line editor's questions about the text being typed.

use std::borrow::Cow;
use std::cell::{Cell, RefCell};
use std::rc::Rc;

use rustyline::completion::{Candidate, Completer};
use rustyline::highlight::{CmdKind, Highlighter};
use rustyline::hint::Hinter;
use rustyline::validate::{ValidationContext, ValidationResult, Validator};
use rustyline::{CompletionType, Context, Helper, Result};

use super::highlight::highlighted;
use super::pasted::Inputs;
use super::shape::Shape;
use session::dialogue::Serve;

/// The evaluator, which also knows what could be typed.
pub(crate) type Shared = Rc<RefCell<dyn Serve>>;

/// Width of a terminal that does not tell its own.
const USUAL_COLUMNS: usize = 80;

/// Tells whether an input is complete, colours it and completes it.
pub(crate) struct Assist {
    evaluator: Shared,
    colored: bool,
    /// The input is final: nothing at the cursor is highlighted any more.
    is_settled: Cell<bool>,
    /// Widths of prompt and terminal, in columns.
    widths: Cell<(usize, usize)>,
}

impl Assist {
    pub(crate) fn new(evaluator: Shared, colored: bool) -> Self {
        Assist {
            evaluator,
            colored,
            is_settled: Cell::new(false),
            widths: Cell::new((0, USUAL_COLUMNS)),
        }
    }

    /// Sets the widths of prompt and terminal; `None` if it does not tell its own.
    pub(crate) fn set_widths(&self, prompt: usize, terminal: Option<usize>) {
        self.widths.set((prompt, terminal.unwrap_or(USUAL_COLUMNS)));
    }
}

impl Helper for Assist {}

/// Longer inputs get no hint: it would be too far from the cursor.
const LONGEST_HINTED: usize = 4000;

impl Hinter for Assist {
    type Hint = Shape;

    fn hint(&self, line: &str, pos: usize, _: &Context<'_>) -> Option<Shape> {
        let rest = line.get(pos..)?;
        if line.len() > LONGEST_HINTED || !rest.bytes().all(|b| b == b')') {
            return None;
        }
        let evaluator = self.evaluator.try_borrow().ok()?;
        let hint = evaluator.hint(line, pos)?;
        let (prompt_width, columns) = self.widths.get();
        let column = match line.rsplit_once('\n') {
            Some((_, last)) => last.chars().count(),
            None => prompt_width + line.chars().count(),
        };
        Some(Shape::new(&hint, column, columns))
    }
}

/// A candidate for completion, with a line of documentation.
pub(crate) struct Documented {
    text: String,
    shown: String,
}

/// Width of the list of candidates, in characters.
const LIST_WIDTH: usize = 78;

impl Documented {
    fn new(text: String, doc: &str, name_width: usize) -> Self {
        let shown = if doc.is_empty() {
            text.clone()
        } else {
            let line = format!("{text:<name_width$}  {doc}");
            match line.char_indices().nth(LIST_WIDTH) {
                Some((end, _)) => format!("{}…", line.get(..end).unwrap_or(&line)),
                None => line,
            }
        };
        Documented { text, shown }
    }
}

impl Candidate for Documented {
    fn display(&self) -> &str {
        &self.shown
    }

    fn replacement(&self) -> &str {
        &self.text
    }
}

/// Greatest width of the column of names in the list of candidates.
const MOST_NAME_WIDTH: usize = 30;

impl Completer for Assist {
    type Candidate = Documented;

    fn complete(
        &self,
        line: &str,
        pos: usize,
        _: &Context<'_>,
    ) -> Result<(usize, Vec<Documented>)> {
        let Ok(evaluator) = self.evaluator.try_borrow() else {
            return Ok((pos, Vec::new()));
        };
        let found = evaluator.completions(line, pos);
        let widths = found.candidates.iter().map(|c| c.text.chars().count());
        let width = widths.max().unwrap_or(0).min(MOST_NAME_WIDTH);
        let candidates = found.candidates.into_iter();
        let candidates = candidates.map(|c| Documented::new(c.text, &c.doc, width));
        Ok((found.start, candidates.collect()))
    }
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
        if !self.colored {
            return Cow::Borrowed(line);
        }
        let cursor = (!self.is_settled.get()).then_some(pos);
        let evaluator = self.evaluator.try_borrow().ok();
        let is_type = |name: &str| {
            evaluator
                .as_ref()
                .is_some_and(|evaluator| evaluator.is_designator_type(name))
        };
        Cow::Owned(highlighted(line, cursor, is_type))
    }

    fn highlight_prompt<'b, 's: 'b, 'p: 'b>(&'s self, prompt: &'p str, _: bool) -> Cow<'b, str> {
        if self.colored {
            Cow::Owned(format!("\x1b[1m{prompt}\x1b[0m"))
        } else {
            Cow::Borrowed(prompt)
        }
    }

    fn highlight_hint<'h>(&self, hint: &'h str) -> Cow<'h, str> {
        if self.colored {
            Cow::Owned(format!("\x1b[2m{hint}\x1b[0m"))
        } else {
            Cow::Borrowed(hint)
        }
    }

    fn highlight_candidate<'c>(&self, candidate: &'c str, _: CompletionType) -> Cow<'c, str> {
        match candidate.split_once("  ") {
            Some((name, doc)) if self.colored => {
                Cow::Owned(format!("\x1b[1m{name}\x1b[0m  \x1b[2m{doc}\x1b[0m"))
            }
            _ => Cow::Borrowed(candidate),
        }
    }

    fn highlight_char(&self, _: &str, _: usize, kind: CmdKind) -> bool {
        self.is_settled.set(kind == CmdKind::ForcedRefresh);
        self.colored
    }
}

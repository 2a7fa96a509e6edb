//! Answers the line editor's questions about the text being typed.

use std::borrow::Cow;
use std::cell::{Cell, RefCell};
use std::rc::Rc;

use rustyline::completion::{Candidate, Completer};
use rustyline::highlight::{CmdKind, Highlighter};
use rustyline::hint::{Hint, Hinter};
use rustyline::validate::{ValidationContext, ValidationResult, Validator};
use rustyline::{CompletionType, Context, Helper, Result};

use super::drawing::Drawing;
use super::highlight::highlighted;
use super::layout::{self, Position};
use super::menu::Menu;
use super::open_forms::still_open;
use super::pasted::Inputs;
use super::shape::Shape;
use super::tty;
use super::typed_ahead::LastKey;
use lisp::visible::visible;
use session::dialogue::Serve;

/// The evaluator, which also knows what could be typed.
pub(crate) type Shared = Rc<RefCell<dyn Serve>>;

/// Tells whether an input is complete, colours it and completes it.
pub(crate) struct Assist {
    evaluator: Shared,
    colored: bool,
    /// The input is final: nothing at the cursor is highlighted any more.
    is_settled: Cell<bool>,
    /// What is drawn.
    drawing: Drawing,
    /// Tells when all keys that there are have been read, if they can be collected.
    last_key: Option<LastKey>,
    /// Whether the line editor asks something about the completions.
    menu: Menu,
}

impl Assist {
    pub(super) fn new(
        evaluator: Shared,
        colored: bool,
        drawing: Drawing,
        last_key: Option<LastKey>,
        menu: Menu,
    ) -> Self {
        Assist {
            evaluator,
            colored,
            is_settled: Cell::new(false),
            drawing,
            last_key,
            menu,
        }
    }

    /// The hint behind a text, of which so many bytes are before the cursor.
    fn hint_text(&self, line: &str, pos: usize) -> Option<String> {
        let rest = line.get(pos..)?;
        if line.len() > MAX_HINTED_LENGTH || !rest.bytes().all(|b| b == b')') {
            return None;
        }
        let shape = {
            let evaluator = self.evaluator.try_borrow().ok()?;
            evaluator.hint(line, pos)
        };
        // On a new line nothing shows yet what it is a line of.
        let last = line.rsplit_once('\n').map(|(_, last)| last);
        let open = last.filter(|last| last.trim().is_empty());
        let open = open.and_then(|_| still_open(line));
        match (shape, open) {
            (Some(shape), Some(open)) => Some(format!("{shape} ; {open}")),
            (shape, open) => shape.or(open),
        }
    }
}

impl Helper for Assist {}

/// Longer inputs get no hint: it would be too far from the cursor.
const MAX_HINTED_LENGTH: usize = 4000;

impl Hinter for Assist {
    type Hint = Shape;

    fn hint(&self, line: &str, pos: usize, _: &Context<'_>) -> Option<Shape> {
        if self.last_key.as_ref().is_some_and(LastKey::begins) {
            return None;
        }
        self.drawing.draws(line, pos);
        let hint = self.hint_text(line, pos).map(|hint| {
            let (prompt_width, columns) = (self.drawing.widths().0, tty::columns());
            let begin = match line.rsplit_once('\n') {
                Some((_, last)) => Position::default().after(last, columns),
                None => {
                    let behind_prompt = Position {
                        row: 0,
                        column: prompt_width,
                    };
                    behind_prompt.after(line, columns)
                }
            };
            Shape::new(&visible(&hint), begin.column, columns)
        });
        self.drawing
            .hints(hint.as_ref().map_or("", |hint| hint.display()));
        hint
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
            visible(&text).into_owned()
        } else {
            let (text, doc) = (visible(&text), visible(doc));
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

/// Maximum width of the column of names in the list of candidates.
const MAX_NAME_WIDTH: usize = 30;

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
        let typed = pos.saturating_sub(found.start);
        let texts = found.candidates.iter().map(|c| c.text.as_str());
        let is_at_end = line.get(pos..).is_none_or(str::is_empty);
        self.menu.opens(texts, typed, self.colored && !is_at_end);
        let widths = found.candidates.iter().map(|c| c.text.chars().count());
        let width = widths.max().unwrap_or(0).min(MAX_NAME_WIDTH);
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
        self.menu.draws();
        let (first, columns) = self.drawing.widths();
        let (line, pos) = if line.contains(|c: char| c.is_control() && c != '\n') {
            let (shown, pos) = layout::shown(line, pos, first, columns);
            (Cow::Owned(shown), pos)
        } else {
            (Cow::Borrowed(line), pos)
        };
        if !self.colored {
            return line;
        }
        let cursor = (!self.is_settled.get()).then_some(pos);
        let evaluator = self.evaluator.try_borrow().ok();
        let is_type = |name: &str| {
            evaluator
                .as_ref()
                .is_some_and(|evaluator| evaluator.is_designator_type(name))
        };
        Cow::Owned(highlighted(&line, cursor, is_type))
    }

    fn highlight_prompt<'b, 's: 'b, 'p: 'b>(&'s self, prompt: &'p str, _: bool) -> Cow<'b, str> {
        if let Some(last_key) = &self.last_key {
            last_key.draws_prompt();
        }
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
        if kind != CmdKind::Other && (self.colored || kind == CmdKind::ForcedRefresh) {
            // The line is drawn without its hint.
            self.drawing.hints("");
        }
        self.colored
    }
}

//! Key bindings that the line editor does not have itself.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use rustyline::{Cmd, ConditionalEventHandler, Event, EventContext, Movement, RepeatCount};

use super::drawing::Drawing;
use super::indent::indentation;
use super::pasted::Inputs;
#[cfg(unix)]
use super::tty::Modes;
use session::dialogue::ends_in_quotes;

/// A line break with the indentation of the next line.
fn line_break(context: &EventContext<'_>, drawing: &Drawing) -> Option<Cmd> {
    let before = context.line().get(..context.pos())?;
    let (width, _) = drawing.widths();
    let indent = " ".repeat(indentation(before, width));
    Some(Cmd::Insert(1, format!("\n{indent}")))
}

/// Enter: evaluates a complete input, breaks the line of any other.
pub(crate) struct Enter {
    pub(super) drawing: Drawing,
    /// Set by an interrupt. What came before Enter concerns nothing that is evaluated.
    pub(super) interrupt: Arc<AtomicBool>,
}

impl ConditionalEventHandler for Enter {
    fn handle(
        &self,
        _: &Event,
        _: RepeatCount,
        _: bool,
        context: &EventContext<'_>,
    ) -> Option<Cmd> {
        if Inputs::of(context.line()).are_whole() {
            self.interrupt.store(false, Ordering::Relaxed);
            return None;
        }
        line_break(context, &self.drawing)
    }
}

/// Ctrl-J: breaks the line even if the input is complete.
///
/// While a form is evaluated, the terminal turns Enter into the same character: if it arrives
/// right after the prompt, it was typed ahead and means Enter.
pub(crate) struct NewLine {
    pub(super) drawing: Drawing,
    /// When the prompt was shown.
    pub(crate) shown: Arc<Mutex<Instant>>,
}

/// A key that arrives sooner after the prompt was typed ahead.
const TYPED_AHEAD: Duration = Duration::from_millis(120);

impl ConditionalEventHandler for NewLine {
    fn handle(
        &self,
        _: &Event,
        _: RepeatCount,
        _: bool,
        context: &EventContext<'_>,
    ) -> Option<Cmd> {
        let shown = *self.shown.lock().unwrap_or_else(PoisonError::into_inner);
        if shown.elapsed() < TYPED_AHEAD && Inputs::of(context.line()).are_whole() {
            return Some(Cmd::AcceptLine);
        }
        line_break(context, &self.drawing)
    }
}

/// Tab: with nothing but blanks before it, it indents the line; elsewhere it completes. So text that
/// is sent to the terminal as if it were typed keeps its meaning.
pub(crate) struct Tab {
    pub(super) drawing: Drawing,
}

impl ConditionalEventHandler for Tab {
    fn handle(
        &self,
        _: &Event,
        _: RepeatCount,
        _: bool,
        context: &EventContext<'_>,
    ) -> Option<Cmd> {
        let before = context.line().get(..context.pos())?;
        let (above, blanks) = match before.rfind('\n') {
            Some(at) => before.split_at_checked(at)?,
            None => ("", before),
        };
        let blanks = blanks.trim_start_matches('\n');
        if ends_in_quotes(before) {
            return Some(Cmd::Insert(1, "\t".to_owned()));
        }
        if !blanks.trim().is_empty() {
            return None;
        }
        let wanted = indentation(above, self.drawing.widths().0);
        let count = blanks.chars().count();
        Some(if blanks == " ".repeat(wanted) {
            Cmd::Noop
        } else if count == 0 {
            Cmd::Insert(1, " ".repeat(wanted))
        } else {
            let before = RepeatCount::try_from(count).unwrap_or(RepeatCount::MAX);
            Cmd::Replace(Movement::BackwardChar(before), Some(" ".repeat(wanted)))
        })
    }
}

/// Ctrl-Z: stops the process until somebody wants it to go on.
#[cfg(unix)]
pub(super) struct Suspend {
    pub(super) modes: Modes,
    pub(super) drawing: Drawing,
}

#[cfg(unix)]
impl ConditionalEventHandler for Suspend {
    fn handle(
        &self,
        _: &Event,
        _: RepeatCount,
        _: bool,
        context: &EventContext<'_>,
    ) -> Option<Cmd> {
        self.drawing.leaves(context.pos());
        // If the modes cannot be set, the terminal is gone, which reading the next key tells.
        let _ = self.modes.suspend();
        self.drawing.moves_down(context.pos());
        Some(Cmd::Repaint)
    }
}

/// The inputs of this and earlier sessions, shared with the key handlers.
pub(crate) type SharedHistory = Arc<Mutex<Vec<String>>>;

/// Up and Down: within an input of several lines they move between its lines; otherwise they go
/// through earlier inputs, either those that begin with the text before the cursor or all of
/// them.
pub(crate) struct UpOrDown {
    /// Whether this is Up rather than Down.
    pub(crate) is_up: bool,
    /// All inputs.
    pub(crate) history: SharedHistory,
}

impl UpOrDown {
    fn is_old_input(&self, text: &str) -> bool {
        let history = self.history.lock().unwrap_or_else(PoisonError::into_inner);
        history.iter().any(|entry| entry == text)
    }
}

impl ConditionalEventHandler for UpOrDown {
    fn handle(
        &self,
        _: &Event,
        count: RepeatCount,
        _: bool,
        context: &EventContext<'_>,
    ) -> Option<Cmd> {
        let (line, at) = (context.line(), context.pos());
        let (before, after) = (line.get(..at)?, line.get(at..)?);
        let on_edge = if self.is_up {
            !before.contains('\n')
        } else {
            !after.contains('\n')
        };
        // An earlier input that was fetched whole is not a prefix to search for.
        let is_whole_entry = after.is_empty() && self.is_old_input(line);
        Some(
            match (on_edge && !before.is_empty() && !is_whole_entry, self.is_up) {
                (true, true) => Cmd::HistorySearchBackward,
                (true, false) => Cmd::HistorySearchForward,
                (false, true) if is_whole_entry => Cmd::PreviousHistory,
                (false, false) if is_whole_entry => Cmd::NextHistory,
                (false, true) => Cmd::LineUpOrPreviousHistory(count),
                (false, false) => Cmd::LineDownOrNextHistory(count),
            },
        )
    }
}

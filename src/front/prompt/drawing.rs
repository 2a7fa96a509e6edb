//! What the line editor has drawn, so that it can be drawn again where the terminal has changed
//! under it.

use std::io::{self, Write};
use std::sync::{Arc, Mutex, PoisonError};

use super::layout::Position;
use super::tty;

/// What stands on the screen: prompt, text, hint.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Drawn {
    prompt: String,
    text: String,
    hint: String,
    /// Byte of the text at which the cursor is.
    at: usize,
    /// The width of the terminal for which it was drawn.
    columns: usize,
}

impl Drawn {
    fn cursor(&self, columns: usize) -> Position {
        let begin = Position::default().after(&self.prompt, columns);
        begin.after(self.text.get(..self.at).unwrap_or(&self.text), columns)
    }

    fn end(&self, columns: usize) -> Position {
        let begin = Position::default().after(&self.prompt, columns);
        begin.after(&format!("{}{}", self.text, self.hint), columns)
    }

    /// What has to be written before the line editor draws anew in a terminal that has changed its
    /// width. The editor clears the rows that the text had in the old width, counted from the row
    /// at which the cursor was then; the terminal may have moved both.
    fn correction(&self, columns: usize, reflows: bool) -> String {
        let (cursor, end) = (self.cursor(self.columns), self.end(self.columns));
        let above = if reflows {
            self.cursor(columns).row
        } else {
            cursor.row
        };
        let mut codes = String::from("\r");
        if above > 0 {
            codes.push_str(&format!("\x1b[{above}A"));
        }
        codes.push_str("\x1b[J");
        codes.push_str(&Drawn::room(cursor, end));
        codes
    }

    /// Makes room below for what the line editor takes for what it has drawn, and puts the cursor
    /// where it takes it to be.
    fn room(cursor: Position, end: Position) -> String {
        let mut codes = "\n".repeat(end.row);
        let below = end.row.saturating_sub(cursor.row);
        if below > 0 {
            codes.push_str(&format!("\x1b[{below}A"));
        }
        codes
    }
}

/// What is drawn, shared with those who answer keys.
#[derive(Clone, Default)]
pub(super) struct Drawing(Arc<Mutex<Drawn>>);

impl Drawing {
    fn with<T>(&self, look: impl FnOnce(&mut Drawn) -> T) -> T {
        look(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// A prompt is shown, without a text.
    pub(super) fn begin(&self, prompt: &str) {
        self.with(|drawn| {
            *drawn = Drawn {
                prompt: prompt.to_owned(),
                columns: tty::columns(),
                ..Drawn::default()
            };
        });
    }

    /// Width of prompt and terminal.
    pub(super) fn widths(&self) -> (usize, usize) {
        self.with(|drawn| (drawn.prompt.chars().count(), drawn.columns))
    }

    /// A text is going to be drawn. If that is because the terminal has changed its width, what is wrong
    /// on the screen is corrected first.
    pub(super) fn draws(&self, text: &str, at: usize) {
        let columns = tty::columns();
        let correction = self.with(|drawn| {
            let is_known = drawn.columns > 0;
            let correction = if is_known && drawn.text == text && drawn.columns != columns {
                drawn.at = at;
                let correction = drawn.correction(columns, tty::reflows());
                drawn.columns = columns;
                Some(correction)
            } else {
                None
            };
            text.clone_into(&mut drawn.text);
            drawn.at = at;
            correction
        });
        if let Some(correction) = correction {
            write(&correction);
        }
    }

    /// This hint is shown behind the text.
    pub(super) fn hints(&self, hint: &str) {
        self.with(|drawn| hint.clone_into(&mut drawn.hint));
    }

    /// The terminal's cursor is on a line of its own below whatever others have written: the line
    /// editor can draw there.
    pub(super) fn moves_down(&self, at: usize) {
        let codes = self.with(|drawn| {
            drawn.at = at;
            Drawn::room(drawn.cursor(drawn.columns), drawn.end(drawn.columns))
        });
        write(&format!("\r{codes}"));
    }

    /// Moves the cursor below all that is drawn.
    pub(super) fn leaves(&self, at: usize) {
        let below = self.with(|drawn| {
            drawn.at = at;
            let end = drawn.end(drawn.columns);
            end.row.saturating_sub(drawn.cursor(drawn.columns).row)
        });
        write(&"\n".repeat(below + 1));
    }
}

/// Writes codes to the terminal. If it is gone, so is the line editor.
fn write(codes: &str) {
    let mut out = io::stdout();
    let _ = out.write_all(codes.as_bytes()).and_then(|()| out.flush());
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(text: &str, columns: usize) -> Drawn {
        Drawn {
            prompt: "A> ".to_owned(),
            text: text.to_owned(),
            hint: String::new(),
            at: text.len(),
            columns,
        }
    }

    #[test]
    fn rows_that_a_narrower_terminal_adds_are_cleared() {
        // Three rows in twenty columns where it was one row in eighty.
        let line = drawn(&"x".repeat(50), 80);
        assert_eq!(line.correction(20, true), "\r\x1b[2A\x1b[J");
        assert_eq!(line.correction(20, false), "\r\x1b[J");
    }

    #[test]
    fn the_editor_finds_the_rows_that_it_assumes() {
        // Two rows in twenty columns become one; the editor goes down and up by what it knows.
        let mut line = drawn(&"x".repeat(50), 20);
        assert_eq!(line.correction(80, true), "\r\x1b[J\n\n");
        line.at = 0;
        assert_eq!(line.correction(80, true), "\r\x1b[J\n\n\x1b[2A");
    }

    #[test]
    fn a_hint_takes_room_too() {
        let mut line = drawn("abc", 80);
        line.hint = "\n  ; more".to_owned();
        assert_eq!(line.correction(70, true), "\r\x1b[J\n\x1b[1A");
    }
}

//! What a program has written.

/// Standard output: text in order, and the column where the next character goes.
#[derive(Default)]
pub struct Output {
    text: String,
    /// Where in the text its pieces begin, but for the first, and whether each is about errors.
    cuts: Vec<(usize, bool)>,
    /// Are errors shown apart?
    has_errors_apart: bool,
    column: usize,
    /// Is there somebody who shows what is written, line by line?
    is_shown: bool,
    /// Is there a whole line, or what the program wants to be seen?
    is_due: bool,
    /// What is going on, in place of which what is written is dropped.
    instead: Option<String>,
}

impl Output {
    /// The same at the same column, if nobody has to be shown anything.
    pub(super) fn copied(&self) -> Option<Output> {
        let is_idle = self.text.is_empty() && self.instead.is_none();
        is_idle.then(|| Output {
            column: self.column,
            is_shown: self.is_shown,
            has_errors_apart: self.has_errors_apart,
            ..Output::default()
        })
    }

    /// Writes a text.
    pub fn write(&mut self, text: &str) {
        if self.instead.is_some() {
            return;
        }
        match text.rfind('\n') {
            Some(i) => {
                self.column = text[i + 1..].chars().count();
                self.is_due = true;
            }
            None => self.column += text.chars().count(),
        }
        self.text.push_str(text);
    }

    /// Starts a new line unless at the start of one.
    pub fn fresh_line(&mut self) {
        if self.column > 0 {
            self.write("\n");
        }
    }

    /// Records that what is written next starts a line.
    pub fn begin_line(&mut self) {
        self.column = 0;
    }

    /// Number of characters on the current line.
    pub fn column(&self) -> usize {
        self.column
    }

    /// What has been written and has not been taken.
    pub fn pending(&self) -> &str {
        &self.text
    }

    /// If something is given, what is written from now on is dropped, and that is what is going on
    /// instead; returns what was given before.
    pub fn mute(&mut self, instead: Option<String>) -> Option<String> {
        std::mem::replace(&mut self.instead, instead)
    }

    /// What is going on while what is written is dropped.
    pub fn instead(&self) -> Option<&str> {
        self.instead.as_deref()
    }

    /// Sets whether somebody shows what is written as soon as it is due.
    pub fn set_shown(&mut self, is_shown: bool) -> bool {
        std::mem::replace(&mut self.is_shown, is_shown)
    }

    /// What has been written is to be shown now.
    pub fn finish(&mut self) {
        self.is_due = !self.text.is_empty();
    }

    /// Has somebody to show now what has been written?
    #[inline]
    pub fn is_due(&self) -> bool {
        self.is_due && self.is_shown
    }

    /// What is written next begins a piece of its own, as messages of a log do.
    pub fn begin_piece(&mut self) {
        self.cut(false);
    }

    fn cut(&mut self, is_error: bool) {
        if self.instead.is_some() {
            return;
        }
        let at = self.text.len();
        match self.cuts.last_mut() {
            Some((last, is_about)) if *last == at => *is_about = is_error,
            _ => self.cuts.push((at, is_error)),
        }
    }

    /// Writes a text about errors.
    pub(crate) fn write_error(&mut self, text: &str) {
        self.cut(true);
        self.write(text);
        self.cut(false);
    }

    /// Sets whether who shows the output shows errors apart.
    pub fn set_errors_apart(&mut self, is_apart: bool) {
        self.has_errors_apart = is_apart;
    }

    /// Are errors shown apart?
    pub fn has_errors_apart(&self) -> bool {
        self.has_errors_apart
    }

    /// Takes what was written.
    pub fn take(&mut self) -> String {
        self.is_due = false;
        self.cuts.clear();
        std::mem::take(&mut self.text)
    }

    /// Takes what was written, in its pieces, and whether each is about errors.
    pub fn take_pieces(&mut self) -> Vec<(String, bool)> {
        let cuts = std::mem::take(&mut self.cuts);
        let text = self.take();
        let mut pieces = Vec::new();
        let mut begin = (0, false);
        for next in cuts.into_iter().chain([(text.len(), false)]) {
            let piece = text.get(begin.0..next.0).unwrap_or_default();
            if !piece.is_empty() {
                pieces.push((piece.to_owned(), begin.1));
            }
            begin = next;
        }
        pieces
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_begin_where_they_are_said_to() {
        let mut output = Output::default();
        output.begin_piece();
        output.write("a");
        output.begin_piece();
        output.begin_piece();
        output.write("b\nc\n");
        output.begin_piece();
        let piece = |text: &str, is_error| (text.to_owned(), is_error);
        let pieces = [piece("a", false), piece("b\nc\n", false)];
        assert_eq!(output.take_pieces(), pieces);
        output.write("d");
        output.write_error("e");
        output.write_error("f");
        output.write("g");
        let pieces = [
            piece("d", false),
            piece("e", true),
            piece("f", true),
            piece("g", false),
        ];
        assert_eq!(output.take_pieces(), pieces);
    }

    #[test]
    fn what_is_muted_is_dropped() {
        let mut output = Output::default();
        output.write("a");
        assert_eq!(output.mute(Some("counting".to_owned())), None);
        output.write("b\n");
        assert_eq!(output.instead(), Some("counting"));
        assert_eq!(output.mute(None).as_deref(), Some("counting"));
        output.write("c");
        assert_eq!(output.column(), 2);
        assert_eq!(output.take(), "ac");
    }
}

//! What a program has written.

/// Standard output: text in order, and the column where the next character goes.
#[derive(Default)]
pub struct Output {
    text: String,
    /// Where in the text its pieces begin, but for the first.
    cuts: Vec<usize>,
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
        if self.instead.is_none() && self.cuts.last().is_none_or(|cut| *cut < self.text.len()) {
            self.cuts.push(self.text.len());
        }
    }

    /// Takes what was written.
    pub fn take(&mut self) -> String {
        self.is_due = false;
        self.cuts.clear();
        std::mem::take(&mut self.text)
    }

    /// Takes what was written, and where in it its pieces begin, but for the first.
    pub fn take_with_cuts(&mut self) -> (String, Vec<usize>) {
        let cuts = std::mem::take(&mut self.cuts);
        (self.take(), cuts)
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
        assert_eq!(
            output.take_with_cuts(),
            ("ab\nc\n".to_owned(), vec![0, 1, 5])
        );
        output.write("d");
        assert_eq!(output.take_with_cuts(), ("d".to_owned(), vec![]));
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

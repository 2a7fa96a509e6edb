//! What a program has written.

/// Standard output: text in order, and the column where the next character goes.
#[derive(Default)]
pub(crate) struct Output {
    text: String,
    column: usize,
}

impl Output {
    /// Writes a text.
    pub(crate) fn write(&mut self, text: &str) {
        match text.rfind('\n') {
            Some(i) => self.column = text[i + 1..].chars().count(),
            None => self.column += text.chars().count(),
        }
        self.text.push_str(text);
    }

    /// Starts a new line unless at the start of one.
    pub(crate) fn fresh_line(&mut self) {
        if self.column > 0 {
            self.write("\n");
        }
    }

    /// Records that what is written next starts a line.
    pub(crate) fn begin_line(&mut self) {
        self.column = 0;
    }

    /// Number of characters on the current line.
    pub(crate) fn column(&self) -> usize {
        self.column
    }

    /// Takes what was written.
    pub(crate) fn take(&mut self) -> String {
        std::mem::take(&mut self.text)
    }
}

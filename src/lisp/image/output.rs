//! What a program has written.

/// Standard output: text in order, and the column where the next character goes.
#[derive(Default)]
pub(crate) struct Output {
    text: String,
    column: usize,
    /// Is there somebody who shows what is written, line by line?
    is_shown: bool,
    /// Is there a whole line, or what the program wants to be seen?
    is_due: bool,
    /// Is what is written dropped?
    is_muted: bool,
}

impl Output {
    /// Writes a text.
    pub(crate) fn write(&mut self, text: &str) {
        if self.is_muted {
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

    /// Number of bytes that have been written and not been taken.
    pub(crate) fn len(&self) -> usize {
        self.text.len()
    }

    /// What has been written and has not been taken.
    pub(crate) fn pending(&self) -> &str {
        &self.text
    }

    /// What has been written since there were so many bytes, if nothing has been taken since.
    pub(crate) fn written_since(&self, len: usize) -> Option<&str> {
        self.text.get(len..)
    }

    /// Sets whether what is written from now on is dropped; returns whether it was.
    pub(crate) fn set_muted(&mut self, is_muted: bool) -> bool {
        std::mem::replace(&mut self.is_muted, is_muted)
    }

    /// Sets whether somebody shows what is written as soon as it is due.
    pub(crate) fn set_shown(&mut self, is_shown: bool) -> bool {
        std::mem::replace(&mut self.is_shown, is_shown)
    }

    /// What has been written is to be shown now.
    pub(crate) fn finish(&mut self) {
        self.is_due = !self.text.is_empty();
    }

    /// Has somebody to show now what has been written?
    #[inline]
    pub(crate) fn is_due(&self) -> bool {
        self.is_due && self.is_shown
    }

    /// Takes what was written.
    pub(crate) fn take(&mut self) -> String {
        self.is_due = false;
        std::mem::take(&mut self.text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_muted_is_dropped() {
        let mut output = Output::default();
        output.write("a");
        assert!(!output.set_muted(true));
        output.write("b\n");
        assert!(output.set_muted(false));
        output.write("c");
        assert_eq!(output.column(), 2);
        assert_eq!(output.take(), "ac");
    }
}

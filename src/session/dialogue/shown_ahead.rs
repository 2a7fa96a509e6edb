//! Output that a person has seen with a question, before it is reported.

use std::cell::Cell;

/// How much of the output that comes next has been seen.
#[derive(Default)]
pub struct ShownAhead(Cell<usize>);

impl ShownAhead {
    /// Nothing has been seen of what comes next.
    pub fn reset(&self) {
        self.0.set(0);
    }

    /// The unseen part of what a program has written and was not reported; it is seen from now on.
    pub fn show<'t>(&self, written: &'t str) -> &'t str {
        let seen = self.0.replace(written.len());
        written.get(seen..).unwrap_or_default()
    }

    /// The unseen part of an output that is reported.
    pub fn unseen<'t>(&self, output: &'t str) -> &'t str {
        let seen = self.0.take();
        let now = seen.min(output.len());
        self.0.set(seen - now);
        output.get(now..).unwrap_or(output)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_seen_with_a_question_is_not_shown_again() {
        let ahead = ShownAhead::default();
        assert_eq!(ahead.show("a\nName? "), "a\nName? ");
        assert_eq!(ahead.show("a\nName? Age? "), "Age? ");
        assert_eq!(ahead.unseen("a\n"), "");
        assert_eq!(ahead.unseen("Name? Age? thanks\n"), "thanks\n");
        assert_eq!(ahead.unseen("more"), "more");
        ahead.show("seen");
        ahead.reset();
        assert_eq!(ahead.unseen("seen"), "seen");
    }
}

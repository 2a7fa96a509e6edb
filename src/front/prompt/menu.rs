//! The questions that the line editor asks when there are many completions: whether to list them
//! all, and whether to go on with the next page. It takes no other keys then than answers.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use rustyline::{Cmd, ConditionalEventHandler, Event, EventContext, Movement, RepeatCount};

/// Number of candidates that are listed without asking.
pub(super) const LISTED_CANDIDATES: usize = 60;

/// Whether a question may be on the screen: the number of times that the line is drawn before it is
/// over, plus one.
#[derive(Clone, Default)]
pub(super) struct Menu(Arc<AtomicUsize>);

impl Menu {
    /// Candidates have been found for the last so many bytes before the cursor.
    pub(super) fn opens<'a>(
        &self,
        candidates: impl Iterator<Item = &'a str> + Clone,
        typed: usize,
        moves_to_end: bool,
    ) {
        let count = candidates.clone().count();
        let common = common_prefix(candidates);
        let draws = usize::from(common > typed) + usize::from(moves_to_end);
        self.0
            .store(if count > 1 { draws + 1 } else { 0 }, Ordering::Relaxed);
    }

    /// The line is drawn.
    pub(super) fn draws(&self) {
        let left = self.0.load(Ordering::Relaxed);
        self.0.store(left.saturating_sub(1), Ordering::Relaxed);
    }

    fn is_open(&self) -> bool {
        self.0.load(Ordering::Relaxed) > 0
    }
}

/// Length of what all texts begin with, in bytes.
fn common_prefix<'a>(mut texts: impl Iterator<Item = &'a str>) -> usize {
    let Some(first) = texts.next() else {
        return 0;
    };
    texts.fold(first.len(), |common, text| {
        let same = first.bytes().zip(text.bytes()).take_while(|(a, b)| a == b);
        common.min(same.count())
    })
}

/// Ctrl-C: leaves a question about completions.
pub(super) struct Leave(pub(super) Menu);

impl ConditionalEventHandler for Leave {
    fn handle(&self, _: &Event, _: RepeatCount, _: bool, _: &EventContext<'_>) -> Option<Cmd> {
        // What Backspace means, which is an answer, too.
        let no = Cmd::Kill(Movement::BackwardChar(1));
        self.0.is_open().then_some(no)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_question_is_over_when_the_line_is_drawn_again() {
        let many: Vec<String> = (0..100).map(|n| format!("ab{n:03}")).collect();
        let menu = Menu::default();
        menu.opens(many.iter().map(String::as_str), 2, false);
        // What all have in common is inserted before the question.
        menu.draws();
        assert!(menu.is_open());
        menu.draws();
        assert!(!menu.is_open());
        menu.opens(many.iter().map(String::as_str), 3, false);
        assert!(menu.is_open());
        menu.draws();
        assert!(!menu.is_open());
        menu.opens(["ab"].into_iter(), 1, false);
        assert!(!menu.is_open());
    }
}

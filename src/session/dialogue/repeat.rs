//! What it takes to repeat a session: not only its inputs, but also where the person in front
//! of it decided something.

use super::evaluate::Evaluate;

/// An evaluator whose sessions can be repeated.
pub trait Repeat: Evaluate {
    /// Sets whether an unhandled condition or an interrupt stops the evaluation where it is,
    /// so that the next input says how to continue; by default, both end it.
    fn set_interactive(&mut self, is_interactive: bool);

    /// Where the last input was interrupted, if it was; used to repeat that in another session.
    fn interrupted_at(&self) -> Option<u64>;

    /// Makes the next input be interrupted there.
    fn interrupt_next_at(&mut self, at: u64);
}

/// What precedes the place of an interrupt in a transcript.
const MARK: &str = " ; Ctrl-C at poll ";

/// An input that was interrupted, as it is written in a transcript.
pub(crate) fn with_interrupt(input: &str, at: u64) -> String {
    format!("{input}{MARK}{at}")
}

/// An input of a transcript and where it was interrupted, if it was.
pub fn split_interrupt(input: &str) -> (&str, Option<u64>) {
    let split = input.trim_end().rsplit_once(MARK);
    let found = split.and_then(|(input, at)| Some((input, at.parse().ok()?)));
    found.map_or((input, None), |(input, at)| (input, Some(at)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_interrupt_is_read_as_it_was_written() {
        let written = with_interrupt("(loop) ; for ever", 12);
        assert_eq!(split_interrupt(&written), ("(loop) ; for ever", Some(12)));
        assert_eq!(split_interrupt("(f 1)"), ("(f 1)", None));
        assert_eq!(
            split_interrupt("(f) ; Ctrl-C at poll no"),
            ("(f) ; Ctrl-C at poll no", None)
        );
    }
}

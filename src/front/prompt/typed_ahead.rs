//! What is typed or pasted while nobody reads: while a form is evaluated, and between Enter and its
//! evaluation. The line editor keeps some of it to itself; it is asked for that by reading keys until
//! there are none, without drawing anything.

use std::cell::{Cell, RefCell};
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use rustyline::{
    Cmd, ConditionalEventHandler, Event, EventContext, ExternalPrinter, KeyCode, KeyEvent,
    Modifiers, RepeatCount,
};

use session::dialogue::GrowingInput;
use session::dialogue::prompt_line::prompt_line;

/// Ctrl-C among what was typed.
pub(super) const CTRL_C: char = '\x03';
/// Ctrl-D among what was typed.
pub(super) const CTRL_D: char = '\x04';

/// Keys that are collected rather than obeyed.
#[derive(Clone, Default)]
pub(super) struct Collector {
    is_on: Arc<AtomicBool>,
    keys: Arc<Mutex<String>>,
}

impl Collector {
    /// Collects keys from now on, or no longer.
    pub(super) fn set(&self, is_on: bool) {
        self.is_on.store(is_on, Ordering::Relaxed);
    }

    /// Whether keys are collected.
    pub(super) fn is_on(&self) -> bool {
        self.is_on.load(Ordering::Relaxed)
    }

    /// What was collected.
    pub(super) fn take(&self) -> String {
        std::mem::take(&mut *self.keys.lock().unwrap_or_else(PoisonError::into_inner))
    }

    fn collect(&self, event: &Event) {
        let mut keys = self.keys.lock().unwrap_or_else(PoisonError::into_inner);
        let Event::KeySeq(pressed) = event else {
            return;
        };
        for key in pressed {
            match *key {
                KeyEvent(KeyCode::Char(c), Modifiers::NONE) => keys.push(c),
                KeyEvent(KeyCode::Enter, _) | KeyEvent(KeyCode::Char('J'), Modifiers::CTRL) => {
                    keys.push('\n');
                }
                KeyEvent(KeyCode::Tab, _) => keys.push('\t'),
                KeyEvent(KeyCode::Backspace, Modifiers::NONE) if !keys.ends_with('\n') => {
                    keys.pop();
                }
                KeyEvent(KeyCode::Char('C'), Modifiers::CTRL) => keys.push(CTRL_C),
                // The terminal keeps the end of input as a null character.
                KeyEvent(KeyCode::Char('D' | '@'), Modifiers::CTRL) => keys.push(CTRL_D),
                KeyEvent(KeyCode::Char('U'), Modifiers::CTRL) => {
                    let line = keys.rfind('\n').map_or(0, |at| at + 1);
                    keys.truncate(line);
                }
                _ => {}
            }
        }
    }
}

/// Answers keys, unless they are collected.
pub(super) struct Collecting<H> {
    pub(super) collector: Collector,
    pub(super) otherwise: H,
}

impl<H: ConditionalEventHandler> ConditionalEventHandler for Collecting<H> {
    fn handle(
        &self,
        event: &Event,
        count: RepeatCount,
        positive: bool,
        context: &EventContext<'_>,
    ) -> Option<Cmd> {
        if self.collector.is_on() {
            self.collector.collect(event);
            return Some(Cmd::Noop);
        }
        self.otherwise.handle(event, count, positive, context)
    }
}

/// Leaves keys to the line editor.
pub(super) struct Usual;

impl ConditionalEventHandler for Usual {
    fn handle(&self, _: &Event, _: RepeatCount, _: bool, _: &EventContext<'_>) -> Option<Cmd> {
        None
    }
}

/// A message that shows nothing: it has to end its line, so it goes one up first.
const NOTHING: &str = "\x1b[A\n";

/// The end of all keys there are: what unwinds the line editor.
pub(super) struct Over;

/// Finds out when there are no more keys: the line editor shows a message only then.
pub(super) struct LastKey {
    collector: Collector,
    printer: RefCell<Box<dyn ExternalPrinter>>,
    /// Whether the line is drawn for the line editor's own reasons.
    is_drawing: Cell<bool>,
}

impl LastKey {
    pub(super) fn new(collector: Collector, printer: Box<dyn ExternalPrinter>) -> LastKey {
        LastKey {
            collector,
            printer: RefCell::new(printer),
            is_drawing: Cell::new(false),
        }
    }

    /// The line editor begins to read; returns whether keys are collected.
    pub(super) fn begins(&self) -> bool {
        if !self.collector.is_on() {
            return false;
        }
        self.is_drawing.set(true);
        // If that fails, the terminal is gone, which reading a key will tell.
        let _ = self.printer.borrow_mut().print(NOTHING.to_owned());
        true
    }

    /// The line editor shows its prompt. If it does so for the message, all keys were collected.
    pub(super) fn draws_prompt(&self) {
        if self.collector.is_on() && !self.is_drawing.replace(false) {
            resume_unwind(Box::new(Over));
        }
    }
}

/// What was typed ahead, in the order in which it is to be taken.
#[derive(Default)]
pub(super) struct TypedAhead(String);

/// The next thing that was typed ahead.
#[derive(PartialEq, Eq, Debug)]
pub(super) enum Ahead {
    /// An input, or a pasted text.
    Input(String),
    /// The beginning of an input.
    Draft(String),
    /// Ctrl-D.
    End,
    Nothing,
}

impl TypedAhead {
    /// Adds what was typed later. A Ctrl-C discards all before it, as terminals do; returns whether
    /// there was one.
    pub(super) fn add(&mut self, typed: &str) -> bool {
        match typed.rsplit_once(CTRL_C) {
            Some((_, rest)) => {
                rest.clone_into(&mut self.0);
                true
            }
            None => {
                self.0.push_str(typed);
                false
            }
        }
    }

    /// Whether a line has been typed.
    pub(super) fn has_line(&self) -> bool {
        self.0.contains('\n')
    }

    /// The lines that follow an input that was pasted without brackets, if it was: one with a prompt,
    /// which nobody types.
    pub(super) fn rest_of(&mut self, input: &str) -> Option<String> {
        let is_copied = input
            .lines()
            .any(|line| prompt_line(line.trim_start()).is_some());
        let end = self.0.rfind('\n').filter(|_| is_copied)?;
        let lines: String = self.0.drain(..=end).filter(|c| *c != CTRL_D).collect();
        Some(lines.trim_end().to_owned())
    }

    /// Takes the next input. Lines that are no whole form go on with those after them. Lines with
    /// prompts among them were copied from a session, and are one text.
    pub(super) fn next(&mut self) -> Ahead {
        let text = std::mem::take(&mut self.0);
        let text = text.trim_start_matches('\n');
        if text.is_empty() {
            return Ahead::Nothing;
        }
        if let Some(rest) = text.strip_prefix(CTRL_D) {
            rest.clone_into(&mut self.0);
            return Ahead::End;
        }
        let end = text.find(CTRL_D).unwrap_or(text.len());
        let (typed, rest) = text.split_at_checked(end).unwrap_or((text, ""));
        let lines = typed.rfind('\n').map_or(0, |at| at + 1);
        let (lines, begun) = typed.split_at_checked(lines).unwrap_or((typed, ""));
        let input = if lines.lines().any(|line| prompt_line(line).is_some()) {
            Some(lines)
        } else {
            let ends = lines.match_indices('\n').map(|(at, _)| at + 1);
            let mut chunks = ends.filter_map(|end| lines.get(..end));
            let mut input = GrowingInput::default();
            chunks.find(|chunk| input.is_whole(chunk))
        };
        match input {
            Some(input) => {
                self.0 = text.get(input.len()..).unwrap_or_default().to_owned();
                Ahead::Input(input.trim_end_matches('\n').to_owned())
            }
            None => {
                rest.clone_into(&mut self.0);
                Ahead::Draft(format!("{lines}{begun}"))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(typed: &str) -> Vec<Ahead> {
        let mut ahead = TypedAhead::default();
        ahead.add(typed);
        let mut found = Vec::new();
        loop {
            match ahead.next() {
                Ahead::Nothing => return found,
                next => found.push(next),
            }
        }
    }

    fn input(text: &str) -> Ahead {
        Ahead::Input(text.to_owned())
    }

    #[test]
    fn each_whole_line_is_an_input() {
        assert_eq!(all("q\n(a)\n\n2\n"), [input("q"), input("(a)"), input("2")]);
        assert_eq!(all(""), []);
    }

    #[test]
    fn a_form_of_several_lines_is_one_input() {
        assert_eq!(all("(a\n  1)\n(b)\n"), [input("(a\n  1)"), input("(b)")]);
        assert_eq!(all("(a \"x\n1\n\")\n"), [input("(a \"x\n1\n\")")]);
    }

    #[test]
    fn a_copied_session_is_one_input() {
        let session = "A> (list b\n  1)\n(NIL 1)\n\nA> (+ 1 2)\n3";
        assert_eq!(all(&format!("{session}\n")), [input(session)]);
    }

    #[test]
    fn what_is_not_finished_is_offered_for_editing() {
        assert_eq!(
            all("(a)\n(b\n c"),
            [input("(a)"), Ahead::Draft("(b\n c".to_owned())]
        );
        assert_eq!(all("(b"), [Ahead::Draft("(b".to_owned())]);
    }

    #[test]
    fn a_copied_session_that_is_typed_is_one_input_too() {
        let mut ahead = TypedAhead::default();
        ahead.add("(NIL 1)\n\nA> (+ 1 2)\n3\n(b");
        assert_eq!(ahead.rest_of("(list b)"), None);
        let rest = ahead.rest_of("A> (list b\n  1)");
        assert_eq!(rest.as_deref(), Some("(NIL 1)\n\nA> (+ 1 2)\n3"));
        assert_eq!(ahead.next(), Ahead::Draft("(b".to_owned()));
        assert_eq!(ahead.rest_of("A> (c)"), None);
    }

    #[test]
    fn ctrl_d_comes_in_its_place() {
        assert_eq!(
            all("(a)\n\u{4}\u{4}(b)\n"),
            [input("(a)"), Ahead::End, Ahead::End, input("(b)")]
        );
    }

    #[test]
    fn ctrl_c_discards_what_comes_before() {
        let mut ahead = TypedAhead::default();
        ahead.add("(a)\n");
        assert!(ahead.add("(b\u{3}(c)\n"));
        assert_eq!(ahead.next(), input("(c)"));
        assert_eq!(ahead.next(), Ahead::Nothing);
    }

    #[test]
    fn keys_become_what_they_type() {
        let collector = Collector::default();
        for c in "ab\u{7f}\tc\r\n\u{3}".chars() {
            collector.collect(&Event::KeySeq(vec![KeyEvent::from(c)]));
        }
        collector.collect(&Event::KeySeq(vec![KeyEvent(KeyCode::Up, Modifiers::NONE)]));
        assert_eq!(collector.take(), "a\tc\n\n\u{3}");
    }
}

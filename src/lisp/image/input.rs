//! What a program reads from standard input: what a person types when asked, or nothing.

use std::cell::RefCell;
use std::rc::Rc;

use crate::guard;

/// Asks a person for text. It is given what the program has written and nobody has been shown yet;
/// it returns `None` at the end of all input, and when it is interrupted.
pub type Source = dyn Fn(&str) -> Option<String>;

/// Standard input. Without a source it is always at its end.
#[derive(Default)]
pub struct Input {
    /// What was typed and has not been read.
    unread: RefCell<String>,
    source: RefCell<Option<Rc<Source>>>,
}

impl Input {
    /// Sets who is asked.
    pub fn set_source(&self, source: Option<Rc<Source>>) {
        self.source.replace(source);
        self.unread.take();
    }

    /// Asks for more text; returns whether there is any. An interrupt leaves the calling function by
    /// unwinding.
    pub fn ask(&self, written: &str) -> bool {
        let source = self.source.borrow().clone();
        let typed = source.and_then(|source| source(written));
        guard::look();
        let typed = typed.unwrap_or_default();
        self.unread.borrow_mut().push_str(&typed);
        !typed.is_empty()
    }

    /// What was typed and has not been read; asks if there is nothing.
    pub fn text(&self, written: &str) -> String {
        if self.unread.borrow().is_empty() {
            self.ask(written);
        }
        self.unread()
    }

    /// What was typed and has not been read.
    pub(crate) fn unread(&self) -> String {
        self.unread.borrow().clone()
    }

    /// Records that so many bytes were read; returns how many there are not.
    pub fn advance(&self, bytes: usize) -> usize {
        let mut unread = self.unread.borrow_mut();
        let read = bytes.min(unread.len());
        if unread.is_char_boundary(read) {
            unread.drain(..read);
        }
        bytes - read
    }

    /// Puts a character back.
    pub fn put_back(&self, c: char) {
        self.unread.borrow_mut().insert(0, c);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_person_is_asked_when_nothing_is_left() {
        let input = Input::default();
        assert_eq!(input.text(""), "");
        input.set_source(Some(Rc::new(|written| Some(format!("{written}: ü\n")))));
        assert_eq!(input.text("Name"), "Name: ü\n");
        assert_eq!(input.advance(6), 0);
        assert_eq!(input.text("Other"), "ü\n");
        assert_eq!(input.advance(5), 2);
        input.put_back('x');
        assert_eq!(input.unread(), "x");
    }
}

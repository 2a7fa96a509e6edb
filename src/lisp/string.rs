//! Strings: mutable sequences of characters.

use std::cell::{Cell, Ref, RefCell};

/// A mutable string.
///
/// Positions count characters, not bytes; texts of ASCII characters are indexed in
/// constant time.
pub struct LispString {
    text: RefCell<String>,
    /// Does the string have a fill pointer, that is, can characters be pushed?
    pub has_fill_pointer: Cell<bool>,
}

impl LispString {
    /// A simple string.
    pub fn new(text: String) -> LispString {
        LispString {
            text: RefCell::new(text),
            has_fill_pointer: Cell::new(false),
        }
    }

    /// A copy of the text.
    pub fn text(&self) -> String {
        self.text.borrow().clone()
    }

    /// The text, borrowed; must not be held across a change of the string.
    pub fn borrow(&self) -> Ref<'_, String> {
        self.text.borrow()
    }

    /// Number of characters.
    pub fn len(&self) -> usize {
        let text = self.text.borrow();
        if text.is_ascii() {
            text.len()
        } else {
            text.chars().count()
        }
    }

    /// Is the string empty?
    pub fn is_empty(&self) -> bool {
        self.text.borrow().is_empty()
    }

    /// The character at a position.
    pub fn char_at(&self, index: usize) -> Option<char> {
        let text = self.text.borrow();
        if text.is_ascii() {
            text.as_bytes().get(index).map(|b| char::from(*b))
        } else {
            text.chars().nth(index)
        }
    }

    /// Replaces the character at a position; false if there is none.
    pub fn set_char(&self, index: usize, c: char) -> bool {
        let mut text = self.text.borrow_mut();
        let Some((start, old)) = text.char_indices().nth(index) else {
            return false;
        };
        text.replace_range(start..start + old.len_utf8(), c.encode_utf8(&mut [0; 4]));
        true
    }

    /// Replaces the whole text.
    pub fn set_text(&self, text: String) {
        *self.text.borrow_mut() = text;
    }

    /// Appends a character.
    pub fn push(&self, c: char) {
        self.text.borrow_mut().push(c);
    }

    /// Removes and returns the last character.
    pub fn pop(&self) -> Option<char> {
        self.text.borrow_mut().pop()
    }
}

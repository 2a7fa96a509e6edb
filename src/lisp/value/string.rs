//! Strings: mutable sequences of characters.

use std::cell::{Cell, Ref, RefCell};

use crate::lisp::guard::{permit_length, reserve};

/// Bytes of a text for which there may be no room.
const LARGE: usize = 1 << 16;

/// A mutable string.
///
/// Positions count characters, not bytes. Texts of ASCII characters are indexed in
/// constant time; in other texts, walking from one position to the next is constant too.
#[derive(Clone)]
pub(crate) struct LispString {
    text: RefCell<String>,
    /// Number of characters.
    length: Cell<usize>,
    /// A position and its byte offset: those of the last lookup.
    cursor: Cell<(usize, usize)>,
    /// Does the string have a fill pointer, that is, can characters be pushed?
    pub(crate) has_fill_pointer: Cell<bool>,
    /// May the string grow beyond its capacity?
    pub(crate) adjustable: Cell<bool>,
    /// How many characters there is room for, if there is a fill pointer.
    capacity: Cell<usize>,
    /// Characters beyond a fill pointer that was set back, the nearest one last.
    beyond: RefCell<Vec<char>>,
}

impl LispString {
    /// A simple string.
    pub(crate) fn new(text: String) -> LispString {
        let length = text.chars().count();
        permit_length(length);
        LispString {
            length: Cell::new(length),
            text: RefCell::new(text),
            cursor: Cell::default(),
            has_fill_pointer: Cell::new(false),
            adjustable: Cell::new(false),
            capacity: Cell::new(0),
            beyond: RefCell::default(),
        }
    }

    /// A string with a fill pointer at the end of the text and room for `capacity` characters.
    pub(crate) fn with_fill_pointer(text: String, capacity: usize, adjustable: bool) -> LispString {
        let string = LispString::new(text);
        string.has_fill_pointer.set(true);
        string.adjustable.set(adjustable);
        string.capacity.set(capacity);
        string
    }

    /// A copy of the text.
    pub(crate) fn text(&self) -> String {
        let text = self.text.borrow();
        if text.len() > LARGE {
            reserve(text.len());
        }
        text.clone()
    }

    /// The text, borrowed; must not be held across a change of the string.
    pub(crate) fn borrow(&self) -> Ref<'_, String> {
        self.text.borrow()
    }

    /// Number of characters.
    pub(crate) fn len(&self) -> usize {
        self.length.get()
    }

    /// How many characters there is room for.
    pub(crate) fn capacity(&self) -> usize {
        self.capacity.get().max(self.len())
    }

    /// Byte offset of a position; none beyond the end.
    fn offset(&self, index: usize) -> Option<usize> {
        let text = self.text.borrow();
        let length = self.length.get();
        if index > length {
            return None;
        }
        if text.len() == length {
            return Some(index);
        }
        let (from, offset) = match self.cursor.get() {
            (position, _) if position > index => (0, 0),
            found => found,
        };
        let offset = offset
            + text
                .get(offset..)?
                .chars()
                .take(index - from)
                .map(char::len_utf8)
                .sum::<usize>();
        self.cursor.set((index, offset));
        Some(offset)
    }

    /// The character at a position.
    pub(crate) fn char_at(&self, index: usize) -> Option<char> {
        let offset = self.offset(index)?;
        self.text.borrow().get(offset..)?.chars().next()
    }

    /// The characters from `start` to `end` (none: to the end).
    pub(crate) fn slice(&self, start: usize, end: Option<usize>) -> String {
        let length = self.length.get();
        let start = self.offset(start.min(length)).unwrap_or(0);
        let end = self.offset(end.unwrap_or(length).min(length));
        let text = self.text.borrow();
        text.get(start..end.unwrap_or(text.len()))
            .unwrap_or("")
            .to_owned()
    }

    /// Replaces the character at a position; false if there is none.
    pub(crate) fn set_char(&self, index: usize, c: char) -> bool {
        if index >= self.length.get() {
            return false;
        }
        self.overwrite(index, c.encode_utf8(&mut [0; 4]));
        true
    }

    /// Replaces as many characters from `start` on as `new` has, but none beyond the end.
    pub(crate) fn overwrite(&self, start: usize, new: &str) {
        let count = new.chars().count();
        let end = start.saturating_add(count).min(self.length.get());
        let (Some(from), Some(to)) = (self.offset(start), self.offset(end)) else {
            return;
        };
        let fitting = new
            .char_indices()
            .nth(end - start)
            .map_or(new.len(), |(i, _)| i);
        self.text
            .borrow_mut()
            .replace_range(from..to, new.get(..fitting).unwrap_or(new));
        self.cursor.set((0, 0));
    }

    /// Replaces the whole text.
    pub(crate) fn set_text(&self, text: String) {
        let length = text.chars().count();
        permit_length(length);
        self.length.set(length);
        self.cursor.set((0, 0));
        *self.text.borrow_mut() = text;
    }

    /// Gives the string other characters, of which so many are before the fill pointer.
    pub(crate) fn replace(&self, text: &str, length: usize) {
        let mut characters = text.chars();
        let active: String = characters.by_ref().take(length).collect();
        let mut beyond: Vec<char> = characters.collect();
        beyond.reverse();
        self.capacity.set(length + beyond.len());
        self.set_text(active);
        *self.beyond.borrow_mut() = beyond;
    }

    /// Appends a character.
    pub(crate) fn push(&self, c: char) {
        permit_length(self.length.get() + 1);
        self.length.set(self.length.get() + 1);
        self.text.borrow_mut().push(c);
        self.beyond.borrow_mut().pop();
    }

    /// Removes and returns the last character.
    pub(crate) fn pop(&self) -> Option<char> {
        let c = self.text.borrow_mut().pop()?;
        self.length.set(self.length.get().saturating_sub(1));
        self.cursor.set((0, 0));
        self.beyond.borrow_mut().push(c);
        Some(c)
    }

    /// Moves the fill pointer; characters beyond it reappear when it moves back up. False if there
    /// is not enough room.
    pub(crate) fn set_fill_pointer(&self, count: usize) -> bool {
        if count > self.capacity() {
            return false;
        }
        while self.len() > count {
            self.pop();
        }
        while self.len() < count {
            let c = self.beyond.borrow().last().copied();
            self.push(c.unwrap_or('\0'));
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use crate::lisp::value::string::*;

    #[test]
    fn positions_count_characters() {
        let s = LispString::new("naïve".to_owned());
        assert_eq!(s.len(), 5);
        assert_eq!(s.char_at(2), Some('ï'));
        assert_eq!(s.char_at(4), Some('e'));
        assert_eq!(s.char_at(1), Some('a'));
        assert_eq!(s.char_at(5), None);
        assert_eq!(s.slice(2, None), "ïve");
        assert!(s.set_char(2, 'i'));
        assert!(!s.set_char(5, 'x'));
        assert_eq!(s.text(), "naive");
    }

    #[test]
    fn overwriting_stops_at_the_end() {
        let s = LispString::new("abc".to_owned());
        s.overwrite(1, "xyz");
        assert_eq!(s.text(), "axy");
    }

    #[test]
    fn characters_behind_the_fill_pointer_come_back() {
        let s = LispString::with_fill_pointer("abc".to_owned(), 5, false);
        assert!(s.set_fill_pointer(1));
        assert_eq!(s.text(), "a");
        assert!(s.set_fill_pointer(4));
        assert_eq!(s.text(), "abc\0");
        assert!(!s.set_fill_pointer(6));
    }
}

//! Strings: mutable sequences of characters.

use std::cell::{Cell, Ref, RefCell};

use super::Value;
use super::elements::Displacement;
use crate::guard::{permit_length, reserve};

/// Bytes of a text for which there may be no room.
const LARGE: usize = 1 << 16;

/// A mutable string.
///
/// Positions count characters, not bytes. Texts of ASCII characters are indexed in
/// constant time; in other texts, walking from one position to the next is constant too.
#[derive(Clone)]
pub struct LispString {
    text: RefCell<String>,
    /// Number of characters.
    length: Cell<usize>,
    /// A position and its byte offset: those of the last lookup.
    cursor: Cell<(usize, usize)>,
    /// Does the string have a fill pointer, that is, can characters be pushed?
    pub(crate) has_fill_pointer: Cell<bool>,
    /// May the string grow beyond its capacity?
    pub adjustable: Cell<bool>,
    /// How many characters there is room for, if there is a fill pointer.
    capacity: Cell<usize>,
    /// Characters beyond a fill pointer that was set back, the nearest one last.
    beyond: RefCell<Vec<char>>,
    /// The part of an array that the string consists of, if it is displaced. What is kept here of
    /// its characters is then a copy, which is taken anew before each use.
    displaced: RefCell<Option<Displacement>>,
}

impl LispString {
    /// A simple string.
    pub fn new(text: String) -> LispString {
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
            displaced: RefCell::default(),
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

    /// Makes the string a part of an array of characters.
    pub(crate) fn displace(&self, displacement: Displacement) {
        self.length.set(self.length.get().min(displacement.size));
        self.capacity.set(displacement.size);
        drop(self.displaced.replace(Some(displacement)));
    }

    /// What part of which array the string is, if it is displaced.
    pub(crate) fn displacement(&self) -> Option<Displacement> {
        self.displaced.borrow().clone()
    }

    /// Sets how many characters of a displaced string are active.
    pub(crate) fn set_length(&self, length: usize) {
        self.length.set(length);
    }

    /// Takes the characters of a displaced string from where they are.
    fn refresh(&self) {
        let displaced = self.displaced.borrow();
        let Some(displacement) = &*displaced else {
            return;
        };
        // While the text is borrowed, it is not changed either.
        let Ok(mut text) = self.text.try_borrow_mut() else {
            return;
        };
        let character = |index| match displacement.get(index) {
            Some(Value::Char(c)) => c,
            _ => '\0',
        };
        let length = self.length.get();
        *text = (0..length).map(character).collect();
        *self.beyond.borrow_mut() = (length..displacement.size).rev().map(character).collect();
        self.cursor.set((0, 0));
    }

    /// Puts the characters of a displaced string where they belong. One that has outgrown its place
    /// has its own characters from then on.
    fn write_back(&self) {
        let displaced = self.displaced.borrow();
        let Some(displacement) = &*displaced else {
            return;
        };
        let characters: Vec<char> = {
            let beyond = self.beyond.borrow();
            let text = self.text.borrow();
            text.chars().chain(beyond.iter().rev().copied()).collect()
        };
        if self.length.get() > displacement.size {
            drop(displaced);
            drop(self.displaced.take());
            return;
        }
        for (index, c) in characters.into_iter().enumerate() {
            displacement.set(index, Value::Char(c));
        }
    }

    /// Is the string neither adjustable nor displaced, and without fill pointer?
    pub(crate) fn is_simple(&self) -> bool {
        !self.has_fill_pointer.get() && !self.adjustable.get() && self.displaced.borrow().is_none()
    }

    /// The character at a position, whether or not the fill pointer covers it.
    pub fn element(&self, index: usize) -> Option<char> {
        if index < self.len() {
            return self.char_at(index);
        }
        self.refresh();
        let beyond = self.beyond.borrow();
        let at = beyond.len().checked_sub(index - self.len() + 1);
        let c = at.and_then(|at| beyond.get(at).copied()).unwrap_or('\0');
        (index < self.capacity()).then_some(c)
    }

    /// Replaces the character at a position, whether or not the fill pointer covers it; false if
    /// there is none.
    pub(crate) fn set_element(&self, index: usize, c: char) -> bool {
        if index < self.len() || index >= self.capacity() {
            return self.set_char(index, c);
        }
        self.refresh();
        let mut beyond: Vec<char> = self.beyond.take();
        beyond.reverse();
        let at = index - self.len();
        beyond.resize(beyond.len().max(at + 1), '\0');
        if let Some(place) = beyond.get_mut(at) {
            *place = c;
        }
        beyond.reverse();
        *self.beyond.borrow_mut() = beyond;
        self.write_back();
        true
    }

    /// A copy of the text.
    pub fn text(&self) -> String {
        self.refresh();
        let text = self.text.borrow();
        if text.len() > LARGE {
            reserve(text.len());
        }
        text.clone()
    }

    /// The text, borrowed; must not be held across a change of the string.
    pub fn borrow(&self) -> Ref<'_, String> {
        self.refresh();
        self.text.borrow()
    }

    /// Number of characters.
    pub fn len(&self) -> usize {
        self.length.get()
    }

    /// Whether there are no characters.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// How many characters there is room for.
    pub fn capacity(&self) -> usize {
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
        if let Some(displacement) = &*self.displaced.borrow() {
            return match displacement.get(index) {
                Some(Value::Char(c)) if index < self.len() => Some(c),
                _ => None,
            };
        }
        let offset = self.offset(index)?;
        self.text.borrow().get(offset..)?.chars().next()
    }

    /// The characters from `start` to `end` (none: to the end).
    pub fn slice(&self, start: usize, end: Option<usize>) -> String {
        self.refresh();
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
    pub fn overwrite(&self, start: usize, new: &str) {
        self.refresh();
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
        self.write_back();
    }

    /// Replaces the whole text.
    pub(crate) fn set_text(&self, text: String) {
        let length = text.chars().count();
        permit_length(length);
        self.refresh();
        self.length.set(length);
        self.cursor.set((0, 0));
        *self.text.borrow_mut() = text;
        self.write_back();
    }

    /// Gives the string other characters, its own, of which so many are before the fill pointer.
    pub fn replace(&self, text: &str, length: usize) {
        drop(self.displaced.take());
        let mut characters = text.chars();
        let active: String = characters.by_ref().take(length).collect();
        let mut beyond: Vec<char> = characters.collect();
        beyond.reverse();
        self.capacity.set(length + beyond.len());
        self.set_text(active);
        *self.beyond.borrow_mut() = beyond;
    }

    /// Appends a character.
    pub fn push(&self, c: char) {
        permit_length(self.length.get() + 1);
        self.refresh();
        self.length.set(self.length.get() + 1);
        self.text.borrow_mut().push(c);
        self.beyond.borrow_mut().pop();
        self.write_back();
    }

    /// Removes and returns the last character.
    pub fn pop(&self) -> Option<char> {
        self.refresh();
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
    use crate::value::string::*;

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

//! Which bytes of an earlier state are held against those of a later one.

use std::ops::Range;

/// A state as bytes, with the places of its lists, against which later states are written.
#[derive(Default)]
pub(crate) struct Reference {
    pub(super) bytes: Vec<u8>,
    /// The outermost lists, in order.
    pub(super) lists: Vec<List>,
}

/// Where a list is in the bytes.
#[derive(Default)]
pub(super) struct List {
    /// Where each element begins.
    pub(super) starts: Vec<u32>,
    /// Where the first one begins, or would.
    pub(super) begin: u32,
    /// Where the last one ends.
    pub(super) end: u32,
}

impl Reference {
    /// How much memory (bytes) it takes.
    pub(crate) fn bytes(&self) -> usize {
        let lists = self.lists.iter().map(|list| 4 * list.starts.len());
        self.bytes.len() + lists.sum::<usize>() + size_of_val(self.lists.as_slice())
    }
}

/// The part of a reference that is held against what is written or read now.
pub(super) struct Alignment<'a> {
    reference: Option<&'a Reference>,
    /// What is left of the part.
    rest: Range<usize>,
    /// The number of the outermost list that comes next, or is being written or read.
    list: usize,
    /// How many lists are around.
    depth: usize,
}

impl<'a> Alignment<'a> {
    pub(super) fn new(reference: Option<&'a Reference>) -> Self {
        let mut alignment = Self {
            reference,
            rest: 0..0,
            list: 0,
            depth: 0,
        };
        alignment.go_between_lists(0);
        alignment
    }

    /// The next bytes of the reference, at most so many.
    pub(super) fn next(&mut self, count: usize) -> &'a [u8] {
        let Some(reference) = self.reference else {
            return &[];
        };
        let end = self.rest.end.min(self.rest.start + count);
        let bytes = &reference.bytes[self.rest.start..end];
        self.rest.start = end;
        bytes
    }

    /// A list begins, its length has been written or read. Returns whether it is an outermost one.
    pub(super) fn enter_list(&mut self) -> bool {
        self.depth += 1;
        self.depth == 1
    }

    /// An element of an outermost list begins.
    pub(super) fn enter_element(&mut self, index: usize) {
        let list = self.reference.and_then(|r| r.lists.get(self.list));
        let Some(list) = list else {
            return;
        };
        let place = |index: usize| list.starts.get(index).map(|place| *place as usize);
        self.rest = match place(index) {
            Some(start) => start..place(index + 1).unwrap_or(list.end as usize),
            None => 0..0,
        };
    }

    /// A list ends.
    pub(super) fn leave_list(&mut self) {
        self.depth -= 1;
        if self.depth == 0 {
            let list = self.reference.and_then(|r| r.lists.get(self.list));
            let end = list.map_or(0, |list| list.end as usize);
            self.list += 1;
            self.go_between_lists(end);
        }
    }

    /// The part from a place up to where the next list begins.
    fn go_between_lists(&mut self, start: usize) {
        let Some(reference) = self.reference else {
            return;
        };
        let next = reference.lists.get(self.list);
        self.rest = start..next.map_or(reference.bytes.len(), |list| list.begin as usize);
    }
}

//! Which bytes of an earlier state are held against those of a later one.

use std::ops::Range;

/// A state as bytes, with the places of its lists, against which later states are written.
#[derive(Clone, Copy)]
pub(crate) struct Reference<'a> {
    pub(crate) bytes: &'a [u8],
    pub(crate) places: &'a Places,
}

/// Where the outermost lists of a state are in its bytes, in order.
#[derive(Default)]
pub(crate) struct Places(Vec<List>);

/// Where a list is in the bytes.
struct List {
    /// Where the first element begins, or would.
    begin: u32,
    /// Where the last one ends.
    end: u32,
    /// How many there are.
    count: u32,
    /// Where each one begins, unless all have the same length.
    starts: Box<[u32]>,
}

impl List {
    /// Where an element is.
    fn element(&self, index: usize) -> Range<usize> {
        let count = self.count as usize;
        if index >= count {
            return 0..0;
        }
        let (begin, end) = (self.begin as usize, self.end as usize);
        if self.starts.is_empty() {
            let length = (end - begin) / count;
            return begin + index * length..begin + (index + 1) * length;
        }
        let start = |index: usize| self.starts.get(index).map(|start| *start as usize);
        start(index).unwrap_or(end)..start(index + 1).unwrap_or(end)
    }
}

impl Places {
    /// Adds the next list: where each element begins, and where the last one ends.
    pub(super) fn add(&mut self, begin: u32, starts: &[u32], end: u32) {
        let count = starts.len() as u32;
        let length = (end - begin).checked_div(count).unwrap_or(0);
        let is_even = length * count == end - begin
            && starts
                .iter()
                .zip(0..)
                .all(|(start, index)| *start == begin + index * length);
        self.0.push(List {
            begin,
            end,
            count,
            starts: if is_even {
                Box::default()
            } else {
                starts.into()
            },
        });
    }

    /// How much memory (bytes) they take.
    pub(crate) fn size(&self) -> usize {
        let starts = self.0.iter().map(|list| size_of_val(&*list.starts));
        size_of_val(self.0.as_slice()) + starts.sum::<usize>()
    }
}

/// The part of a reference that is held against what is written or read now.
pub(super) struct Alignment<'a> {
    reference: Option<Reference<'a>>,
    /// What is left of the part.
    rest: Range<usize>,
    /// The number of the outermost list that comes next, or is being written or read.
    list: usize,
    /// How many lists are around.
    depth: usize,
}

impl<'a> Alignment<'a> {
    pub(super) fn new(reference: Option<Reference<'a>>) -> Self {
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
        let bytes = reference.bytes.get(self.rest.start..end);
        self.rest.start = end;
        bytes.unwrap_or_default()
    }

    /// A list begins, its length has been written or read. Returns whether it is an outermost one.
    pub(super) fn enter_list(&mut self) -> bool {
        self.depth += 1;
        self.depth == 1
    }

    /// An element of an outermost list begins.
    pub(super) fn enter_element(&mut self, index: usize) {
        if let Some(list) = self.current() {
            self.rest = list.element(index);
        }
    }

    /// A list ends.
    pub(super) fn leave_list(&mut self) {
        self.depth -= 1;
        if self.depth == 0 {
            let end = self.current().map_or(0, |list| list.end as usize);
            self.list += 1;
            self.go_between_lists(end);
        }
    }

    fn current(&self) -> Option<&'a List> {
        self.reference?.places.0.get(self.list)
    }

    /// The part from a place up to where the next list begins.
    fn go_between_lists(&mut self, start: usize) {
        let Some(reference) = self.reference else {
            return;
        };
        let next = self.current().map(|list| list.begin as usize);
        self.rest = start..next.unwrap_or(reference.bytes.len());
    }
}

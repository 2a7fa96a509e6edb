//! Pages of an SQLite file and the trees that they make up. Rows are only ever appended, so each tree grows at its right
//! edge: a leaf is written when it is full, and what is above the leaves at the end.

use std::io::{self, Seek, SeekFrom, Write};

use super::record::push_varint;

/// Bytes of a page.
pub(super) const PAGE: usize = 4096;
/// The longest part of a row that stands in a leaf, and the shortest one of a row that does not fit in there.
const MOST: usize = PAGE - 35;
const LEAST: usize = (PAGE - 12) * 32 / 255 - 23;
/// Bytes of the file's header, on its first page.
pub(super) const HEADER: usize = 100;
/// The page that holds this byte is never used: SQLite locks the file there.
const LOCKED_BYTE: usize = 1 << 30;
/// Bytes before the cells of a leaf, and of a page above leaves.
const LEAF_START: usize = 8;
const INNER_START: usize = 12;

/// Writes pages one after the other. The first one is written last.
pub(super) struct Pages<W> {
    to: W,
    /// How many there are so far.
    pub(super) count: u32,
}

impl<W: Write + Seek> Pages<W> {
    /// Begins at the first page, which is left empty.
    pub(super) fn begin(mut to: W) -> io::Result<Pages<W>> {
        to.write_all(&[0; PAGE])?;
        Ok(Pages { to, count: 1 })
    }

    /// The number of the page that is written next.
    fn next(&self) -> io::Result<u32> {
        page_after(self.count)
    }

    /// Writes a page, and returns its number.
    fn write(&mut self, page: &[u8; PAGE]) -> io::Result<u32> {
        let number = self.next()?;
        for _ in self.count + 1..number {
            self.to.write_all(&[0; PAGE])?;
        }
        self.to.write_all(page)?;
        self.count = number;
        Ok(number)
    }

    /// Writes what of a row does not fit in its leaf; returns the number of the first page.
    fn write_overflow(&mut self, rest: &[u8]) -> io::Result<u32> {
        let first = self.next()?;
        let mut parts = rest.chunks(PAGE - 4).peekable();
        while let Some(part) = parts.next() {
            let mut page = [0; PAGE];
            let own = self.next()?;
            let is_last = parts.peek().is_none();
            let next = if is_last { 0 } else { page_after(own)? };
            put(&mut page, 0, &next.to_be_bytes());
            put(&mut page, 4, part);
            self.write(&page)?;
        }
        Ok(first)
    }

    /// Writes the first page, and ends.
    pub(super) fn finish(mut self, first: &[u8; PAGE]) -> io::Result<W> {
        self.to.seek(SeekFrom::Start(0))?;
        self.to.write_all(first)?;
        self.to.flush()?;
        Ok(self.to)
    }
}

/// The page that is written after another one.
fn page_after(page: u32) -> io::Result<u32> {
    let next = page.checked_add(1).filter(|next| *next < u32::MAX - 1);
    let next = next.map(|next| next + u32::from(next as usize == LOCKED_BYTE / PAGE + 1));
    next.ok_or_else(|| io::Error::other("an SQLite file has 4294967294 pages at most"))
}

/// Puts bytes into a page.
pub(super) fn put(page: &mut [u8], at: usize, bytes: &[u8]) {
    if let Some(place) = page.get_mut(at..at + bytes.len()) {
        place.copy_from_slice(bytes);
    }
}

/// Cells that are to be a page.
#[derive(Default)]
struct Cells {
    bytes: Vec<u8>,
    starts: Vec<usize>,
}

impl Cells {
    /// Is there room for another cell on a page with so many bytes before the cells?
    fn has_room(&self, length: usize, before: usize) -> bool {
        before + 2 * (self.starts.len() + 1) + self.bytes.len() + length <= PAGE
    }

    fn begin_cell(&mut self) {
        self.starts.push(self.bytes.len());
    }

    /// The page: its kind, the page right of all cells, and how many bytes stand before it on the first page.
    fn page(&mut self, kind: u8, rightmost: Option<u32>, offset: usize) -> [u8; PAGE] {
        let mut page = [0; PAGE];
        let content = PAGE - self.bytes.len();
        put(&mut page, content, &self.bytes);
        put(&mut page, offset, &[kind]);
        put(
            &mut page,
            offset + 3,
            &(self.starts.len() as u16).to_be_bytes(),
        );
        put(&mut page, offset + 5, &(content as u16).to_be_bytes());
        let mut at = offset + LEAF_START;
        if let Some(rightmost) = rightmost {
            put(&mut page, at, &rightmost.to_be_bytes());
            at = offset + INNER_START;
        }
        for (number, start) in self.starts.iter().enumerate() {
            let place = (content + start) as u16;
            put(&mut page, at + 2 * number, &place.to_be_bytes());
        }
        self.bytes.clear();
        self.starts.clear();
        page
    }
}

/// A page with the number of the last row that is below it.
type Child = (u32, u64);

/// The rows of a table, numbered from 1.
#[derive(Default)]
pub(super) struct Tree {
    leaf: Cells,
    leaves: Vec<Child>,
    /// Bytes that stand before a leaf: on the first page, the header of the file.
    offset: usize,
    /// How many rows there are.
    pub(super) rows: u64,
}

impl Tree {
    /// The tree whose root is the first page.
    pub(super) fn first() -> Tree {
        Tree {
            offset: HEADER,
            ..Tree::default()
        }
    }

    /// Appends a row.
    pub(super) fn append<W: Write + Seek>(
        &mut self,
        pages: &mut Pages<W>,
        row: &[u8],
    ) -> io::Result<()> {
        let mut head = Vec::with_capacity(18);
        push_varint(&mut head, row.len() as u64);
        push_varint(&mut head, self.rows + 1);
        let (local, rest) = row.split_at_checked(local(row.len())).unwrap_or((row, &[]));
        let link = if rest.is_empty() { 0 } else { 4 };
        let length = head.len() + local.len() + link;
        if !self.leaf.has_room(length, self.offset + LEAF_START) {
            self.write_leaf(pages)?;
        }
        self.leaf.begin_cell();
        self.leaf.bytes.append(&mut head);
        self.leaf.bytes.extend_from_slice(local);
        if !rest.is_empty() {
            let first = pages.write_overflow(rest)?;
            self.leaf.bytes.extend(first.to_be_bytes());
        }
        self.rows += 1;
        Ok(())
    }

    fn write_leaf<W: Write + Seek>(&mut self, pages: &mut Pages<W>) -> io::Result<()> {
        let page = self.leaf.page(0x0d, None, 0);
        let number = pages.write(&page)?;
        self.leaves.push((number, self.rows));
        Ok(())
    }

    /// Writes what is left; returns the number of the page at the root.
    pub(super) fn finish<W: Write + Seek>(&mut self, pages: &mut Pages<W>) -> io::Result<u32> {
        if !self.leaf.starts.is_empty() || self.leaves.is_empty() {
            self.write_leaf(pages)?;
        }
        let mut level = std::mem::take(&mut self.leaves);
        while level.len() > 1 {
            level = write_level(pages, &level)?;
        }
        Ok(level.first().map_or(0, |(page, _)| *page))
    }

    /// Writes what is left, but for the root, which is returned: the first page of the file.
    pub(super) fn finish_first<W: Write + Seek>(
        &mut self,
        pages: &mut Pages<W>,
    ) -> io::Result<[u8; PAGE]> {
        if self.leaves.is_empty() {
            return Ok(self.leaf.page(0x0d, None, HEADER));
        }
        self.write_leaf(pages)?;
        let mut level = std::mem::take(&mut self.leaves);
        while level.len() > fan(HEADER) {
            level = write_level(pages, &level)?;
        }
        let mut cells = inner_cells(&level);
        let rightmost = level.last().map_or(0, |(page, _)| *page);
        Ok(cells.page(0x05, Some(rightmost), HEADER))
    }
}

/// How many bytes of a row of this length stand in the leaf.
fn local(length: usize) -> usize {
    if length <= MOST {
        return length;
    }
    let fitting = LEAST + (length - LEAST) % (PAGE - 4);
    if fitting <= MOST { fitting } else { LEAST }
}

/// How many pages a page above them can have, with so many bytes before it.
fn fan(offset: usize) -> usize {
    // A cell has a page, the number of a row, and two bytes that point to it.
    (PAGE - offset - INNER_START) / (4 + 9 + 2) + 1
}

/// Writes the pages above others.
fn write_level<W: Write + Seek>(pages: &mut Pages<W>, below: &[Child]) -> io::Result<Vec<Child>> {
    let parts = below.len().div_ceil(fan(0));
    let mut level = Vec::with_capacity(parts);
    // All of them have about as many, so that none has a single one.
    let (each, more) = (below.len() / parts, below.len() % parts);
    let mut rest = below;
    for part in 0..parts {
        let (own, after) = rest.split_at(each + usize::from(part < more));
        rest = after;
        if let Some((rightmost, last)) = own.last() {
            let page = inner_cells(own).page(0x05, Some(*rightmost), 0);
            level.push((pages.write(&page)?, *last));
        }
    }
    Ok(level)
}

/// The cells of a page above others; the last of these has none.
fn inner_cells(children: &[Child]) -> Cells {
    let mut cells = Cells::default();
    let count = children.len().saturating_sub(1);
    for (page, last) in children.iter().take(count) {
        cells.begin_cell();
        cells.bytes.extend(page.to_be_bytes());
        push_varint(&mut cells.bytes, *last);
    }
    cells
}

//! Where the lines of a document break: the rules of the Common Lisp pretty printer.

use std::borrow::Cow;

use super::settings::Settings;
use crate::value::document::{Document, Kind, Newline, Op, Tab};

/// A block that does not fit on one line.
struct Block {
    start_column: usize,
    indent: usize,
    /// The line on which its current section starts.
    section_line: usize,
    /// The column at which its current section starts.
    section_column: usize,
    /// What begins its lines: that of the blocks around it and its own.
    line_prefix: String,
    /// What follows it.
    suffix: Cow<'static, str>,
}

/// The most blanks of one tab.
const MAX_BLANKS: usize = 10_000;

struct Layout<'d> {
    document: &'d Document,
    settings: &'d Settings,
    out: String,
    /// Bytes of the text that have been written.
    written: usize,
    /// Column of a position: the position plus this.
    shift: i64,
    line: usize,
    blocks: Vec<Block>,
    /// For each instruction, the index of the next unconditional newline after it.
    next_forced: Vec<usize>,
    /// Newlines before this instruction are in a block that fits on a line.
    flat_end: usize,
}

/// Breaks a document into lines; the first line already has `column` characters.
pub(super) fn lay_out(document: Document, settings: &Settings, column: usize) -> String {
    let is_flat = !document.has_tabs
        && column + document.characters() <= settings.right_margin
        && !document
            .ops
            .iter()
            .any(|op| matches!(op.kind, Kind::Newline(n) if n.is_unconditional()));
    if is_flat {
        return document.into_text();
    }
    let mut next_forced = vec![usize::MAX; document.ops.len()];
    let mut next = usize::MAX;
    for (i, op) in document.ops.iter().enumerate().rev() {
        if let Some(slot) = next_forced.get_mut(i) {
            *slot = next;
        }
        if matches!(op.kind, Kind::Newline(n) if n.is_unconditional()) {
            next = i;
        }
    }
    let layout = Layout {
        document: &document,
        settings,
        out: String::with_capacity(document.text.len() + 64),
        written: 0,
        shift: signed(column),
        line: 0,
        blocks: vec![Block {
            start_column: 0,
            indent: 0,
            section_line: 0,
            section_column: column,
            line_prefix: String::new(),
            suffix: "".into(),
        }],
        next_forced,
        flat_end: 0,
    };
    layout.run()
}

/// No text is longer than the largest signed number.
fn signed(n: usize) -> i64 {
    i64::try_from(n).unwrap_or(i64::MAX / 4)
}

impl Layout<'_> {
    fn run(mut self) -> String {
        let mut i = 0;
        while let Some(op) = self.document.ops.get(i) {
            i += 1;
            match op.kind {
                Kind::Start => {
                    let is_flat = self.flat_end <= i && self.fits(i - 1, op);
                    if is_flat && !self.document.has_tabs {
                        // The whole block is on one line: nothing in it matters.
                        i = i.max(op.block_end + 1);
                        continue;
                    }
                    if is_flat {
                        self.flat_end = op.block_end;
                    }
                    self.start(op);
                }
                Kind::End => {
                    // The outermost block is not ended by any instruction.
                    if self.blocks.len() > 1 {
                        self.blocks.pop();
                    }
                }
                Kind::IndentBlock(columns) if !self.is_squeezed() => {
                    if let Some(block) = self.blocks.last_mut() {
                        block.indent = offset(block.start_column, columns);
                    }
                }
                Kind::IndentCurrent(columns) if !self.is_squeezed() => {
                    let column = self.column(op.position);
                    if let Some(block) = self.blocks.last_mut() {
                        block.indent = offset(column, columns);
                    }
                }
                Kind::IndentBlock(_) | Kind::IndentCurrent(_) => {}
                Kind::Tab(tab) => {
                    let column = self.column(op.position);
                    let blanks = self.blanks(tab, column, self.section_column());
                    self.write_up_to(op.byte);
                    self.out.extend(std::iter::repeat_n(' ', blanks));
                    self.shift += signed(blanks);
                }
                Kind::Newline(_) if i <= self.flat_end => {
                    let column = self.column(op.position);
                    if let Some(block) = self.blocks.last_mut() {
                        block.section_column = column;
                    }
                }
                Kind::Newline(newline) => {
                    if self.breaks(i - 1, op, newline) && !self.break_line(op, newline) {
                        return self.out;
                    }
                    let column = self.column(op.position);
                    if let Some(block) = self.blocks.last_mut() {
                        block.section_column = column;
                    }
                }
            }
        }
        self.write_up_to(self.document.text.len());
        self.out
    }

    fn start(&mut self, op: &Op) {
        let column = self.column(op.position);
        let mut line_prefix = match self.blocks.last() {
            Some(block) => block.line_prefix.clone(),
            None => String::new(),
        };
        if !op.line_prefix.is_empty() {
            let own = column.saturating_sub(op.line_prefix.chars().count());
            let blanks = own.saturating_sub(line_prefix.chars().count());
            line_prefix.extend(std::iter::repeat_n(' ', blanks));
            line_prefix.push_str(&op.line_prefix);
        }
        self.blocks.push(Block {
            start_column: column,
            indent: column,
            section_line: self.line,
            section_column: column,
            line_prefix,
            suffix: op.suffix.clone(),
        });
    }

    fn section_column(&self) -> usize {
        self.blocks.last().map_or(0, |block| block.section_column)
    }

    /// The blanks of a tab at a column.
    fn blanks(&self, tab: Tab, column: usize, section_column: usize) -> usize {
        let origin = if tab.by_section { section_column } else { 0 };
        // No line is longer than what fits into it but for its last word.
        tab.blanks(column.saturating_sub(origin)).min(MAX_BLANKS)
    }

    /// How much longer the text from an instruction to a position gets by its tabs.
    fn width_of_tabs(&self, from: usize, end: usize) -> usize {
        if !self.document.has_tabs {
            return 0;
        }
        let mut added = 0;
        let mut section = self.section_column();
        let ops = self.document.ops.iter().skip(from);
        // Blanks that end a section would be removed at the end of a line.
        for op in ops.take_while(|op| op.position < end) {
            let column = self.column(op.position) + added;
            match op.kind {
                Kind::Tab(tab) => added += self.blanks(tab, column, section),
                Kind::Newline(_) | Kind::Start => section = column,
                _ => {}
            }
        }
        added
    }

    fn column(&self, position: usize) -> usize {
        usize::try_from(signed(position) + self.shift).unwrap_or(0)
    }

    /// Does what starts with the instruction fit on the line, up to the end of its section?
    fn fits(&self, index: usize, op: &Op) -> bool {
        let end = op.section_end;
        let forced = self.next_forced.get(index).copied().unwrap_or(usize::MAX);
        if forced < end.unwrap_or(usize::MAX) {
            return false;
        }
        let position = end
            .and_then(|end| self.document.ops.get(end))
            .map_or(self.document.characters(), |end| end.position);
        let tabs = self.width_of_tabs(index, position);
        self.column(position) + tabs <= self.settings.right_margin
    }

    /// Is the innermost block so near the right margin that it is printed in miser style?
    fn is_squeezed(&self) -> bool {
        let start = self.blocks.last().map_or(0, |b| b.start_column);
        self.settings
            .miser_width
            .is_some_and(|width| self.settings.right_margin.saturating_sub(start) <= width)
    }

    fn breaks(&self, index: usize, op: &Op, newline: Newline) -> bool {
        match newline {
            Newline::Linear | Newline::Mandatory | Newline::Literal => true,
            Newline::Miser => self.is_squeezed(),
            Newline::Fill => {
                self.is_squeezed()
                    || self
                        .blocks
                        .last()
                        .is_some_and(|b| self.line > b.section_line)
                    || !self.fits(index, op)
            }
        }
    }

    fn write_up_to(&mut self, byte: usize) {
        self.out
            .push_str(self.document.text.get(self.written..byte).unwrap_or(""));
        self.written = self.written.max(byte);
    }

    /// Ends the line; false if no more lines may be printed.
    fn break_line(&mut self, op: &Op, newline: Newline) -> bool {
        self.write_up_to(op.byte);
        if newline != Newline::Literal {
            let kept = self.out.trim_end_matches(' ').len();
            // The blank in the character `#\ ` does not separate values.
            let is_character = self.out.get(..kept).is_some_and(|t| t.ends_with("#\\"));
            self.out
                .truncate(kept + usize::from(is_character && kept < self.out.len()));
        }
        self.line += 1;
        if self.settings.lines.is_some_and(|most| self.line >= most) {
            self.out.push_str(" ..");
            for block in self.blocks.iter().rev() {
                self.out.push_str(&block.suffix);
            }
            return false;
        }
        self.out.push('\n');
        let mut column = 0;
        if let Some(block) = self.blocks.last_mut() {
            self.out.push_str(&block.line_prefix);
            column = block.line_prefix.chars().count();
            if newline != Newline::Literal {
                let blanks = block.indent.saturating_sub(column);
                self.out.extend(std::iter::repeat_n(' ', blanks));
                column += blanks;
                block.section_line = self.line;
            }
        }
        self.shift = signed(column) - signed(op.position);
        true
    }
}

fn offset(column: usize, by: i64) -> usize {
    usize::try_from(signed(column).saturating_add(by)).unwrap_or(0)
}

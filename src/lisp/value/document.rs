//! A text with places where lines may break: what the pretty printer lays out.

use std::borrow::Cow;

/// When a line breaks.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Newline {
    /// If its block does not fit on a line.
    Linear,
    /// If what follows up to the next newline does not fit, or what precedes did not.
    Fill,
    /// Like linear, but only where the block is squeezed at the right margin.
    Miser,
    /// Always.
    Mandatory,
    /// Always, without indentation: a newline of a printed string.
    Literal,
}

impl Newline {
    pub(crate) fn is_unconditional(self) -> bool {
        matches!(self, Newline::Mandatory | Newline::Literal)
    }
}

/// What the columns of a tab are counted from.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Tab {
    /// From where the section starts, not the line?
    pub(crate) by_section: bool,
    /// First this many blanks, then up to a multiple of the step?
    pub(crate) is_relative: bool,
    /// The column to reach, or the number of blanks.
    pub column: usize,
    /// Beyond the column, a multiple of this is reached.
    pub step: usize,
}

impl Tab {
    /// The blanks to write where the line, or the section, has `at` characters.
    pub(crate) fn blanks(&self, at: usize) -> usize {
        let Tab { column, step, .. } = *self;
        if self.is_relative {
            let after = at + column;
            column
                + if step > 1 {
                    after.next_multiple_of(step) - after
                } else {
                    0
                }
        } else if at < column {
            column - at
        } else if step == 0 {
            0
        } else {
            step - (at - column) % step
        }
    }
}

/// An instruction for the layout, at a position of the text.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    Newline(Newline),
    Start,
    End,
    /// Indent the next lines relative to where the block started.
    IndentBlock(i64),
    /// Indent the next lines relative to the current column.
    IndentCurrent(i64),
    /// Blanks up to a column.
    Tab(Tab),
}

/// An instruction and where it stands.
#[derive(Clone)]
pub struct Op {
    pub kind: Kind,
    /// Byte of the text that it precedes.
    pub byte: usize,
    /// Character of the text that it precedes.
    pub position: usize,
    /// Number of blocks around it.
    pub depth: usize,
    /// Index of the newline that ends the section which it starts.
    pub(crate) section_end: Option<usize>,
    /// Of a start, the index of its end.
    pub(crate) block_end: usize,
    /// Of a start, what begins each line of the block; empty if nothing does.
    pub(crate) line_prefix: Cow<'static, str>,
    /// Of a start, what follows the block.
    pub(crate) suffix: Cow<'static, str>,
}

/// A text with layout instructions.
#[derive(Clone)]
pub struct Document {
    pub text: String,
    pub ops: Vec<Op>,
    /// Characters so far.
    position: usize,
    /// Indices of the starts of open blocks.
    open: Vec<usize>,
    /// Indices of newlines and starts whose section has not ended.
    sections: Vec<usize>,
    /// The position where the line started, as far as newlines in the text tell.
    line_start: Option<usize>,
    /// Are there tabs?
    pub(crate) has_tabs: bool,
    /// Are layout instructions kept? Without them this is plain text.
    is_pretty: bool,
}

impl Document {
    pub fn new(is_pretty: bool) -> Document {
        Document {
            text: String::new(),
            ops: Vec::new(),
            position: 0,
            open: Vec::new(),
            sections: Vec::new(),
            line_start: None,
            has_tabs: false,
            is_pretty,
        }
    }

    /// The text without any layout.
    pub(crate) fn into_text(self) -> String {
        self.text
    }

    pub fn characters(&self) -> usize {
        self.position
    }

    /// Are layout instructions kept?
    pub(crate) fn is_pretty(&self) -> bool {
        self.is_pretty
    }

    /// The column after the text, as if lines broke only at its newlines, where the first line
    /// already has `start` characters.
    pub fn column(&self, start: usize) -> usize {
        match self.line_start {
            None => start + self.position,
            Some(line_start) => self.position - line_start,
        }
    }

    /// Appends another document: its blocks become part of the innermost block.
    pub fn append(&mut self, other: &Document) {
        if !self.is_pretty || other.ops.is_empty() {
            self.text(&other.text);
            return;
        }
        let mut written = 0;
        for op in &other.ops {
            self.line(other.text.get(written..op.byte).unwrap_or(""));
            written = op.byte;
            match op.kind {
                Kind::Newline(newline) => self.newline(newline),
                Kind::Start => self.start_lines(op.line_prefix.clone(), op.suffix.clone()),
                Kind::End => self.end(),
                Kind::IndentBlock(columns) => self.indent_block(columns),
                Kind::IndentCurrent(columns) => self.indent_current(columns),
                Kind::Tab(tab) => self.tab(tab),
            }
        }
        self.line(other.text.get(written..).unwrap_or(""));
    }

    /// Appends a text without newlines.
    fn line(&mut self, text: &str) {
        self.text.push_str(text);
        self.position += if text.is_ascii() {
            text.len()
        } else {
            text.chars().count()
        };
    }

    /// Appends a text; its newlines stay newlines.
    pub fn text(&mut self, text: &str) {
        if !text.contains('\n') {
            self.line(text);
            return;
        }
        if !self.is_pretty {
            self.line(text);
            let last = text.rsplit('\n').next().unwrap_or("");
            self.line_start = Some(self.position - last.chars().count());
            return;
        }
        for (i, line) in text.split('\n').enumerate() {
            if i > 0 {
                self.newline(Newline::Literal);
            }
            self.line(line);
        }
    }

    fn push(&mut self, kind: Kind) -> usize {
        self.ops.push(Op {
            kind,
            byte: self.text.len(),
            position: self.position,
            depth: self.open.len(),
            section_end: None,
            block_end: 0,
            line_prefix: Cow::Borrowed(""),
            suffix: Cow::Borrowed(""),
        });
        self.ops.len() - 1
    }

    /// A place for a line break.
    pub(crate) fn newline(&mut self, newline: Newline) {
        if !self.is_pretty {
            return;
        }
        if newline.is_unconditional() {
            self.line_start = Some(self.position);
        }
        let depth = self.open.len();
        let index = self.push(Kind::Newline(newline));
        while let Some(last) = self.sections.last().copied() {
            let Some(op) = self.ops.get_mut(last).filter(|op| op.depth >= depth) else {
                break;
            };
            op.section_end = Some(index);
            self.sections.pop();
        }
        self.sections.push(index);
    }

    /// Starts a block at the current column, which nothing follows.
    pub fn start(&mut self) {
        self.start_lines("".into(), "".into());
    }

    /// Writes what opens a block and starts it; something else will close it.
    pub fn open(&mut self, prefix: &str, suffix: &'static str) {
        self.text(prefix);
        self.start_lines("".into(), suffix.into());
    }

    /// Starts a block whose lines have a prefix. The first line has it already.
    pub(crate) fn start_lines(&mut self, prefix: Cow<'static, str>, suffix: Cow<'static, str>) {
        if self.is_pretty {
            let index = self.push(Kind::Start);
            if let Some(op) = self.ops.get_mut(index) {
                op.line_prefix = prefix;
                op.suffix = suffix;
            }
            self.sections.push(index);
            self.open.push(index);
        }
    }

    /// Ends the innermost block.
    pub fn end(&mut self) {
        if self.is_pretty {
            let start = self.open.pop();
            let index = self.push(Kind::End);
            if let Some(op) = start.and_then(|start| self.ops.get_mut(start)) {
                op.block_end = index;
            }
        }
    }

    /// Indents the next lines relative to where the block started.
    pub(crate) fn indent_block(&mut self, columns: i64) {
        if self.is_pretty {
            self.push(Kind::IndentBlock(columns));
        }
    }

    /// Indents the next lines relative to the current column.
    pub(crate) fn indent_current(&mut self, columns: i64) {
        if self.is_pretty {
            self.push(Kind::IndentCurrent(columns));
        }
    }

    /// Blanks up to a column.
    pub fn tab(&mut self, tab: Tab) {
        if self.is_pretty {
            self.has_tabs = true;
            self.push(Kind::Tab(tab));
        }
    }
}

//! A text with places where lines may break: what the pretty printer lays out.

/// When a line breaks.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Newline {
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
    pub(super) fn is_unconditional(self) -> bool {
        matches!(self, Newline::Mandatory | Newline::Literal)
    }
}

/// An instruction for the layout, at a position of the text.
#[derive(Clone, Copy, Debug)]
pub(super) enum Kind {
    Newline(Newline),
    Start,
    End,
    /// Indent the next lines relative to where the block started.
    IndentBlock(i64),
    /// Indent the next lines relative to the current column.
    IndentCurrent(i64),
}

pub(super) struct Op {
    pub(super) kind: Kind,
    /// Byte of the text that it precedes.
    pub(super) byte: usize,
    /// Character of the text that it precedes.
    pub(super) position: usize,
    /// Number of blocks around it.
    pub(super) depth: usize,
    /// Index of the newline that ends the section which it starts.
    pub(super) section_end: Option<usize>,
    /// Of a start, the index of its end.
    pub(super) block_end: usize,
}

/// A text with layout instructions.
pub(crate) struct Document {
    pub(super) text: String,
    pub(super) ops: Vec<Op>,
    /// Characters so far.
    position: usize,
    /// Indices of the starts of open blocks.
    open: Vec<usize>,
    /// Indices of newlines and starts whose section has not ended.
    sections: Vec<usize>,
    /// Are layout instructions kept? Without them this is plain text.
    is_pretty: bool,
}

impl Document {
    pub(crate) fn new(is_pretty: bool) -> Document {
        Document {
            text: String::new(),
            ops: Vec::new(),
            position: 0,
            open: Vec::new(),
            sections: Vec::new(),
            is_pretty,
        }
    }

    /// The text without any layout.
    pub(super) fn into_text(self) -> String {
        self.text
    }

    pub(super) fn characters(&self) -> usize {
        self.position
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
    pub(crate) fn text(&mut self, text: &str) {
        if !self.is_pretty || !text.contains('\n') {
            self.line(text);
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
        });
        self.ops.len() - 1
    }

    /// A place for a line break.
    pub(crate) fn newline(&mut self, newline: Newline) {
        if !self.is_pretty {
            return;
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

    /// Starts a block at the current column.
    pub(crate) fn start(&mut self) {
        if self.is_pretty {
            let index = self.push(Kind::Start);
            self.sections.push(index);
            self.open.push(index);
        }
    }

    /// Ends the innermost block.
    pub(crate) fn end(&mut self) {
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
}

//! Streams: string streams, files, combinations of streams, and the session's
//! standard output.

use std::cell::{Cell, RefCell};
use std::rc::Rc;
use std::sync::Arc;

use super::Value;
use super::cycles::Mark;
use super::document::Document;
use super::known;
use super::raise::Raise;
use super::string::LispString;
use super::symbol::Sym;
use crate::files::{Files, Output};

/// The deepest nesting of streams that are made of other streams.
pub(crate) const MAX_NESTING: u32 = 100;

pub struct Stream {
    /// Where its characters come from or go to.
    pub kind: RefCell<StreamKind>,
    /// Its class, which it keeps when it is closed.
    pub class: Sym,
    /// The name of the file that it reads or writes.
    pub file: Option<Rc<str>>,
    /// What its elements are.
    pub elements: Elements,
    /// How many levels of other streams it is made of.
    pub nesting: u32,
    /// How many backquotes, less commas, enclose the place that a reader passes on as a stream.
    pub(crate) backquotes: Cell<usize>,
    pub(crate) mark: Mark,
}

/// What the elements of a stream are.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Elements {
    /// Characters, which files encode as UTF-8.
    Characters,
    /// Integers of so many bits, the low byte first in files.
    Integers {
        /// Number of bits.
        bits: u32,
        /// May they be negative?
        signed: bool,
    },
}

/// Where the contents of a file are written that are in memory.
pub struct Target {
    /// The files that it is one of.
    pub files: Arc<dyn Files>,
    /// Is something not in the file yet?
    pub is_changed: bool,
}

/// Where a stream's elements come from or go to.
pub enum StreamKind {
    /// The image's standard output.
    StandardOutput,
    /// The same, for errors and warnings: who shows the output may show this apart.
    ErrorOutput,
    /// The image's standard input, which is at its end unless somebody can be asked.
    StandardInput,
    /// Collects what is written.
    StringOutput {
        /// Text written so far.
        text: String,
    },
    /// Collects what is written with places where lines may break.
    Pretty {
        /// What has been written so far.
        document: Document,
        /// The column where it begins.
        start: usize,
    },
    /// Appends what is written to a string with a fill pointer.
    StringTarget {
        /// The string.
        string: Rc<LispString>,
    },
    /// Yields the characters of a text: a string, or the contents of a file.
    StringInput {
        text: Rc<str>,
        /// Byte offset of the next character.
        position: usize,
    },
    /// Writes a file.
    FileOutput {
        /// The open file.
        file: Box<dyn Output>,
        /// Number of characters on the current line.
        column: usize,
        /// Index of the byte that is written next.
        position: u64,
        /// Number of bytes in the file.
        length: u64,
    },
    /// Reads a file that is not text, or reads and writes one. All of it is in memory.
    FileContents {
        bytes: Vec<u8>,
        /// Index of the next byte.
        position: usize,
        /// Where it is written; none for a file that is only read.
        target: Option<Target>,
    },
    /// Writes to several streams.
    Broadcast {
        /// The streams.
        targets: Vec<Rc<Stream>>,
    },
    /// Reads several streams one after the other.
    Concatenated {
        /// The streams that are not exhausted, the next one first.
        inputs: Vec<Rc<Stream>>,
        /// A character that was put back.
        unread: Option<char>,
    },
    /// Reads one stream and writes another.
    TwoWay {
        /// Where characters come from.
        input: Rc<Stream>,
        /// Where characters go to.
        output: Rc<Stream>,
        /// Is what is read written, too?
        echo: bool,
        /// A character that was put back; it is not echoed again.
        unread: Option<char>,
    },
    /// Stands for the stream that is the value of a variable.
    Synonym {
        /// The variable.
        symbol: Value,
    },
    /// Closed.
    Closed,
}

impl StreamKind {
    /// The class of streams of this kind, unless they are those of a file.
    fn class(&self) -> Sym {
        match self {
            StreamKind::StringOutput { .. }
            | StreamKind::StringInput { .. }
            | StreamKind::StringTarget { .. }
            | StreamKind::Pretty { .. } => known::STRING_STREAM,
            StreamKind::FileOutput { .. } | StreamKind::FileContents { .. } => known::FILE_STREAM,
            StreamKind::Broadcast { .. } => known::BROADCAST_STREAM,
            StreamKind::Concatenated { .. } => known::CONCATENATED_STREAM,
            StreamKind::TwoWay { echo: true, .. } => known::ECHO_STREAM,
            StreamKind::TwoWay { .. } => known::TWO_WAY_STREAM,
            StreamKind::StandardOutput
            | StreamKind::ErrorOutput
            | StreamKind::StandardInput
            | StreamKind::Synonym { .. } => known::SYNONYM_STREAM,
            StreamKind::Closed => known::STREAM,
        }
    }
}

impl Stream {
    /// A stream of a kind that is not made of other streams.
    pub fn new(kind: StreamKind) -> Stream {
        Stream {
            class: kind.class(),
            kind: RefCell::new(kind),
            file: None,
            elements: Elements::Characters,
            nesting: 0,
            backquotes: Cell::new(0),
            mark: Mark::default(),
        }
    }

    /// A stream that reads or writes a file.
    pub fn of_file(kind: StreamKind, name: &str, elements: Elements) -> Stream {
        Stream {
            class: known::FILE_STREAM,
            file: Some(name.into()),
            elements,
            ..Stream::new(kind)
        }
    }

    /// A stream that is made of others.
    pub(crate) fn compound(kind: StreamKind, parts: &[Rc<Stream>]) -> Result<Stream, Box<Raise>> {
        let nesting = parts.iter().map(|p| p.nesting).max().unwrap_or(0) + 1;
        if nesting > MAX_NESTING {
            return Err(Raise::new(
                known::STREAM_ERROR,
                format!("Streams may be nested at most {MAX_NESTING} deep."),
            ));
        }
        Ok(Stream {
            nesting,
            ..Stream::new(kind)
        })
    }

    /// A stream that yields the characters of a text.
    pub fn from_text(text: impl Into<Rc<str>>) -> Stream {
        Stream::new(StreamKind::StringInput {
            text: text.into(),
            position: 0,
        })
    }

    /// A stream that collects what is written.
    pub(crate) fn to_text() -> Stream {
        Stream::new(StreamKind::StringOutput {
            text: String::new(),
        })
    }

    /// A stream that collects a document, which begins at a column.
    pub(crate) fn to_document(is_pretty: bool, start: usize) -> Stream {
        Stream::new(StreamKind::Pretty {
            document: Document::new(is_pretty),
            start,
        })
    }

    /// Takes the document that such a stream has collected; `None` for other kinds.
    pub(crate) fn take_document(&self) -> Option<Document> {
        match &mut *self.kind.borrow_mut() {
            StreamKind::Pretty { document, .. } => {
                let empty = Document::new(document.is_pretty());
                Some(std::mem::replace(document, empty))
            }
            _ => None,
        }
    }

    /// Is it a stream that collects a document with places where lines may break?
    pub(crate) fn is_pretty(&self) -> bool {
        matches!(&*self.kind.borrow(), StreamKind::Pretty { document, .. } if document.is_pretty())
    }

    /// Changes the document that the stream collects, if it does so.
    pub(crate) fn with_document(&self, change: impl FnOnce(&mut Document)) {
        if let StreamKind::Pretty { document, .. } = &mut *self.kind.borrow_mut() {
            change(document);
        }
    }

    /// Takes the text that a string output stream has collected; `None` for other kinds.
    pub(crate) fn take_text(&self) -> Option<String> {
        match &mut *self.kind.borrow_mut() {
            StreamKind::StringOutput { text } => Some(std::mem::take(text)),
            _ => None,
        }
    }

    /// Number of bytes that an element takes in a file; characters count as one.
    pub fn width(&self) -> usize {
        match self.elements {
            Elements::Characters => 1,
            Elements::Integers { bits, .. } => bits.div_ceil(8).max(1) as usize,
        }
    }

    /// Can the stream be read?
    pub(crate) fn is_input(&self) -> bool {
        matches!(
            &*self.kind.borrow(),
            StreamKind::StandardInput
                | StreamKind::StringInput { .. }
                | StreamKind::FileContents { .. }
                | StreamKind::Concatenated { .. }
                | StreamKind::TwoWay { .. }
                | StreamKind::Synonym { .. }
        )
    }

    /// Can the stream be written?
    pub(crate) fn is_output(&self) -> bool {
        matches!(
            &*self.kind.borrow(),
            StreamKind::StandardOutput
                | StreamKind::ErrorOutput
                | StreamKind::StringOutput { .. }
                | StreamKind::Pretty { .. }
                | StreamKind::StringTarget { .. }
                | StreamKind::FileOutput { .. }
                | StreamKind::FileContents {
                    target: Some(_),
                    ..
                }
                | StreamKind::Broadcast { .. }
                | StreamKind::TwoWay { .. }
                | StreamKind::Synonym { .. }
        )
    }
}

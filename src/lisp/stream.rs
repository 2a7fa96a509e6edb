//! Streams: string streams, and the session's standard output.

use std::cell::RefCell;

/// A stream.
pub struct Stream {
    /// What stands behind it.
    pub kind: RefCell<StreamKind>,
}

/// What stands behind a stream.
pub enum StreamKind {
    /// The image's standard output.
    StandardOutput,
    /// The image's standard input, which is always at its end: plans are not interactive.
    StandardInput,
    /// Collects what is written.
    StringOutput {
        /// Text written so far.
        text: String,
    },
    /// Collects what is written in a string with a fill pointer.
    StringTarget {
        /// The string.
        string: std::rc::Rc<super::string::LispString>,
    },
    /// Gives characters of a text.
    StringInput {
        /// The text's characters.
        chars: Vec<char>,
        /// Position of the next character.
        position: usize,
    },
    /// Writes to several streams.
    Broadcast {
        /// The streams.
        targets: Vec<super::value::Value>,
    },
    /// Closed.
    Closed,
}

impl Stream {
    /// A stream of a kind.
    pub fn new(kind: StreamKind) -> Stream {
        Stream {
            kind: RefCell::new(kind),
        }
    }
}

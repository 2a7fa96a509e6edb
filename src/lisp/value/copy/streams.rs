//! Copies of streams.

use std::cell::RefCell;
use std::rc::Rc;

use super::Copier;
use crate::value::Value;
use crate::value::cycles::Mark;
use crate::value::stream::{Stream, StreamKind};

impl Copier {
    pub(super) fn stream(&mut self, stream: &Rc<Stream>) -> Rc<Stream> {
        let copy = self.object(&Value::Stream(stream.clone()), stream, |_, stream| {
            Value::Stream(Rc::new(Stream {
                kind: RefCell::new(StreamKind::Closed),
                class: stream.class,
                file: stream.file.clone(),
                elements: stream.elements,
                nesting: stream.nesting,
                backquotes: stream.backquotes.clone(),
                mark: Mark::default(),
            }))
        });
        match copy {
            Value::Stream(copy) => copy,
            _ => stream.clone(),
        }
    }

    fn streams(&mut self, streams: &[Rc<Stream>]) -> Vec<Rc<Stream>> {
        streams.iter().map(|stream| self.stream(stream)).collect()
    }

    pub(super) fn stream_kind(&mut self, kind: &StreamKind) -> StreamKind {
        match kind {
            StreamKind::StandardOutput => StreamKind::StandardOutput,
            StreamKind::ErrorOutput => StreamKind::ErrorOutput,
            StreamKind::StandardInput => StreamKind::StandardInput,
            StreamKind::StringOutput { text } => StreamKind::StringOutput { text: text.clone() },
            StreamKind::Pretty { document, start } => StreamKind::Pretty {
                document: document.clone(),
                start: *start,
            },
            StreamKind::StringTarget { string } => StreamKind::StringTarget {
                string: self.string(string),
            },
            StreamKind::StringInput { text, position } => StreamKind::StringInput {
                text: text.clone(),
                position: *position,
            },
            StreamKind::FileContents {
                bytes,
                position,
                target: None,
            } => StreamKind::FileContents {
                bytes: bytes.clone(),
                position: *position,
                target: None,
            },
            StreamKind::FileOutput { .. } | StreamKind::FileContents { .. } => {
                self.refuse("a file that is being written");
                StreamKind::Closed
            }
            StreamKind::Broadcast { targets } => StreamKind::Broadcast {
                targets: self.streams(targets),
            },
            StreamKind::Concatenated { inputs, unread } => StreamKind::Concatenated {
                inputs: self.streams(inputs),
                unread: *unread,
            },
            StreamKind::TwoWay {
                input,
                output,
                echo,
                unread,
            } => StreamKind::TwoWay {
                input: self.stream(input),
                output: self.stream(output),
                echo: *echo,
                unread: *unread,
            },
            StreamKind::Synonym { symbol } => StreamKind::Synonym {
                symbol: self.value(symbol),
            },
            StreamKind::Closed => StreamKind::Closed,
        }
    }
}

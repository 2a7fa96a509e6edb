//! What has been formatted so far: plain text, and within `~<…~:>` a document whose lines
//! are broken at the end of the outermost block.

use super::super::layout::lay_out;
use super::super::settings::Settings;
use crate::guard::reserve;
use crate::value::document::Document;

/// Text under construction.
pub struct Output {
    text: String,
    /// Column where the text begins.
    start: usize,
    document: Option<Document>,
}

impl Output {
    pub(super) fn new(start: usize) -> Output {
        Output {
            text: String::new(),
            start,
            document: None,
        }
    }

    /// All of the text becomes part of a document.
    pub(super) fn in_document(start: usize, is_pretty: bool) -> Output {
        Output {
            document: Some(Document::new(is_pretty)),
            ..Output::new(start)
        }
    }

    pub(crate) fn into_document(self) -> Document {
        self.document.unwrap_or_else(|| Document::new(false))
    }

    /// Appends what a call has written.
    pub(super) fn append(&mut self, text: &Document, settings: &Settings) {
        match &mut self.document {
            Some(document) => document.append(text),
            None => {
                let laid_out = lay_out(text.clone(), settings, self.column());
                self.push(&laid_out);
            }
        }
    }

    /// Appends a text.
    pub(super) fn push(&mut self, text: &str) {
        reserve(text.len());
        match &mut self.document {
            Some(document) => document.text(text),
            None => self.text.push_str(text),
        }
    }

    /// Appends a character a number of times.
    pub(super) fn repeat(&mut self, c: char, count: usize) {
        self.push(&c.to_string().repeat(count));
    }

    /// Column of the next character; within a document, as if its lines did not break.
    pub(super) fn column(&self) -> usize {
        let before = match self.text.rsplit_once('\n') {
            Some((_, last)) => last.chars().count(),
            None => self.start + self.text.chars().count(),
        };
        match &self.document {
            Some(document) => document.column(before),
            None => before,
        }
    }

    /// The document, inside a logical block.
    pub(super) fn document(&mut self) -> Option<&mut Document> {
        self.document.as_mut()
    }

    /// Begins a document; false if one is under way.
    pub(super) fn begin_document(&mut self, is_pretty: bool) -> bool {
        let begins = self.document.is_none();
        if begins {
            self.document = Some(Document::new(is_pretty));
        }
        begins
    }

    /// Breaks the document into lines and continues with plain text.
    pub(super) fn end_document(&mut self, settings: &Settings) {
        if let Some(document) = self.document.take() {
            let text = if settings.pretty {
                let column = self.column();
                lay_out(document, settings, column)
            } else {
                document.into_text()
            };
            self.text.push_str(&text);
        }
    }

    pub(crate) fn into_text(self) -> String {
        self.text
    }
}

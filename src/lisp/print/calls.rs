//! Calls of Lisp functions that a text depends on.
//!
//! Printing with no texts at hand collects the calls in order; printing again with their
//! texts consumes them in the same order.

use std::collections::VecDeque;

use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::document::Document;
use crate::lisp::value::symbol::Sym;

/// A call that writes a text to a stream.
#[derive(Clone)]
pub(crate) struct Call {
    pub(crate) function: Value,
    /// Arguments before the stream.
    pub(crate) before: Vec<Value>,
    /// Arguments after the stream.
    pub(crate) after: Vec<Value>,
    /// Variables that are bound during the call.
    pub(crate) bindings: Vec<(Sym, Value)>,
    /// Does what it writes have places where lines may break?
    pub(crate) is_pretty: bool,
}

/// Calls that are needed, or their texts.
pub(crate) struct Calls {
    /// Texts of calls made, in the order in which they are needed.
    texts: VecDeque<Document>,
    /// Calls without a text.
    needed: Vec<Call>,
    /// Does a value belong to a type, as far as the printer has to know? None if calls are not made at
    /// all.
    has_type: Option<TypeTest>,
}

/// Whether a value is of the type that a specifier names. The types are a room above this one, so
/// those who make calls bring the test along.
pub(crate) type TypeTest = fn(&Image, &Value, &Value) -> bool;

impl Calls {
    /// No calls are possible: objects print in their default form.
    pub(crate) fn none() -> Calls {
        Calls {
            texts: VecDeque::new(),
            needed: Vec::new(),
            has_type: None,
        }
    }

    /// Calls are possible, and these are the texts of the first ones.
    pub(crate) fn with_texts(
        texts: impl IntoIterator<Item = Document>,
        has_type: TypeTest,
    ) -> Calls {
        Calls {
            texts: texts.into_iter().collect(),
            needed: Vec::new(),
            has_type: Some(has_type),
        }
    }

    /// The test for types; `None` if calls are not possible.
    pub(crate) fn type_test(&self) -> Option<TypeTest> {
        self.has_type
    }

    /// The text of the next call; if that is missing, the call is recorded and the text is empty.
    /// `None` if calls are not possible.
    pub(crate) fn text(&mut self, call: impl FnOnce() -> Call) -> Option<Document> {
        self.has_type?;
        if let Some(text) = self.texts.pop_front() {
            return Some(text);
        }
        self.needed.push(call());
        Some(Document::new(false))
    }

    /// The calls whose texts were missing.
    pub(crate) fn into_needed(self) -> Vec<Call> {
        self.needed
    }
}

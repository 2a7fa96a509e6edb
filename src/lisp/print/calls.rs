//! Calls of Lisp functions that a text depends on.
//!
//! Printing with no texts at hand collects the calls in order; printing again with their
//! texts consumes them in the same order.

use std::collections::VecDeque;

use crate::image::Image;
use crate::source::Place;
use crate::value::Value;
use crate::value::document::Document;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;

/// A call that writes a text to a stream.
#[derive(Clone)]
pub struct Call {
    pub function: Value,
    /// Arguments before the stream.
    pub before: Vec<Value>,
    /// Arguments after the stream.
    pub after: Vec<Value>,
    /// Variables that are bound during the call.
    pub bindings: Vec<(Sym, Value)>,
    /// Does what it writes have places where lines may break?
    pub(crate) is_pretty: bool,
}

/// Calls that are needed, or their texts.
pub struct Calls {
    /// Texts of calls made, in the order in which they are needed.
    texts: VecDeque<Document>,
    /// Calls without a text.
    needed: Vec<Call>,
    /// Does what is printed from here on depend on a call that is yet to be made?
    is_undecided: bool,
    /// The first object that cannot be read again where that was asked for.
    unreadable: Option<Value>,
    /// Does a value belong to a type, as far as the printer has to know? None if calls are not made at
    /// all.
    has_type: Option<TypeTest>,
}

/// Whether a value is of the type that a specifier names; `None` if a call decides. The types are a room above this one, so
/// those who make calls bring the test along.
pub(crate) type TypeTest = fn(&Image, &Value, &Value) -> Option<bool>;

impl Calls {
    /// No calls are possible: objects print in their default form.
    pub fn none() -> Calls {
        Calls {
            texts: VecDeque::new(),
            needed: Vec::new(),
            is_undecided: false,
            unreadable: None,
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
            is_undecided: false,
            unreadable: None,
            has_type: Some(has_type),
        }
    }

    /// Notes that an object cannot be printed so that it can be read again, as was asked for.
    pub(crate) fn note_unreadable(&mut self, object: &Value) {
        self.unreadable.get_or_insert_with(|| object.clone());
    }

    /// The error about an object that cannot be read again, if there is one.
    pub(crate) fn readable(&self) -> Result<(), Box<Raise>> {
        match &self.unreadable {
            Some(object) => Err(not_readable(object)),
            None => Ok(()),
        }
    }

    /// Is the value of the type? Where a call decides and has not been made, it is recorded, and the answer
    /// is no; calls after it are not recorded, since they depend on it.
    pub(crate) fn has_type(&mut self, image: &Image, value: &Value, specifier: &Value) -> bool {
        let Some(test) = self.has_type else {
            return false;
        };
        if let Some(answer) = test(image, value, specifier) {
            return answer;
        }
        if let Some(text) = self.texts.pop_front() {
            return text.characters() > 0;
        }
        if !self.is_undecided {
            self.needed.push(Call {
                function: known::SYS_TELL_TYPE.into(),
                before: vec![value.clone(), specifier.clone()],
                after: Vec::new(),
                bindings: Vec::new(),
                is_pretty: false,
            });
            self.is_undecided = true;
        }
        false
    }

    /// The text of the next call; if that is missing, the call is recorded and the text is empty.
    /// `None` if calls are not possible.
    pub fn text(&mut self, call: impl FnOnce() -> Call) -> Option<Document> {
        self.has_type?;
        if let Some(text) = self.texts.pop_front() {
            return Some(text);
        }
        if !self.is_undecided {
            self.needed.push(call());
        }
        Some(Document::new(false))
    }

    /// Have all calls been made on which what was printed so far depends?
    pub(super) fn are_made(&self) -> bool {
        self.needed.is_empty() && !self.is_undecided
    }

    /// The calls whose texts were missing.
    pub(crate) fn into_needed(self) -> Vec<Call> {
        self.needed
    }
}

/// The error about an object that cannot be printed so that it can be read again.
pub(crate) fn not_readable(object: &Value) -> Box<Raise> {
    Box::new(Raise::Make {
        class: known::PRINT_NOT_READABLE,
        report: None,
        initargs: vec![(known::K_OBJECT, object.clone())],
        place: Place::NONE,
    })
}

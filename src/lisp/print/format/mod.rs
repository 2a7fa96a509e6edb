//! `format`: control strings, parsed once, and what their directives write.
//!
//! Pure like the printer: calls of Lisp functions (`~/name/`, objects that a program prints itself)
//! are recorded in [`Calls`] and made by the builtin.

mod arguments;
mod directive;
mod english;
mod error;
mod fixed;
mod float;
mod integer;
mod interpreter;
mod justify;
mod output;

#[cfg(test)]
mod tests;

pub use error::FormatError;
pub use output::Output;

use std::rc::Rc;

use super::calls::Calls;
use crate::image::Image;
use crate::value::Value;
use crate::value::document::Document;
use crate::value::raise::Raise;

/// A parsed control string.
#[derive(Clone)]
pub struct Control {
    text: Rc<str>,
    pieces: Rc<[directive::Piece]>,
}

impl Control {
    /// Parses a control string.
    pub fn parse(text: &str) -> Result<Control, FormatError> {
        let pieces = directive::parse(text)?;
        Ok(Control {
            text: text.into(),
            pieces: pieces.into(),
        })
    }

    /// Fewest and most arguments that it takes; `None` where that depends on the arguments.
    pub fn arguments(&self) -> Option<(usize, Option<usize>)> {
        arguments::count(&self.pieces)
    }

    /// The text that the control string makes of the arguments, where the line already has `column`
    /// characters.
    pub fn run(
        &self,
        image: &Image,
        args: &[Value],
        column: usize,
        calls: &mut Calls,
    ) -> Result<String, Box<Raise>> {
        interpreter::run(self, image, args, column, calls)
    }

    /// What the control string makes of the arguments, perhaps as a part of a document, and the
    /// arguments that it leaves.
    pub(crate) fn run_for_rest(
        &self,
        image: &Image,
        args: &[Value],
        column: usize,
        is_in_document: bool,
        calls: &mut Calls,
    ) -> Result<(Output, Vec<Value>), Box<Raise>> {
        let output = match is_in_document {
            true => Output::in_document(column, true),
            false => Output::new(column),
        };
        interpreter::run_for_rest(self, image, args, output, calls)
    }

    /// The same as a part of a document, whose lines will break.
    pub(crate) fn run_in_document(
        &self,
        image: &Image,
        args: &[Value],
        column: usize,
        calls: &mut Calls,
    ) -> Result<Document, Box<Raise>> {
        let output = Output::in_document(column, true);
        interpreter::run_into(self, image, args, output, calls).map(Output::into_document)
    }
}

/// The text that a control string makes of the arguments; objects that need Lisp code print in
/// their default form.
pub(crate) fn format_to_string(
    image: &Image,
    control: &str,
    args: &[Value],
) -> Result<String, Box<Raise>> {
    Control::parse(control)?.run(image, args, 0, &mut Calls::none())
}

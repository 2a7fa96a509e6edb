//! The printer: from values to text, for the reader to read back or for users to read.
//!
//! Printing is pure: it never runs Lisp code. An object that a program prints itself (a method of
//! `print-object`, the report of a condition class) is recorded in [`Calls`]; the builtins that
//! print make those calls first and print again with the texts. Nesting uses no Rust stack, and
//! circular structures are recognised.

mod atom;
mod calls;
mod circle;
pub mod dispatch;
mod float;
pub mod format;
mod layout;
mod printer;
mod qualified;
pub mod report;
mod settings;
mod shape;
mod symbol;

#[cfg(test)]
pub(crate) mod test_image;
#[cfg(test)]
mod tests;

pub use super::image::identity::identity;
pub(crate) use calls::not_readable;
pub use calls::{Call, Calls};
pub use circle::SharedLabels;
pub use qualified::qualified;
pub use settings::{Case, Settings};

use super::image::Image;
use super::value::Value;
use super::value::document::Document;
use super::value::foreign::PrintContext;
use super::value::symbol::Sym;

/// A value as `prin1` (`escape`) or `princ` print it under the current printer variables,
/// on a line of its own. Objects that need Lisp code print in their default form.
pub fn to_string(image: &Image, value: &Value, escape: bool) -> String {
    let settings = Settings::of(image).with_escape(escape);
    write(image, value, &settings, 0, &mut Calls::none())
}

/// A value under given settings, where the line already has `column` characters.
pub fn write(
    image: &Image,
    value: &Value,
    settings: &Settings,
    column: usize,
    calls: &mut Calls,
) -> String {
    printer::Printer::new(image, &settings.effective(), calls).print(value, column)
}

/// A value under given settings, as a part of a document in which lines will break.
pub(crate) fn document(
    image: &Image,
    value: &Value,
    settings: &Settings,
    calls: &mut Calls,
) -> Document {
    let mut document = Document::new(settings.pretty);
    printer::Printer::new(image, &settings.effective(), calls).print_into(&mut document, value);
    document
}

/// Like [`document()`], but ignores the program's own way to print the value itself.
pub(crate) fn document_default(
    image: &Image,
    value: &Value,
    settings: &Settings,
    calls: &mut Calls,
) -> Document {
    let mut document = Document::new(settings.pretty);
    printer::Printer::new(image, &settings.effective(), calls)
        .without_own_method()
        .print_into(&mut document, value);
    document
}

/// The text of a document whose lines break, where the first line already has `column` characters.
pub(crate) fn laid_out(document: Document, settings: &Settings, column: usize) -> String {
    layout::lay_out(document, settings, column)
}

/// Like [`write()`], but ignores a method of `print-object` for the value itself, as the default
/// method does.
pub(crate) fn write_default(
    image: &Image,
    value: &Value,
    settings: &Settings,
    column: usize,
    calls: &mut Calls,
) -> String {
    printer::Printer::new(image, &settings.effective(), calls)
        .without_own_method()
        .print(value, column)
}

impl PrintContext for Image {
    fn name(&self, sym: Sym) -> &str {
        Image::name(self, sym)
    }

    fn is_keyword(&self, sym: Sym) -> bool {
        Image::is_keyword(self, sym)
    }

    fn find_symbol(&self, package: &str, name: &str) -> Option<Sym> {
        let package = self.packages.find(package)?;
        Some(self.packages.find_symbol(package, name)?.0)
    }

    fn special(&self, sym: Sym) -> &Value {
        Image::special(self, sym)
    }

    fn text(&self, value: &Value, escape: bool) -> String {
        to_string(self, value, escape)
    }

    fn qualified(&self, name: &Value) -> String {
        qualified(self, name)
    }

    fn identity(&self, object: &Value) -> String {
        identity(self, object)
    }
}

//! Compiling and loading: what the checks find, and then the evaluation of the text.

use std::time::Instant;

use super::answer::{Answer, Compiled};
use super::definitions::buffer_source;
use super::engine::Engine;
use super::hub::Request;
use super::sexp::Sexp;
use lisp::files::{Disk, Files};
use session::dialogue::Finding;

/// Lines and columns up to which a text is shifted to where it stands in its buffer.
const MAX_SHIFT: usize = 1_000_000;

/// A form that loads a file as if it were compiled first: what it evaluates only then is
/// evaluated, too.
fn compile_form(file: &str) -> String {
    format!(
        "(cl:let ((system::%*as-compiled* :next)) {})",
        load_form(file)
    )
}

/// A form that loads a file.
fn load_form(file: &str) -> String {
    format!("(cl:load {})", Sexp::from(file))
}

impl Engine<'_> {
    /// `load-file`.
    pub(super) fn load_file(&mut self, request: &Request) {
        let Some(file) = request.text(0) else {
            return request.abort("load-file takes the name of a file");
        };
        let source = self.next_input();
        self.evaluate(request, &source, &load_form(file), Answer::Loaded);
    }

    /// `compile-file-for-emacs`.
    pub(super) fn compile_file(&mut self, request: &Request) {
        let Some(file) = request.text(0).map(str::to_owned) else {
            return request.abort("compile-file-for-emacs takes the name of a file");
        };
        let text = match Disk.read_plan(&file) {
            Ok(bytes) => String::from_utf8_lossy(&bytes).into_owned(),
            Err(error) => return request.abort(&format!("{file} cannot be read: {error}")),
        };
        let Some(compiled) = self.checked(request, &file, &text) else {
            return;
        };
        let source = self.next_input();
        self.evaluate(
            request,
            &source,
            &compile_form(&file),
            Answer::Compiled(compiled),
        );
    }

    /// `compile-string-for-emacs`.
    pub(super) fn compile_string(&mut self, request: &Request) {
        let (Some(text), Some(buffer)) = (request.text(0), request.text(1)) else {
            return request.abort("compile-string-for-emacs takes a text and a buffer");
        };
        let source = request.text(3).map(str::to_owned);
        let source = source.unwrap_or_else(|| buffer_source(buffer));
        let text = format!("{}{text}", shift(request.argument(2)));
        let Some(compiled) = self.checked(request, &source, &text) else {
            return;
        };
        self.evaluate(request, &source, &text, Answer::Compiled(compiled));
    }

    /// What the checks find in a text. `None` if that cannot be evaluated; the request is then
    /// answered.
    fn checked(&mut self, request: &Request, source: &str, text: &str) -> Option<Compiled> {
        let began = Instant::now();
        self.begin(request, false);
        let checked = self.working(request.client.number, |engine| {
            engine.session.check(source, text)
        });
        let findings: Vec<Finding> = match checked {
            Ok(findings) => findings,
            Err(defect) => {
                request.abort(&format!("planwright failed: {defect}."));
                return None;
            }
        };
        let compiled = Compiled { findings, began };
        if compiled.succeeds() {
            return Some(compiled);
        }
        request.ok(compiled.value());
        None
    }
}

/// Blanks that put a text at the line and column at which it stands in its buffer; `places` is
/// what the client says about that.
fn shift(places: Option<&Sexp>) -> String {
    let places = places.map(Sexp::items).unwrap_or_default();
    let line = places
        .iter()
        .find(|place| place.item(0).and_then(Sexp::as_name) == Some(":line"));
    let number = |at: usize| {
        let number = line.and_then(|line| line.item(at)).and_then(Sexp::as_index);
        number.unwrap_or(1).saturating_sub(1).min(MAX_SHIFT)
    };
    "\n".repeat(number(1)) + &" ".repeat(number(2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_is_shifted_to_its_place() {
        let place = |text: &str| shift(Some(&Sexp::read(text).unwrap()));
        assert_eq!(place("((:position 60) (:line 3 4))"), "\n\n   ");
        assert_eq!(place("((:position 60))"), "");
        assert_eq!(place("nil"), "");
        assert_eq!(place("((:line 99999999999 1))").len(), MAX_SHIFT);
    }
}

//! From tokens to forms: an explicit stack of unfinished forms, no recursion.

mod finish;
mod frame;
mod token;

use std::rc::Rc;

use super::error::{ReadError, ReadErrorKind};
use super::flattened::{last_swallowing_comment, swallowing_comment};
use super::label::Labels;
use super::lexer::{Lexer, is_blank};
use super::readtable::Readtable;
use crate::image::Image;
use crate::source::{Place, SourceId, Text};
use crate::stream::{Stream, StreamKind};
use crate::value::Value;
use crate::value::known;
use frame::{Frame, Kind};

/// The result of reading.
#[derive(Clone)]
pub enum Outcome {
    /// A whole form, and its place.
    Form(Value, Place),
    /// No further form.
    End,
    /// The form after `#.`, to be evaluated; reading continues after [`Reader::supply`].
    Evaluate(Value),
}

/// Reads the forms of a text one after the other.
///
/// A form is read in the package that is current at that moment, so `in-package` between
/// two calls takes effect.
pub struct Reader {
    text: Text,
    source: Option<SourceId>,
    position: usize,
    frames: Vec<Frame>,
    /// Elements of all unfinished lists; each frame stores where its own begin.
    values: Vec<Value>,
    labels: Labels,
    /// How many backquotes, less commas, enclose the position.
    backquotes: usize,
    /// How many forms that enclose the position are skipped.
    skips: usize,
    /// How many feature expressions enclose the position.
    features: usize,
    /// The text as the function of a macro character sees it, while that runs.
    macro_input: Option<Rc<Stream>>,
    /// A further character that ends tokens.
    terminator: Option<char>,
    /// Is the first token read as in the standard syntax, whatever the readtable says?
    begins_as_standard: bool,
    /// Does a running program read? Then new symbols last as long as something refers to them.
    is_for_program: bool,
}

/// Reads all forms of a source in the current package.
#[cfg(test)]
pub fn read_all(image: &mut Image, source: SourceId) -> Result<Vec<(Value, Place)>, ReadError> {
    let mut reader = Reader::new(image, source);
    let mut forms = Vec::new();
    while let Some(form) = reader.next_form(image)? {
        forms.push(form);
    }
    Ok(forms)
}

impl Reader {
    /// A reader at the start of a registered source; an unknown source reads as empty.
    pub fn new(image: &Image, source: SourceId) -> Reader {
        let text = image
            .sources
            .get(source)
            .map_or_else(|| Text::BuiltIn(""), |source| source.text.clone());
        Reader::make(text, Some(source))
    }

    /// A reader at the start of a text that belongs to no source: forms get no places.
    pub fn of_text(text: impl Into<Text>) -> Reader {
        Reader::make(text.into(), None)
    }

    fn make(text: Text, source: Option<SourceId>) -> Reader {
        Reader {
            text,
            source,
            position: 0,
            frames: Vec::new(),
            values: Vec::new(),
            labels: Labels::default(),
            backquotes: 0,
            skips: 0,
            features: 0,
            macro_input: None,
            terminator: None,
            begins_as_standard: false,
            is_for_program: false,
        }
    }

    /// Reads for a running program.
    pub(crate) fn for_program(self) -> Reader {
        Reader {
            is_for_program: true,
            ..self
        }
    }

    /// Reads the first token as in the standard syntax.
    pub(crate) fn beginning_as_standard(self) -> Reader {
        Reader {
            begins_as_standard: true,
            ..self
        }
    }

    /// Reads what so many backquotes enclose.
    pub fn within(self, backquotes: usize) -> Reader {
        Reader { backquotes, ..self }
    }

    /// Continues at a byte of the text.
    pub fn at(self, position: usize) -> Reader {
        Reader { position, ..self }
    }

    /// The byte up to which the text has been read.
    pub fn position(&self) -> usize {
        self.position
    }

    /// The text.
    pub fn text(&self) -> &Text {
        &self.text
    }

    /// The text that has not been read.
    pub fn rest(&self) -> &str {
        self.text.get(self.position..).unwrap_or("")
    }

    /// Lets a further character end tokens.
    pub(crate) fn with_terminator(mut self, c: char) -> Reader {
        self.terminator = Some(c);
        self
    }

    /// Moves past one blank character, as `read` does after a form.
    pub(crate) fn skip_one_blank(&mut self, image: &Image) {
        let readtable = image.special(known::V_READTABLE);
        let readtable = readtable.as_foreign::<Readtable>();
        let is_significant =
            |c| readtable.is_some_and(|readtable| readtable.significant().contains(&c));
        if let Some(c) = self.rest().chars().next()
            && is_blank(c)
            && !is_significant(c)
        {
            self.position += c.len_utf8();
        }
    }

    /// The next form and its place; `None` at the end. `#.` of anything but a constant is
    /// an error here: use [`Reader::next`] where evaluation is possible.
    pub fn next_form(&mut self, image: &mut Image) -> Result<Option<(Value, Place)>, ReadError> {
        match self.next(image)? {
            Outcome::Form(value, place) => Ok(Some((value, place))),
            Outcome::End => Ok(None),
            Outcome::Evaluate(_) => {
                let position = self.position;
                Err(self.fail(image, ReadErrorKind::CannotEvaluate, position, position))
            }
        }
    }

    /// Reads up to the end of the next form, or to something that must be evaluated. After an error
    /// the reader is positioned after the wrong text, outside all forms.
    pub fn next(&mut self, image: &mut Image) -> Result<Outcome, ReadError> {
        let text = self.text.clone();
        let readtable = image.special(known::V_READTABLE).clone();
        let readtable = readtable.as_foreign::<Readtable>();
        let mut terminators = readtable.map(Readtable::terminators).unwrap_or_default();
        terminators.extend(self.terminator);
        if self.frames.is_empty() && image.special(known::V_READ_SUPPRESS).is_true() {
            self.frames.push(Frame {
                kind: Kind::Suppressed,
                start: self.position,
                base: self.values.len(),
            });
            self.skips += 1;
        }
        let constituents = readtable.map(Readtable::significant).unwrap_or_default();
        let mut lexer = Lexer::at(&text, self.position)
            .with_terminators(&terminators)
            .with_constituents(&constituents);
        loop {
            let is_standard = std::mem::take(&mut self.begins_as_standard);
            let readtable = readtable.filter(|_| !is_standard);
            if let Some(readtable) = readtable {
                lexer.skip_blanks();
                let c = lexer.peek();
                if let Some((c, function)) = c.and_then(|c| Some((c, readtable.macro_of(c)?))) {
                    let position = lexer.position() + c.len_utf8();
                    return Ok(self.call_macro(position, function, &[Value::Char(c)]));
                }
            }
            let Some(token) = lexer.next() else {
                self.position = text.len();
                return self.at_end(image);
            };
            self.position = token.end;
            if let Some(readtable) = readtable
                && let Some((argument, letter, body)) = token.dispatching(&text)
                && let Some(function) = readtable.dispatch_of(letter)
            {
                let number = argument.map_or(Value::NIL, |n| Value::Int(n.into()));
                let arguments = [Value::Char(letter), number];
                return Ok(self.call_macro(body, function, &arguments));
            }
            match self.token(image, &text, token) {
                Ok(None) => {}
                Ok(Some(outcome)) => return Ok(outcome),
                Err(kind) => return Err(self.fail(image, kind, token.start, token.end)),
            }
        }
    }

    /// Asks for a call of the function of a macro character: it reads from a stream that
    /// begins at the position. The form's value is the list of the values it returns.
    fn call_macro(&mut self, position: usize, function: Value, arguments: &[Value]) -> Outcome {
        let stream = Rc::new(Stream::new(StreamKind::StringInput {
            text: self.text.shared(),
            position,
        }));
        stream.backquotes.set(self.backquotes);
        self.macro_input = Some(stream.clone());
        let quote = |value: Value| Value::list([known::QUOTE.into(), value]);
        let call: Vec<Value> = [known::FUNCALL.into(), quote(function)]
            .into_iter()
            .chain([quote(Value::Stream(stream))])
            .chain(arguments.iter().cloned())
            .collect();
        Outcome::Evaluate(Value::list([
            known::MULTIPLE_VALUE_LIST.into(),
            Value::list(call),
        ]))
    }

    /// Hands over the value of the form to evaluate and reads on.
    pub fn supply(&mut self, image: &mut Image, value: Value) -> Result<Outcome, ReadError> {
        let mut value = value;
        if let Some(stream) = self.macro_input.take() {
            if let StreamKind::StringInput { position, .. } = &*stream.kind.borrow() {
                self.position = *position;
            }
            // A macro character may mean nothing, as a comment does.
            let Value::Cons(values) = &value else {
                return self.next(image);
            };
            value = values.car();
        }
        let end = self.position;
        match self.deliver(image, value, end, end) {
            Ok(None) => self.next(image),
            Ok(Some(outcome)) => Ok(outcome),
            Err(kind) => Err(self.fail(image, kind, end, end)),
        }
    }

    fn place(&self, image: &mut Image, start: usize, end: usize) -> Place {
        self.source.map_or(Place::NONE, |source| {
            image.sources.place(source, start, end)
        })
    }

    fn fail(
        &mut self,
        image: &mut Image,
        kind: ReadErrorKind,
        start: usize,
        end: usize,
    ) -> ReadError {
        let comment = self.swallowing_comment(&kind, start);
        self.frames.clear();
        self.values.clear();
        self.labels = Labels::default();
        (self.backquotes, self.skips, self.features) = (0, 0, 0);
        ReadError {
            kind,
            comment,
            start,
            end,
            place: self.place(image, start, end),
        }
    }

    /// In words, the comment that has swallowed the parentheses which the text lacks.
    fn swallowing_comment(&self, kind: &ReadErrorKind, start: usize) -> Option<Box<str>> {
        self.source?;
        let comment = match kind {
            ReadErrorKind::EndOfFile { .. } => {
                let form = self.frames.first().map_or(start, |frame| frame.start);
                swallowing_comment(&self.text, form)
            }
            ReadErrorKind::UnmatchedClose => last_swallowing_comment(self.text.get(..start)?),
            _ => None,
        }?;
        Some(comment.described(&self.text).into())
    }

    fn end_of_file(&self, what: &'static str, opened_at: usize) -> ReadErrorKind {
        let before = self.text.as_bytes().iter().take(opened_at);
        ReadErrorKind::EndOfFile {
            what: Some(what),
            line: before.filter(|b| **b == b'\n').count() + 1,
            opened_at,
        }
    }

    fn at_end(&mut self, image: &mut Image) -> Result<Outcome, ReadError> {
        if let [
            Frame {
                kind: Kind::Suppressed,
                ..
            },
        ] = self.frames.as_slice()
        {
            self.frames.clear();
            self.skips = 0;
        }
        let Some(frame) = self.frames.last() else {
            return Ok(Outcome::End);
        };
        let (start, end) = (frame.start, frame.start + 1);
        let kind = self.end_of_file(frame.kind.what(), start);
        Err(self.fail(image, kind, start, end))
    }
}

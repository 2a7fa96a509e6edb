//! From tokens to forms: an explicit stack of unfinished forms, no recursion.

use std::rc::Rc;

use super::error::{ReadError, ReadErrorKind};
use super::feature;
use super::label::Labels;
use super::lexer::{Lexer, Token, TokenKind};
use super::literal;
use super::numeric::parse_number;
use super::readtable::{LetterCase, Readtable, escaped};
use super::symbol;
use crate::lisp::image::Image;
use crate::lisp::source::{Place, SourceId};
use crate::lisp::stream::{Stream, StreamKind};
use crate::lisp::value::Value;
use crate::lisp::value::known;
use crate::lisp::value::pathname::Pathname;
use crate::lisp::value::symbol::{Sym, VariableKind};

/// The result of reading.
#[derive(Clone)]
pub(crate) enum Outcome {
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
pub(crate) struct Reader {
    text: Rc<str>,
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
}

/// A form that is not finished.
struct Frame {
    kind: Kind,
    start: usize,
    base: usize,
}

#[derive(Clone, Copy, PartialEq)]
enum Dot {
    None,
    Expecting,
    Done,
}

#[derive(Clone, Copy)]
enum Kind {
    List(Dot),
    Vector(Option<u32>),
    /// `'x`, `#'x`
    Wrap(Sym),
    Backquote,
    Comma(Sym),
    /// `#+` (true) and `#-` (false), before the feature expression.
    Feature(bool),
    /// Before a form that is left out.
    Skip,
    /// Before a whole form that is read as `NIL`: `*read-suppress*`.
    Suppressed,
    Evaluate,
    Array(u32),
    Structure,
    Complex,
    Pathname,
    Label(u32),
}

impl Kind {
    fn what(self) -> &'static str {
        match self {
            Kind::List(_) => "a list",
            Kind::Vector(_) => "a vector",
            Kind::Wrap(known::FUNCTION) => "the form after #'",
            Kind::Wrap(_) => "the form after '",
            Kind::Backquote => "the form after `",
            Kind::Comma(_) => "the form after ,",
            Kind::Feature(true) => "the feature expression after #+",
            Kind::Feature(false) => "the feature expression after #-",
            Kind::Suppressed => "a form that is left out",
            Kind::Skip => "the form that a feature expression leaves out",
            Kind::Evaluate => "the form after #.",
            Kind::Array(_) => "the array after #A",
            Kind::Structure => "the structure after #S",
            Kind::Complex => "the number after #C",
            Kind::Pathname => "the pathname after #P",
            Kind::Label(_) => "the form after #n=",
        }
    }
}

/// Reads all forms of a source in the current package.
#[cfg(test)]
pub(crate) fn read_all(
    image: &mut Image,
    source: SourceId,
) -> Result<Vec<(Value, Place)>, ReadError> {
    let mut reader = Reader::new(image, source);
    let mut forms = Vec::new();
    while let Some(form) = reader.next_form(image)? {
        forms.push(form);
    }
    Ok(forms)
}

impl Reader {
    /// A reader at the start of a registered source; an unknown source reads as empty.
    pub(crate) fn new(image: &Image, source: SourceId) -> Reader {
        let text = image
            .sources
            .get(source)
            .map_or_else(|| Rc::from(""), |source| source.text.clone());
        Reader::make(text, Some(source))
    }

    /// A reader at the start of a text that belongs to no source: forms get no places.
    pub(crate) fn of_text(text: impl Into<Rc<str>>) -> Reader {
        Reader::make(text.into(), None)
    }

    fn make(text: Rc<str>, source: Option<SourceId>) -> Reader {
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
        }
    }

    /// Reads what so many backquotes enclose.
    pub(crate) fn within(self, backquotes: usize) -> Reader {
        Reader { backquotes, ..self }
    }

    /// Continues at a byte of the text.
    pub(crate) fn at(self, position: usize) -> Reader {
        Reader { position, ..self }
    }

    /// The byte up to which the text has been read.
    pub(crate) fn position(&self) -> usize {
        self.position
    }

    /// The text.
    pub(crate) fn text(&self) -> &Rc<str> {
        &self.text
    }

    /// The text that has not been read.
    pub(crate) fn rest(&self) -> &str {
        self.text.get(self.position..).unwrap_or("")
    }

    /// Lets a further character end tokens.
    pub(crate) fn with_terminator(mut self, c: char) -> Reader {
        self.terminator = Some(c);
        self
    }

    /// Moves past one blank character, as `read` does after a form.
    pub(crate) fn skip_one_blank(&mut self) {
        if let Some(c) = self
            .text
            .get(self.position..)
            .and_then(|s| s.chars().next())
            && crate::lisp::reader::lexer::is_blank(c)
        {
            self.position += c.len_utf8();
        }
    }

    /// The next form and its place; `None` at the end. `#.` of anything but a constant is
    /// an error here: use [`Reader::next`] where evaluation is possible.
    pub(crate) fn next_form(
        &mut self,
        image: &mut Image,
    ) -> Result<Option<(Value, Place)>, ReadError> {
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
    pub(crate) fn next(&mut self, image: &mut Image) -> Result<Outcome, ReadError> {
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
        let constituents: Vec<char> = readtable
            .map(|table| table.constituents.borrow().iter().copied().collect())
            .unwrap_or_default();
        let mut lexer = Lexer::at(&text, self.position)
            .with_terminators(&terminators)
            .with_constituents(&constituents);
        loop {
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
            if let (Some(readtable), TokenKind::Dispatch { argument, letter }) =
                (readtable, token.kind)
                && let Some(function) = readtable.dispatch_of(letter)
            {
                let number = argument.map_or(Value::NIL, |n| Value::Int(n.into()));
                let arguments = [Value::Char(letter), number];
                return Ok(self.call_macro(token.end, function, &arguments));
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
            text: self.text.clone(),
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
    pub(crate) fn supply(&mut self, image: &mut Image, value: Value) -> Result<Outcome, ReadError> {
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
        self.frames.clear();
        self.values.clear();
        self.labels = Labels::default();
        (self.backquotes, self.skips, self.features) = (0, 0, 0);
        ReadError {
            kind,
            start,
            end,
            place: self.place(image, start, end),
        }
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

    /// Processes a token; returns an outcome if there is one for the caller.
    fn token(
        &mut self,
        image: &mut Image,
        text: &str,
        token: Token,
    ) -> Result<Option<Outcome>, ReadErrorKind> {
        if !token.is_closed {
            let what = match token.kind {
                TokenKind::String => "a string",
                TokenKind::BlockComment => "a block comment",
                TokenKind::Character => "a character",
                TokenKind::Dispatch { .. } => "the dispatch macro #",
                _ => "a symbol",
            };
            return Err(self.end_of_file(what, token.start));
        }
        // The lexer's spans lie on character boundaries of the text.
        let slice = |from: usize, to: usize| text.get(from..to).unwrap_or("");
        let start = token.start;
        let value = match token.kind {
            TokenKind::LineComment | TokenKind::BlockComment => return Ok(None),
            TokenKind::Open => return self.push(Kind::List(Dot::None), start),
            TokenKind::Close => return self.close(image, start, token.end),
            TokenKind::Quote => return self.push(Kind::Wrap(known::QUOTE), start),
            TokenKind::Backquote => return self.push(Kind::Backquote, start),
            TokenKind::Comma => return self.comma(known::UNQUOTE, ",", start),
            TokenKind::CommaAt => return self.comma(known::UNQUOTE_SPLICING, ",@", start),
            TokenKind::CommaDot => return self.comma(known::UNQUOTE_SPLICING, ",.", start),
            TokenKind::Dispatch { argument, letter } => {
                return self.dispatch(argument, letter, start);
            }
            _ if self.skips > 0 && self.features == 0 => {
                if slice(start, token.end) == "." {
                    return Ok(None);
                }
                Value::NIL
            }
            TokenKind::String => literal::string(slice(start + 1, token.end - 1)),
            TokenKind::Character => literal::character(slice(start + 2, token.end))?,
            TokenKind::Atom => match self.atom(image, &escaped(image, slice(start, token.end)))? {
                Some(value) => value,
                None => return Ok(None),
            },
            TokenKind::Prefixed {
                argument,
                letter: '#',
                ..
            } => self.labels.reference(argument)?,
            TokenKind::Prefixed {
                argument,
                letter,
                body,
            } => literal::prefixed(image, argument, letter, slice(body, token.end))?,
        };
        self.deliver(image, value, start, token.end)
    }

    fn push(&mut self, kind: Kind, start: usize) -> Result<Option<Outcome>, ReadErrorKind> {
        match kind {
            Kind::Backquote => self.backquotes += 1,
            Kind::Comma(_) => self.backquotes = self.backquotes.saturating_sub(1),
            Kind::Skip | Kind::Suppressed => self.skips += 1,
            Kind::Feature(_) => self.features += 1,
            _ => {}
        }
        self.frames.push(Frame {
            kind,
            start,
            base: self.values.len(),
        });
        Ok(None)
    }

    fn comma(
        &mut self,
        operator: Sym,
        prefix: &'static str,
        start: usize,
    ) -> Result<Option<Outcome>, ReadErrorKind> {
        if self.backquotes == 0 && self.skips == 0 {
            return Err(ReadErrorKind::CommaOutsideBackquote);
        }
        if operator == known::UNQUOTE_SPLICING {
            let before = match self.frames.last().map(|f| f.kind) {
                Some(Kind::Backquote) => Some("backquote"),
                Some(Kind::List(Dot::Expecting)) => Some("dot"),
                _ => None,
            };
            if let Some(before) = before {
                return Err(ReadErrorKind::NothingToSpliceInto { prefix, before });
            }
        }
        self.push(Kind::Comma(operator), start)
    }

    fn dispatch(
        &mut self,
        argument: Option<u32>,
        letter: char,
        start: usize,
    ) -> Result<Option<Outcome>, ReadErrorKind> {
        let needed = |reason| argument.ok_or(ReadErrorKind::DispatchArgument { letter, reason });
        let kind = match letter {
            '\'' => Kind::Wrap(known::FUNCTION),
            '(' => Kind::Vector(argument),
            '+' => Kind::Feature(true),
            '-' => Kind::Feature(false),
            '.' => Kind::Evaluate,
            'A' => Kind::Array(needed("the number of dimensions")?),
            'S' => Kind::Structure,
            'C' => Kind::Complex,
            'P' => Kind::Pathname,
            '=' => {
                let label = needed("the label")?;
                if self.skips == 0 {
                    self.labels.open(label)?;
                }
                Kind::Label(label)
            }
            '<' | ')' => return Err(ReadErrorKind::IllegalDispatch(letter)),
            c if crate::lisp::reader::lexer::is_blank(c) => {
                return Err(ReadErrorKind::IllegalDispatch(c));
            }
            c => return Err(ReadErrorKind::UnknownDispatch(c)),
        };
        self.push(kind, start)
    }

    /// The value of a symbol or number; `None` for the dot of a pair.
    fn atom(&mut self, image: &mut Image, token: &str) -> Result<Option<Value>, ReadErrorKind> {
        if token.bytes().all(|b| b == b'.') {
            return self.dot(token.len()).map(|()| None);
        }
        let radix = match image.special(known::V_READ_BASE) {
            Value::Int(n @ 2..=36) => *n as u32,
            _ => 10,
        };
        let float_format = image
            .special(known::V_READ_DEFAULT_FLOAT_FORMAT)
            .as_symbol()
            .unwrap_or(known::SINGLE_FLOAT);
        if let Some(number) = parse_number(token, radix, float_format) {
            return number.map(Some);
        }
        let name = symbol::split(token, LetterCase::current(image))?;
        let sym = if self.features > 0 && name.package.is_none() {
            image.keyword(&name.name)
        } else {
            symbol::resolve(image, &name)?
        };
        Ok(Some(sym.into()))
    }

    fn dot(&mut self, length: usize) -> Result<(), ReadErrorKind> {
        if length > 1 {
            return Err(ReadErrorKind::TooManyDots);
        }
        let count = self.values.len();
        match self.frames.last_mut() {
            Some(Frame {
                kind: Kind::List(dot),
                base,
                ..
            }) => match dot {
                Dot::None if *base == count => Err(ReadErrorKind::NothingBeforeDot),
                Dot::None => {
                    *dot = Dot::Expecting;
                    Ok(())
                }
                Dot::Expecting | Dot::Done => Err(ReadErrorKind::DotContext),
            },
            _ => Err(ReadErrorKind::DotContext),
        }
    }

    fn close(
        &mut self,
        image: &mut Image,
        start: usize,
        end: usize,
    ) -> Result<Option<Outcome>, ReadErrorKind> {
        let Some(frame) = self.frames.last() else {
            return Err(ReadErrorKind::UnmatchedClose);
        };
        let (base, opened_at) = (frame.base, frame.start);
        let value = match frame.kind {
            Kind::List(Dot::Expecting) if self.skips == 0 => {
                return Err(ReadErrorKind::NothingAfterDot);
            }
            Kind::List(dot) => {
                let tail = match dot {
                    Dot::Done => self.values.pop().unwrap_or(Value::NIL),
                    _ => Value::NIL,
                };
                let list = Value::list_with_tail(self.values.drain(base..), tail);
                if let Value::Cons(cons) = &list {
                    cons.set_place(self.place(image, opened_at, end));
                }
                list
            }
            Kind::Vector(length) => {
                let items = self.values.drain(base..).collect();
                literal::vector(items, length, self.skips > 0)?
            }
            other => {
                return Err(ReadErrorKind::NothingAfterPrefix {
                    prefix: other
                        .what()
                        .trim_start_matches("the form after ")
                        .to_owned(),
                });
            }
        };
        self.frames.pop();
        self.deliver(image, value, start.min(opened_at), end)
    }

    /// Passes a finished value to the form that it belongs to, which may finish that form, too.
    fn deliver(
        &mut self,
        image: &mut Image,
        mut value: Value,
        mut start: usize,
        end: usize,
    ) -> Result<Option<Outcome>, ReadErrorKind> {
        loop {
            let is_skipped = self.skips > 0;
            let Some(frame) = self.frames.last_mut() else {
                self.labels = Labels::default();
                let place = self.place(image, start, end);
                return Ok(Some(Outcome::Form(value, place)));
            };
            match &mut frame.kind {
                Kind::List(dot) => {
                    match *dot {
                        Dot::None => {}
                        Dot::Expecting => *dot = Dot::Done,
                        Dot::Done => return Err(ReadErrorKind::MoreAfterDot),
                    }
                    self.values.push(value);
                    return Ok(None);
                }
                Kind::Vector(_) => {
                    self.values.push(value);
                    return Ok(None);
                }
                _ => {}
            }
            // Every other frame takes exactly one value.
            let Some(Frame {
                kind, start: at, ..
            }) = self.frames.pop()
            else {
                return Ok(None);
            };
            start = at;
            match kind {
                Kind::List(_) | Kind::Vector(_) => {}
                Kind::Wrap(operator) => value = self.wrap(image, operator, value, start, end),
                Kind::Backquote => {
                    self.backquotes = self.backquotes.saturating_sub(1);
                    value = self.wrap(image, known::QUASIQUOTE, value, start, end);
                }
                Kind::Comma(operator) => {
                    self.backquotes += 1;
                    value = self.wrap(image, operator, value, start, end);
                }
                Kind::Feature(wanted) => {
                    self.features = self.features.saturating_sub(1);
                    if feature::holds(image, &value)? != wanted {
                        self.push(Kind::Skip, at)?;
                    }
                    return Ok(None);
                }
                Kind::Skip => {
                    self.skips = self.skips.saturating_sub(1);
                    return Ok(None);
                }
                Kind::Suppressed => {
                    self.skips = self.skips.saturating_sub(1);
                    value = Value::NIL;
                }
                _ if is_skipped => value = Value::NIL,
                Kind::Evaluate => match read_time_value(image, &value)? {
                    Some(constant) => value = constant,
                    None => return Ok(Some(Outcome::Evaluate(value))),
                },
                Kind::Array(rank) => value = literal::array(&value, rank)?,
                Kind::Structure => match literal::structure(image, &value)? {
                    literal::Structure::Made(made) => value = made,
                    literal::Structure::ToEvaluate(form) => {
                        return Ok(Some(Outcome::Evaluate(form)));
                    }
                },
                Kind::Complex => value = literal::complex(&value)?,
                Kind::Pathname => {
                    if let Some(name) = value.as_text() {
                        // What stands before a colon may be a logical host.
                        if name.contains(':') {
                            let form = Value::list([known::PATHNAME.into(), value]);
                            return Ok(Some(Outcome::Evaluate(form)));
                        }
                        value = Value::foreign(Pathname::parse(&name));
                    }
                }
                Kind::Label(label) => self.labels.close(label, &value)?,
            }
        }
    }

    fn wrap(
        &self,
        image: &mut Image,
        operator: Sym,
        value: Value,
        start: usize,
        end: usize,
    ) -> Value {
        let list = Value::list([operator.into(), value]);
        if let Value::Cons(cons) = &list {
            cons.set_place(self.place(image, start, end));
        }
        list
    }
}

/// The value of a constant form after `#.`; `None` if it has to be evaluated.
fn read_time_value(image: &Image, form: &Value) -> Result<Option<Value>, ReadErrorKind> {
    if image.special(known::V_READ_EVAL).is_nil() {
        return Err(ReadErrorKind::ReadEvalDisabled);
    }
    Ok(match form {
        Value::Cons(_) => None,
        Value::Symbol(sym, ..) => {
            let data = image.symbol(*sym);
            (data.kind == VariableKind::Constant && !data.value.is_unbound())
                .then(|| data.value.clone())
        }
        literal => Some(literal.clone()),
    })
}

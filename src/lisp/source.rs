//! Source texts and places in them.

use std::cell::{OnceCell, RefCell};
use std::collections::HashMap;
use std::ops::Deref;
use std::rc::Rc;
use std::sync::Arc;

use super::visible::visible;

/// Handle of a span of source text; [`Sources`] resolves it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub struct Place(pub u32);

impl Place {
    /// No source text.
    pub const NONE: Place = Place(0);

    /// Is there a source text?
    pub fn is_some(self) -> bool {
        self != Place::NONE
    }
}

/// Set in the handles of places that all copies of an image have in common.
const COMMON: u32 = 1 << 31;

/// Handle of a source text.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct SourceId(pub u32);

/// A text: one of the program itself, or one that came later.
#[derive(Clone, Debug)]
pub enum Text {
    /// A part of the program.
    BuiltIn(&'static str),
    /// Another one.
    Own(Rc<str>),
}

impl Text {
    /// The text as one that several may hold; one of the program is copied.
    pub(crate) fn shared(&self) -> Rc<str> {
        match self {
            Self::BuiltIn(text) => (*text).into(),
            Self::Own(text) => Rc::clone(text),
        }
    }
}

impl Deref for Text {
    type Target = str;

    fn deref(&self) -> &str {
        match self {
            Self::BuiltIn(text) => text,
            Self::Own(text) => text,
        }
    }
}

impl From<Rc<str>> for Text {
    fn from(text: Rc<str>) -> Self {
        Self::Own(text)
    }
}

impl From<String> for Text {
    fn from(text: String) -> Self {
        Self::Own(text.into())
    }
}

impl From<&str> for Text {
    fn from(text: &str) -> Self {
        Self::Own(text.into())
    }
}

/// One text that forms were read from: a file, or an input at the prompt.
#[derive(Clone)]
pub struct Source {
    /// File name, or a name such as `prompt[3]`.
    pub name: Rc<str>,
    /// The whole text.
    pub text: Text,
    /// Is it a part of the language that is written in Lisp?
    is_library: bool,
    /// Byte offset of the start of each line, once that was asked for.
    line_starts: OnceCell<Rc<[u32]>>,
}

impl Source {
    /// Byte offset of the start of each line.
    fn line_starts(&self) -> &[u32] {
        self.line_starts.get_or_init(|| {
            let ends = self.text.match_indices('\n');
            let starts = ends.map(|(i, _)| offset(i + 1));
            std::iter::once(0).chain(starts).collect()
        })
    }
}

/// A source location for display: lines and columns count from one, columns in characters.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Location {
    /// Name of the source.
    pub name: Arc<str>,
    /// Line, from one.
    pub line: usize,
    /// Column, from one, in characters.
    pub column: usize,
    /// The text of that line.
    pub line_text: String,
    /// How many characters of the line the place covers (at least one).
    pub width: usize,
}

impl std::fmt::Display for Location {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let name = visible(&self.name);
        write!(f, "{name}:{}:{}", self.line, self.column)
    }
}

impl Location {
    /// The line with the place underlined by carets, as two lines of text.
    pub fn underlined(&self) -> String {
        let mut chars = self.line_text.chars();
        let mut width_of = |chars_of_line: usize| {
            let part: String = chars.by_ref().take(chars_of_line).collect();
            visible(&part).chars().count().max(chars_of_line)
        };
        let before = width_of(self.column.saturating_sub(1));
        let width = width_of(self.width.max(1));
        format!(
            "{}\n{}{}",
            visible(&self.line_text),
            " ".repeat(before),
            "^".repeat(width)
        )
    }
}

#[derive(Clone, Copy)]
struct Span {
    source: SourceId,
    start: u32,
    end: u32,
}

/// The places of what several images read, each for itself or for all: the first to read it registers them.
#[derive(Default)]
struct CommonPlaces {
    spans: Vec<Span>,
    /// What has been read, by its address, and how many places there were before it.
    read: HashMap<usize, usize>,
}

/// The places of one thing that copies of an image have in common, in the order in which they are asked for.
pub(crate) struct CommonReading {
    common: Rc<RefCell<CommonPlaces>>,
    next: usize,
}

impl CommonReading {
    /// The place of the bytes `start..end` of a source that all copies have.
    pub(crate) fn place(&mut self, source: SourceId, start: usize, end: usize) -> Place {
        let spans = &mut self.common.borrow_mut().spans;
        if self.next == spans.len() {
            spans.push(Span {
                source,
                start: offset(start),
                end: offset(end),
            });
        }
        self.next += 1;
        Place(offset(self.next) | COMMON)
    }
}

/// All source texts of an image, and the places in them.
#[derive(Clone, Default)]
pub struct Sources {
    sources: Vec<Source>,
    spans: Vec<Span>,
    /// The places that copies have in common.
    common: Rc<RefCell<CommonPlaces>>,
    /// Files that have been loaded, and of which nobody has been told yet.
    loaded: RefCell<Vec<SourceId>>,
}

impl Sources {
    /// Adds a text.
    pub fn add(&mut self, name: &str, text: &str) -> SourceId {
        self.add_text(name, text.into(), false)
    }

    /// Adds a text of the program itself.
    pub fn add_built_in(&mut self, name: &str, text: &'static str) -> SourceId {
        self.add_text(name, Text::BuiltIn(text), false)
    }

    /// Adds a text of the part of the language that is written in Lisp.
    pub(crate) fn add_library(&mut self, name: &str, text: &'static str) -> SourceId {
        self.add_text(name, Text::BuiltIn(text), true)
    }

    fn add_text(&mut self, name: &str, text: Text, is_library: bool) -> SourceId {
        let id = SourceId(offset(self.sources.len()));
        self.sources.push(Source {
            name: name.into(),
            text,
            is_library,
            line_starts: OnceCell::new(),
        });
        id
    }

    /// Notes that a text is that of a file that is loaded.
    pub(crate) fn note_loaded(&self, id: SourceId) {
        self.loaded.borrow_mut().push(id);
    }

    /// Names and texts of the files that have been loaded since this was asked last.
    pub fn take_loaded(&self) -> Vec<(Rc<str>, Rc<str>)> {
        let loaded = self.loaded.take().into_iter();
        let sources = loaded.filter_map(|id| self.get(id));
        sources
            .map(|source| (Rc::clone(&source.name), source.text.shared()))
            .collect()
    }

    /// Number of texts.
    pub fn count(&self) -> usize {
        self.sources.len()
    }

    /// Names and texts of programs, those of the language itself left out, from a number on.
    pub fn programs_from(&self, first: usize) -> impl Iterator<Item = (&str, &str)> {
        let sources = self.sources.iter().skip(first);
        sources
            .filter(|source| !source.is_library)
            .map(|source| (&*source.name, &*source.text))
    }

    /// The first text with a name.
    pub(crate) fn named(&self, name: &str) -> Option<SourceId> {
        let at = self
            .sources
            .iter()
            .position(|source| &*source.name == name)?;
        Some(SourceId(offset(at)))
    }

    /// The source text.
    pub fn get(&self, id: SourceId) -> Option<&Source> {
        self.sources.get(id.0 as usize)
    }

    /// Registers the bytes `start..end` of a source as a place.
    pub fn place(&mut self, source: SourceId, start: usize, end: usize) -> Place {
        self.spans.push(Span {
            source,
            start: offset(start),
            end: offset(end),
        });
        Place(offset(self.spans.len()))
    }

    /// Begins to read something that stays where it is, and is the same for this image and all its copies. Whoever reads
    /// it again gets the same places.
    pub(crate) fn read_common(&self, bytes: &'static [u8]) -> CommonReading {
        let mut common = self.common.borrow_mut();
        let next = common.spans.len();
        let next = *common.read.entry(bytes.as_ptr().addr()).or_insert(next);
        CommonReading {
            common: Rc::clone(&self.common),
            next,
        }
    }

    /// Is this a place in a program, not in the part of the language written in Lisp?
    pub fn is_of_program(&self, place: Place) -> bool {
        let source = self.span(place).and_then(|span| self.get(span.source));
        source.is_some_and(|source| !source.is_library)
    }

    /// Are these different places of one text?
    pub(crate) fn are_apart(&self, one: Place, other: Place) -> bool {
        match (self.span(one), self.span(other)) {
            (Some(a), Some(b)) => a.source == b.source && a.start != b.start,
            _ => false,
        }
    }

    /// The text that a place covers.
    pub fn text(&self, place: Place) -> Option<&str> {
        let span = self.span(place)?;
        let source = self.get(span.source)?;
        source.text.get(span.start as usize..span.end as usize)
    }

    /// The place of the bytes `start..end` of the text that a place covers.
    pub fn within(&mut self, place: Place, start: usize, end: usize) -> Option<Place> {
        let span = self.span(place)?;
        let (source, first) = (span.source, span.start as usize);
        Some(self.place(source, first + start, first + end))
    }

    /// Has the text of a place several lines?
    pub fn has_lines(&self, place: Place) -> bool {
        let source = self.span(place).and_then(|span| self.get(span.source));
        source.is_some_and(|source| source.text.trim_end().contains('\n'))
    }

    /// The source of a place, and its first byte there and the byte after it.
    pub fn bytes_of(&self, place: Place) -> Option<(SourceId, u32, u32)> {
        let span = self.span(place)?;
        Some((span.source, span.start, span.end))
    }

    fn span(&self, place: Place) -> Option<Span> {
        let at = ((place.0 & !COMMON) as usize).checked_sub(1)?;
        match place.0 & COMMON {
            0 => self.spans.get(at).copied(),
            _ => self.common.borrow().spans.get(at).copied(),
        }
    }

    /// Line and column of a place.
    pub fn locate(&self, place: Place) -> Option<Location> {
        let span = self.span(place)?;
        let source = self.get(span.source)?;
        let line_starts = source.line_starts();
        let line = line_starts
            .partition_point(|start| *start <= span.start)
            .checked_sub(1)?;
        let line_start = *line_starts.get(line)? as usize;
        let line_text = source.text.get(line_start..)?.lines().next().unwrap_or("");
        let before = source.text.get(line_start..span.start as usize)?;
        let covered = source.text.get(span.start as usize..span.end as usize)?;
        Some(Location {
            name: source.name.as_ref().into(),
            line: line + 1,
            column: before.chars().count() + 1,
            line_text: line_text.to_owned(),
            width: covered.lines().next().unwrap_or("").chars().count().max(1),
        })
    }
}

/// An offset as stored; offsets beyond four gigabytes become the largest one.
fn offset(n: usize) -> u32 {
    u32::try_from(n).unwrap_or(u32::MAX)
}

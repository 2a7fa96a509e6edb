//! What a YAML file says, with the lines on which it says it.

use yaml_rust2::Event;
use yaml_rust2::parser::Parser;

use super::LayoutError;

/// Maximum depth of lists in lists.
const MAX_DEPTH: usize = 64;
/// Maximum number of texts, lists and maps in a file.
const MAX_NODES: usize = 200_000;

/// A value in a file.
#[derive(Clone, Debug)]
pub(super) struct Node {
    /// Its line, from 1.
    pub(super) line: usize,
    pub(super) data: Data,
}

/// What a value is.
#[derive(Clone, Debug)]
pub(super) enum Data {
    Text(String),
    List(Vec<Node>),
    /// In the order of the file.
    Map(Vec<(Node, Node)>),
}

/// A list or map that has begun.
struct Begun {
    line: usize,
    is_map: bool,
    items: Vec<Node>,
}

impl Node {
    /// Reads a file of one document.
    ///
    /// # Errors
    ///
    /// It is not YAML, is empty, is nested too deeply, or refers to another part of itself, which no layout
    /// needs and which would let a short text become an endless one.
    pub(super) fn of_yaml(text: &str) -> Result<Self, LayoutError> {
        let mut parser = Parser::new_from_str(text);
        let mut begun: Vec<Begun> = Vec::new();
        let mut count = 0;
        loop {
            let (event, mark) = parser.next_token().map_err(|error| {
                LayoutError::at(
                    error.marker().line(),
                    format!("this is no YAML: {}", error.info()),
                )
            })?;
            let line = mark.line();
            count += 1;
            if count > MAX_NODES {
                return Err(LayoutError::at(
                    line,
                    "a layout has fewer values than this file",
                ));
            }
            let finished = match event {
                Event::Nothing | Event::StreamStart | Event::DocumentStart | Event::DocumentEnd => {
                    continue;
                }
                Event::StreamEnd => return Err(LayoutError::whole("the file is empty")),
                Event::Alias(_) => {
                    return Err(LayoutError::at(
                        line,
                        "a layout does not refer to other parts of itself (*name)",
                    ));
                }
                Event::Scalar(text, ..) => Self {
                    line,
                    data: Data::Text(text),
                },
                Event::SequenceStart(..) | Event::MappingStart(..) => {
                    if begun.len() >= MAX_DEPTH {
                        return Err(LayoutError::at(line, "this is nested too deeply"));
                    }
                    begun.push(Begun {
                        line,
                        is_map: matches!(event, Event::MappingStart(..)),
                        items: Vec::new(),
                    });
                    continue;
                }
                Event::SequenceEnd | Event::MappingEnd => {
                    let Some(Begun {
                        line,
                        is_map,
                        items,
                    }) = begun.pop()
                    else {
                        continue;
                    };
                    let data = match is_map {
                        true => Data::Map(pairs(items)),
                        false => Data::List(items),
                    };
                    Self { line, data }
                }
            };
            match begun.last_mut() {
                Some(outer) => outer.items.push(finished),
                None => return Ok(finished),
            }
        }
    }

    /// An error at this place.
    pub(super) fn error(&self, text: impl Into<String>) -> LayoutError {
        LayoutError::at(self.line, text)
    }

    /// The entries of a map.
    pub(super) fn entries(&self, what: &str) -> Result<&[(Node, Node)], LayoutError> {
        match &self.data {
            Data::Map(entries) => Ok(entries),
            _ => Err(self.error(format!("{what} is a map of names and values"))),
        }
    }

    /// What a map has under a name; the last one counts.
    pub(super) fn get(&self, name: &str) -> Option<&Node> {
        let Data::Map(entries) = &self.data else {
            return None;
        };
        let mut found = entries.iter().rev().filter(|(key, _)| key.is_text(name));
        found.next().map(|(_, value)| value)
    }

    /// The items of a list.
    pub(super) fn items(&self, what: &str) -> Result<&[Node], LayoutError> {
        match &self.data {
            Data::List(items) => Ok(items),
            _ => Err(self.error(format!("{what} is a list"))),
        }
    }

    /// A text.
    pub(super) fn text(&self, what: &str) -> Result<&str, LayoutError> {
        match &self.data {
            Data::Text(text) => Ok(text),
            _ => Err(self.error(format!("{what} is a name"))),
        }
    }

    fn is_text(&self, wanted: &str) -> bool {
        matches!(&self.data, Data::Text(text) if text == wanted)
    }

    /// Whether nothing is given.
    pub(super) fn is_null(&self) -> bool {
        ["", "~", "null", "Null", "NULL"]
            .iter()
            .any(|null| self.is_text(null))
    }

    /// A finite number.
    pub(super) fn number(&self, what: &str) -> Result<f64, LayoutError> {
        let number = match &self.data {
            Data::Text(text) => text
                .parse()
                .ok()
                .filter(|x: &f64| x.is_finite() && x.abs() < 1e4),
            _ => None,
        };
        number.ok_or_else(|| self.error(format!("{what} is a number (m, or rad)")))
    }

    /// Yes or no.
    pub(super) fn flag(&self, what: &str) -> Result<bool, LayoutError> {
        match &self.data {
            Data::Text(text) if text.eq_ignore_ascii_case("true") => Ok(true),
            Data::Text(text) if text.eq_ignore_ascii_case("false") => Ok(false),
            _ => Err(self.error(format!("{what} is true or false"))),
        }
    }
}

fn pairs(items: Vec<Node>) -> Vec<(Node, Node)> {
    let mut pairs = Vec::with_capacity(items.len() / 2);
    let mut items = items.into_iter();
    while let (Some(key), Some(value)) = (items.next(), items.next()) {
        pairs.push((key, value));
    }
    pairs
}

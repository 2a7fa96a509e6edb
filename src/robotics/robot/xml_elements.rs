//! The elements of an XML text with their positions.
//!
//! The URDF reader says what a file means but not where; this scanner says where each
//! element and attribute stands, and reports text that is not well-formed. It reads
//! only what a URDF needs: tags, attributes, comments, declarations and CDATA.

use std::borrow::Cow;

use super::urdf_error::UrdfProblem;

/// An attribute of an element.
pub(super) struct Attribute<'a> {
    pub name: &'a str,
    /// Without the quotes, references such as `&amp;` replaced by what they stand for.
    pub value: Cow<'a, str>,
    /// Byte offset of the value.
    pub offset: usize,
}

/// An element.
pub(super) struct Element<'a> {
    pub name: &'a str,
    /// Byte offset of its `<`.
    pub offset: usize,
    pub(crate) attributes: Vec<Attribute<'a>>,
    /// Index of the enclosing element.
    pub parent: Option<usize>,
}

impl<'a> Element<'a> {
    /// The attribute with that name.
    pub(crate) fn attribute(&self, name: &str) -> Option<&Attribute<'a>> {
        self.attributes.iter().find(|a| a.name == name)
    }
}

/// Deepest nesting of elements. A URDF needs five; the URDF reader recurses on the stack.
const DEEPEST: usize = 64;

/// All elements of `text` in the order of their start tags, or the byte offset of the
/// first thing that is not well-formed, and what is wrong there.
pub(super) fn elements(text: &str) -> Result<Vec<Element<'_>>, (usize, UrdfProblem)> {
    Scanner {
        text,
        at: 0,
        elements: Vec::new(),
        open: Vec::new(),
    }
    .run()
}

/// The first byte for which something holds.
fn until(text: &str, holds: impl Fn(u8) -> bool) -> Option<usize> {
    text.bytes().position(holds)
}

/// Is it a blank of ASCII?
fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t'..=b'\r')
}

/// The text that stands for itself once its references have been replaced. What is no reference of
/// XML stays as it is.
fn unescaped(text: &str) -> Cow<'_, str> {
    if !text.contains('&') {
        return Cow::Borrowed(text);
    }
    let mut whole = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find('&') {
        whole.push_str(&rest[..at]);
        rest = &rest[at..];
        let found = rest
            .find(';')
            .and_then(|end| Some((referred(&rest[1..end])?, end + 1)));
        let (letter, length) = found.unwrap_or(('&', 1));
        whole.push(letter);
        rest = &rest[length..];
    }
    whole.push_str(rest);
    Cow::Owned(whole)
}

/// The character that a reference stands for; it is given without `&` and `;`.
fn referred(name: &str) -> Option<char> {
    match name {
        "amp" => Some('&'),
        "lt" => Some('<'),
        "gt" => Some('>'),
        "quot" => Some('"'),
        "apos" => Some('\''),
        _ => {
            let number = name.strip_prefix('#')?;
            let code = match number.strip_prefix('x') {
                Some(hex) => u32::from_str_radix(hex, 16),
                None => number.parse(),
            };
            char::from_u32(code.ok()?)
        }
    }
}

struct Scanner<'a> {
    text: &'a str,
    at: usize,
    elements: Vec<Element<'a>>,
    /// Indices of the elements that are open, outermost first.
    open: Vec<usize>,
}

impl<'a> Scanner<'a> {
    fn run(mut self) -> Result<Vec<Element<'a>>, (usize, UrdfProblem)> {
        while let Some(found) = until(self.rest(), |byte| byte == b'<') {
            self.at += found;
            let rest = self.rest();
            match rest.as_bytes().get(1) {
                Some(b'!') if rest.starts_with("<!--") => self.skip("comment", "-->")?,
                Some(b'!') if rest.starts_with("<![CDATA[") => self.skip("CDATA section", "]]>")?,
                Some(b'!') => self.skip("declaration", ">")?,
                Some(b'?') => self.skip("declaration", "?>")?,
                Some(b'/') => self.closing_tag()?,
                _ => self.opening_tag()?,
            }
        }
        match self.open.last() {
            Some(&i) => {
                let element = &self.elements[i];
                Err((
                    element.offset,
                    UrdfProblem::Unclosed(element.name.to_owned()),
                ))
            }
            None => Ok(self.elements),
        }
    }

    fn rest(&self) -> &'a str {
        // `at` only advances by the lengths of matches in the rest.
        &self.text[self.at..]
    }

    /// Moves past the next `end`.
    fn skip(&mut self, what: &'static str, end: &'static str) -> Result<(), (usize, UrdfProblem)> {
        match self.rest().find(end) {
            Some(i) => {
                self.at += i + end.len();
                Ok(())
            }
            None => Err((self.at, UrdfProblem::Unterminated(what, end))),
        }
    }

    /// Moves past the letters of a name.
    fn name(&mut self) -> &'a str {
        let rest = self.rest();
        let is_end =
            |byte| is_blank(byte) || matches!(byte, b'=' | b'<' | b'>' | b'/' | b'"' | b'\'');
        let mut end = until(rest, |byte| is_end(byte) || !byte.is_ascii());
        if end.is_some_and(|end| !rest.as_bytes()[end].is_ascii()) {
            end = rest.find(|c: char| c.is_whitespace() || u8::try_from(c).is_ok_and(is_end));
        }
        let name = &rest[..end.unwrap_or(rest.len())];
        self.at += name.len();
        name
    }

    fn skip_blanks(&mut self) {
        let rest = self.rest();
        let end = until(rest, |byte| !is_blank(byte)).unwrap_or(rest.len());
        self.at += end;
        // Blanks of other scripts are rare.
        if rest
            .as_bytes()
            .get(end)
            .is_some_and(|byte| !byte.is_ascii())
        {
            self.at += rest.len() - end - rest[end..].trim_start().len();
        }
    }

    fn closing_tag(&mut self) -> Result<(), (usize, UrdfProblem)> {
        let start = self.at;
        self.at += 2;
        let name = self.name();
        match self.open.pop().map(|i| &self.elements[i]) {
            None => Err((start, UrdfProblem::StrayClosingTag(name.to_owned()))),
            Some(open) if open.name != name => {
                let line = self.text[..open.offset].matches('\n').count() + 1;
                let problem = UrdfProblem::WrongClosingTag {
                    found: name.to_owned(),
                    expected: open.name.to_owned(),
                    line,
                };
                Err((start, problem))
            }
            Some(_) => self.skip("closing tag", ">"),
        }
    }

    fn opening_tag(&mut self) -> Result<(), (usize, UrdfProblem)> {
        let start = self.at;
        self.at += 1;
        let name = self.name();
        let mut element = Element {
            name,
            offset: start,
            attributes: Vec::new(),
            parent: self.open.last().copied(),
        };
        loop {
            self.skip_blanks();
            let rest = self.rest();
            if rest.starts_with("/>") {
                self.at += 2;
                self.elements.push(element);
                return Ok(());
            }
            if rest.starts_with('>') {
                if self.open.len() >= DEEPEST {
                    let problem = UrdfProblem::TooDeep(name.to_owned(), DEEPEST);
                    return Err((start, problem));
                }
                self.at += 1;
                self.open.push(self.elements.len());
                self.elements.push(element);
                return Ok(());
            }
            if rest.is_empty() {
                return Err((start, UrdfProblem::Unterminated("tag", ">")));
            }
            let offset = self.at;
            let attribute = self.attribute(name)?;
            if element.attribute(attribute.name).is_some() {
                let problem = UrdfProblem::RepeatedAttribute {
                    element: name.to_owned(),
                    attribute: attribute.name.to_owned(),
                };
                return Err((offset, problem));
            }
            element.attributes.push(attribute);
        }
    }

    fn attribute(&mut self, element: &str) -> Result<Attribute<'a>, (usize, UrdfProblem)> {
        let name = self.name();
        self.skip_blanks();
        if !name.is_empty() && self.rest().starts_with('=') {
            self.at += 1;
            self.skip_blanks();
            let rest = self.rest();
            if let Some(&quote @ (b'"' | b'\'')) = rest.as_bytes().first() {
                let value = &rest[1..];
                let Some(end) = until(value, |byte| byte == quote) else {
                    let end = if quote == b'"' { "\"" } else { "'" };
                    return Err((self.at, UrdfProblem::Unterminated("attribute", end)));
                };
                let offset = self.at + 1;
                self.at = offset + end + 1;
                return Ok(Attribute {
                    name,
                    value: unescaped(&value[..end]),
                    offset,
                });
            }
        }
        let problem = UrdfProblem::NotAnAttribute {
            element: element.to_owned(),
            found: self.rest().chars().next().unwrap_or('<'),
        };
        Err((self.at, problem))
    }
}

//! A definition in a file of the library: where it is, and what its text says about it.

use std::rc::Rc;
use std::sync::OnceLock;

use super::Image;
use super::precompiled::{Precompiled, Precompiler, Resolved};
use crate::source::SourceId;
use crate::value::copy::{Copied, Copier};
use crate::value::function::{Deferred, Function};
use crate::value::raise::Raise;
use crate::value::symbol::Sym;

/// A file of the library.
pub struct File {
    /// Its path in the source of the program.
    pub name: &'static str,
    pub text: &'static str,
}

/// What a definition defines.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Kind {
    /// A function.
    Function,
    /// A macro.
    Macro,
    /// What `setf` calls for a place.
    Setter,
    /// Something else, or nothing that has a name.
    Form,
}

/// A form at top level of a file of the library.
pub struct Definition {
    pub file: &'static File,
    /// Its first byte in the file.
    pub start: usize,
    /// The byte after it; blanks and comments that follow it are included.
    pub end: usize,
    /// The package in which it is read, in upper case.
    pub(crate) reading_package: String,
    /// The package of its name, in upper case.
    pub package: String,
    /// Its name, in upper case.
    pub name: String,
    /// What it defines.
    pub kind: Kind,
    signature: OnceLock<Signature>,
}

/// Compiles a definition into the function of a name.
pub(crate) type Compile =
    fn(&mut Image, &'static Definition, Sym) -> Result<Rc<Function>, Box<Raise>>;

/// What an image keeps of the library.
#[derive(Default)]
pub struct Installed {
    /// The definitions, by number.
    pub definitions: Vec<&'static Definition>,
    /// The files that have been read from, by name.
    pub sources: Vec<(&'static str, SourceId)>,
    /// Those that have been compiled, by number.
    compiled: Vec<Option<Rc<Function>>>,
    /// How a definition is compiled.
    pub compile: Option<Compile>,
    /// What has been made ahead of the code of definitions.
    pub precompiled: Option<&'static Precompiled>,
    /// The symbols that it refers to, as far as they have been needed.
    pub resolved: Resolved,
    /// Keeps what definitions are compiled to, if that is wanted.
    pub precompiler: Option<Box<Precompiler>>,
}

impl Image {
    /// The function of a definition; compiles it unless that has already happened.
    pub fn force(&mut self, deferred: &Deferred) -> Result<Rc<Function>, Box<Raise>> {
        if let Some(Some(function)) = self.library.compiled.get(deferred.number) {
            return Ok(function.clone());
        }
        let definition = self.library.definitions.get(deferred.number).copied();
        let (Some(definition), Some(compile)) = (definition, self.library.compile) else {
            return Err(Raise::undefined_function(deferred.name.into()));
        };
        let function = compile(self, definition, deferred.name)?;
        let compiled = &mut self.library.compiled;
        compiled.resize(self.library.definitions.len(), None);
        if let Some(kept) = compiled.get_mut(deferred.number) {
            return Ok(kept.get_or_insert(function).clone());
        }
        Ok(function)
    }
}

impl Copied for Installed {
    fn copied(&self, copier: &mut Copier) -> Installed {
        let compiled = self.compiled.iter();
        Installed {
            definitions: self.definitions.clone(),
            sources: self.sources.clone(),
            compiled: compiled.map(|function| function.copied(copier)).collect(),
            compile: self.compile,
            precompiled: self.precompiled,
            resolved: self.resolved.clone(),
            precompiler: None,
        }
    }
}

/// What the text of a definition tells the user.
#[derive(Default, Debug)]
pub struct Signature {
    /// The lambda list, without its parentheses.
    pub lambda_list: String,
    /// The docstring on one line, without the examples.
    pub doc: String,
    /// The examples in the docstring.
    pub examples: Vec<String>,
}

/// The line of a docstring that introduces its examples.
const EXAMPLES: &str = "Examples:";

impl Definition {
    /// A form that has no name yet.
    pub fn new(file: &'static File, start: usize, end: usize) -> Definition {
        Definition {
            file,
            start,
            end,
            reading_package: String::new(),
            package: String::new(),
            name: String::new(),
            kind: Kind::Form,
            signature: OnceLock::new(),
        }
    }

    /// The text, starting with its opening parenthesis.
    pub fn text(&self) -> &'static str {
        self.file.text.get(self.start..self.end).unwrap_or("")
    }

    /// The line on which it begins, from one.
    pub fn line(&self) -> usize {
        let before = self.file.text.get(..self.start).unwrap_or("");
        1 + before.matches('\n').count()
    }

    /// The location in the form `file:line`.
    pub fn location(&self) -> String {
        format!("{}:{}", self.file.name, self.line())
    }

    /// Is it a helper for the library only?
    pub fn is_helper(&self) -> bool {
        self.name.starts_with('%')
    }

    /// Lambda list, documentation and examples.
    pub fn signature(&self) -> &Signature {
        self.signature.get_or_init(|| read_signature(self.text()))
    }
}

/// Reads what follows the name of a definition.
fn read_signature(text: &str) -> Signature {
    let mut rest = text.strip_prefix('(').unwrap_or(text);
    let operator = take_item(&mut rest);
    // The name.
    take_item(&mut rest);
    let list = take_item(&mut rest);
    let list = list.strip_prefix('(').and_then(|l| l.strip_suffix(')'));
    let mut lambda_list = on_one_line(list.unwrap_or_default()).to_lowercase();
    if operator == "define-modify-macro" {
        // The function that it applies.
        take_item(&mut rest);
        lambda_list = format!("place {lambda_list}").trim_end().to_owned();
    }
    let docstring = take_item(&mut rest);
    let docstring = docstring
        .strip_prefix('"')
        .and_then(|text| text.strip_suffix('"'))
        .map(unescaped)
        .unwrap_or_default();
    let (doc, examples) = split_examples(&docstring);
    Signature {
        lambda_list,
        doc,
        examples,
    }
}

/// The text of a docstring before its examples, on one line, and the examples.
fn split_examples(docstring: &str) -> (String, Vec<String>) {
    let mut lines = docstring.lines().map(str::trim);
    let doc: Vec<&str> = lines
        .by_ref()
        .take_while(|line| *line != EXAMPLES)
        .collect();
    let examples = lines.filter(|line| !line.is_empty()).map(str::to_owned);
    (on_one_line(&doc.join(" ")), examples.collect())
}

fn on_one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Splits a token, a string or a list off the front of a text, with the blanks before it.
pub(crate) fn take_item<'a>(rest: &mut &'a str) -> &'a str {
    let text = rest.trim_start();
    let mut depth = 0_usize;
    let mut in_string = false;
    let mut is_escaped = false;
    let mut end = text.len();
    for (i, c) in text.char_indices() {
        if is_escaped {
            is_escaped = false;
            continue;
        }
        match c {
            '\\' => is_escaped = true,
            '"' => {
                in_string = !in_string;
                if !in_string && depth == 0 {
                    end = i + 1;
                    break;
                }
            }
            _ if in_string => {}
            '(' => depth += 1,
            ')' if depth > 1 => depth -= 1,
            ')' => {
                // The end of the item, or of the list that it is in.
                end = if depth == 1 { i + 1 } else { i };
                break;
            }
            c if depth == 0 && c.is_whitespace() => {
                end = i;
                break;
            }
            _ => {}
        }
    }
    let (item, after) = text.split_at(end);
    *rest = after;
    item
}

fn unescaped(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    let mut chars = text.chars();
    while let Some(c) = chars.next() {
        match c {
            '\\' => plain.extend(chars.next()),
            c => plain.push(c),
        }
    }
    plain
}

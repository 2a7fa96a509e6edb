//! What a function takes, as its lambda list says.

use lisp::builtins::help;
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::symbol::{FunctionCell, Sym};

/// What a function takes; names are in upper case.
#[derive(Default, Debug, PartialEq)]
pub(super) struct Signature {
    /// Required and optional parameters.
    pub positional: Vec<String>,
    /// Keywords, if it takes any.
    pub keys: Option<Vec<String>>,
    /// Does it take keywords that it does not name?
    pub takes_others: bool,
}

/// Parts of a lambda list.
#[derive(Clone, Copy, PartialEq)]
enum Section {
    Positional,
    Rest,
    Key,
    Other,
}

impl Signature {
    /// That of a function, unless it is a generic one, whose methods decide.
    pub(super) fn of(image: &Image, name: Sym) -> Option<Signature> {
        match &image.symbol(name).function {
            FunctionCell::Function(function) if function.as_generic().is_none() => {
                Some(Signature::parse(&help::signature(image, name)?.lambda_list))
            }
            _ => None,
        }
    }

    /// Reads a lambda list, written without its parentheses.
    fn parse(lambda_list: &str) -> Signature {
        let mut signature = Signature::default();
        let mut section = Section::Positional;
        for item in items(lambda_list) {
            match item.to_lowercase().as_str() {
                "&optional" => section = Section::Positional,
                "&rest" | "&body" => section = Section::Rest,
                "&key" => {
                    section = Section::Key;
                    signature.keys.get_or_insert_default();
                }
                "&allow-other-keys" => signature.takes_others = true,
                word if word.starts_with('&') => section = Section::Other,
                _ => match section {
                    Section::Positional => signature.positional.push(name(item)),
                    Section::Key => signature.keys.get_or_insert_default().push(name(item)),
                    Section::Rest | Section::Other => {}
                },
            }
        }
        signature
    }

    /// The arguments of a call that are for named parameters, with the names.
    pub(super) fn arguments<'a>(&'a self, args: &'a [Value]) -> Vec<(&'a str, &'a Value)> {
        self.positional
            .iter()
            .map(String::as_str)
            .zip(args)
            .collect()
    }

    /// The arguments of a call that are keywords and their values.
    pub(super) fn key_arguments<'a>(&self, args: &'a [Value]) -> &'a [Value] {
        match self.keys {
            Some(_) => args.get(self.positional.len()..).unwrap_or_default(),
            None => &[],
        }
    }
}

/// The name of a parameter: `name`, `(name default)` or `((:key name) default)`.
fn name(item: &str) -> String {
    let bare = item.trim_start_matches('(');
    let end = bare.find([' ', ')', '\n']).unwrap_or(bare.len());
    let name = bare.get(..end).unwrap_or(bare);
    // Names of parameters have packages, which keywords leave out.
    name.rsplit(':').next().unwrap_or(name).to_uppercase()
}

/// The words and lists of a text.
fn items(text: &str) -> Vec<&str> {
    let mut items = Vec::new();
    let (mut depth, mut start, mut in_string) = (0_usize, None, false);
    for (at, c) in text.char_indices() {
        match c {
            '"' => in_string = !in_string,
            _ if in_string => {}
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            c if c.is_whitespace() && depth == 0 => {
                if let Some(item) = start.take().and_then(|start| text.get(start..at)) {
                    items.push(item);
                }
                continue;
            }
            _ => {}
        }
        start.get_or_insert(at);
    }
    items.extend(start.and_then(|start| text.get(start..)));
    items
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_parameters_and_keywords_are_found() {
        let names = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
        let signature = Signature::parse(
            "a (b 1) &optional (c '(x y) c-p) &rest r &key (cram-tf::arm '(:left)) ((:k v) 2)",
        );
        assert_eq!(
            signature,
            Signature {
                positional: names(&["A", "B", "C"]),
                keys: Some(names(&["ARM", "K"])),
                takes_others: false,
            }
        );
    }
}

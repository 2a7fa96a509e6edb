//! A doc comment as documentation and examples.
//!
//! A paragraph of examples consists of nothing but examples: a form and what the prompt prints, both
//! as code, with `=>` between them. Code has as many backquotes on each side as it needs, and a
//! space within them if it begins or ends with one. A block of code in `lisp` is an example too, for
//! text with line breaks. All other paragraphs are documentation.

use syn::punctuated::Punctuated;
use syn::{Attribute, Expr, Lit, Meta, Token};

/// What a doc comment says about a builtin.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Doc {
    /// The documentation: each paragraph as one line, with an empty line between two.
    pub(crate) text: String,
    /// Each example as `form => result`.
    pub(crate) examples: Vec<String>,
}

impl Doc {
    /// The documentation and the examples of the doc comment among the attributes.
    pub(crate) fn of(attributes: &[Attribute]) -> Doc {
        let lines: Vec<String> = attributes.iter().filter_map(line).collect();
        Doc::of_text(&lines.join("\n"))
    }

    fn of_text(text: &str) -> Doc {
        let mut doc = Doc {
            text: String::new(),
            examples: Vec::new(),
        };
        let mut lines = text.lines();
        let mut paragraph: Vec<&str> = Vec::new();
        while let Some(line) = lines.next() {
            let line = line.strip_prefix(' ').unwrap_or(line);
            if line == "```lisp" {
                doc.add(&mut paragraph);
                let block = lines
                    .by_ref()
                    .map(|line| line.strip_prefix(' ').unwrap_or(line));
                let block: Vec<&str> = block.take_while(|line| *line != "```").collect();
                doc.examples.push(block.join("\n"));
            } else if line.trim().is_empty() {
                doc.add(&mut paragraph);
            } else {
                paragraph.push(line.trim());
            }
        }
        doc.add(&mut paragraph);
        doc
    }

    /// Adds a paragraph, which is empty afterwards.
    fn add(&mut self, paragraph: &mut Vec<&str>) {
        let text = paragraph.join(" ");
        paragraph.clear();
        if text.is_empty() {
            return;
        }
        if let Some(examples) = examples(&text) {
            self.examples.extend(examples);
            return;
        }
        if !self.text.is_empty() {
            self.text.push_str("\n\n");
        }
        self.text.push_str(&text);
    }
}

/// The text of a line of a doc comment.
fn line(attribute: &Attribute) -> Option<String> {
    match &attribute.meta {
        Meta::NameValue(pair) if pair.path.is_ident("doc") => text(&pair.value),
        _ => None,
    }
}

/// The text of a string or of `concat!` of strings, which macros make.
fn text(expression: &Expr) -> Option<String> {
    match expression {
        Expr::Group(group) => text(&group.expr),
        Expr::Lit(literal) => match &literal.lit {
            Lit::Str(text) => Some(text.value()),
            _ => None,
        },
        Expr::Macro(call) if call.mac.path.is_ident("concat") => {
            let parts = Punctuated::<Expr, Token![,]>::parse_terminated;
            let parts = call.mac.parse_body_with(parts).ok()?;
            parts.iter().map(text).collect()
        }
        _ => None,
    }
}

/// The examples of a paragraph that consists of nothing else.
fn examples(paragraph: &str) -> Option<Vec<String>> {
    let mut examples = Vec::new();
    let mut rest = paragraph;
    while !rest.is_empty() {
        let (form, after) = code(rest)?;
        let (result, after) = code(after.trim_start().strip_prefix("=>")?.trim_start())?;
        examples.push(format!("{form} => {result}"));
        rest = after.trim_start();
    }
    Some(examples)
}

/// The code at the beginning of a text, and what follows it.
fn code(text: &str) -> Option<(&str, &str)> {
    let quotes = text.len() - text.trim_start_matches('`').len();
    let (quote, rest) = text.split_at_checked(quotes).filter(|_| quotes > 0)?;
    // A longer row of backquotes is part of the code.
    let mut end = 0;
    loop {
        let row = rest.get(end..)?.find('`')? + end;
        let after = rest.get(row..)?.trim_start_matches('`');
        end = rest.len() - after.len();
        if end - row == quote.len() {
            let code = rest.get(..row)?;
            let inner = code
                .strip_prefix(' ')
                .and_then(|code| code.strip_suffix(' '));
            return Some((inner.unwrap_or(code), after));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Doc;
    use syn::parse_quote;

    #[test]
    fn macros_may_put_text_together() {
        let doc = Doc::of(&[parse_quote!(#[doc = concat!("The ", "car", ".")])]);
        assert_eq!(doc.text, "The car.");
    }

    fn doc(text: &str) -> (String, Vec<String>) {
        let doc = Doc::of_text(text);
        (doc.text, doc.examples)
    }

    #[test]
    fn paragraphs_are_documentation() {
        let (text, examples) = doc(" The car\n of a `list`.\n\n An error else.");
        assert_eq!(text, "The car of a `list`.\n\nAn error else.");
        assert!(examples.is_empty());
    }

    #[test]
    fn a_paragraph_of_examples_is_no_documentation() {
        let (text, examples) = doc(" Sum.\n\n `(+ 1 2)` => `3`\n `(+)` => `0`");
        assert_eq!(text, "Sum.");
        assert_eq!(examples, ["(+ 1 2) => 3", "(+) => 0"]);
    }

    #[test]
    fn examples_go_on_over_lines() {
        let (_, examples) = doc(" Sum.\n\n `(+ 1\n 2)` =>\n `3`");
        assert_eq!(examples, ["(+ 1 2) => 3"]);
    }

    #[test]
    fn code_holds_shorter_and_longer_rows_of_backquotes() {
        let (_, examples) = doc(" X.\n\n `` `(a ,b) `` => `` ` ``\n ``` (f ``x`` '`) ``` => `1`");
        assert_eq!(examples, ["`(a ,b) => `", "(f ``x`` '`) => 1"]);
    }

    #[test]
    fn a_block_keeps_its_lines() {
        let (text, examples) = doc(" X.\n\n ```lisp\n (f) => \"a\n  b\"\n ```\n Y.");
        assert_eq!(text, "X.\n\nY.");
        assert_eq!(examples, ["(f) => \"a\n b\""]);
    }

    #[test]
    fn code_in_a_sentence_is_documentation() {
        let (text, examples) = doc(" `(f)` => `1` holds.");
        assert_eq!(text, "`(f)` => `1` holds.");
        assert!(examples.is_empty());
    }
}

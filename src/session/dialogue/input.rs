//! Detecting the end of an input.

use lisp::reader::flattened::unflattened;
use lisp::reader::{Completeness, Scanner};

/// Whether the text is a complete input.
pub fn is_whole(text: &str) -> bool {
    GrowingInput::default().is_whole(text)
}

/// Whether the text ends inside a string, a block comment or a symbol in bars, so that whatever follows belongs to
/// that.
pub fn ends_in_quotes(text: &str) -> bool {
    GrowingInput::default().ends_in_quotes(text)
}

/// Tells of an input that comes line by line, after each line, whether it is complete.
#[derive(Default)]
pub struct GrowingInput {
    scanner: Scanner,
}

impl GrowingInput {
    /// Whether the text is a complete input, which is the text of the last time and further lines. One with too many
    /// closing parentheses is complete, but wrong; one whose comments have swallowed what it lacks is complete, too.
    pub fn is_whole(&mut self, text: &str) -> bool {
        let is_open = matches!(self.scanner.scan(text), Completeness::Incomplete { .. });
        !is_open || self.scanner.may_have_lost_code() && unflattened(text).is_some()
    }

    /// Whether the text ends inside a string, a block comment or a symbol in bars.
    pub fn ends_in_quotes(&mut self, text: &str) -> bool {
        let Completeness::Incomplete { opened_at, .. } = self.scanner.scan(text) else {
            return false;
        };
        let begin = text.get(opened_at..).unwrap_or_default();
        ["\"", "|", "#|"]
            .iter()
            .any(|quote| begin.starts_with(quote))
    }
}

#[cfg(test)]
mod tests {
    use crate::dialogue::input::*;

    #[test]
    fn parentheses_in_strings_comments_characters_and_symbols_do_not_count() {
        for text in [
            "",
            "a",
            "1 2",
            "(a) (b)",
            "\"(\"",
            "#\\(",
            "#\\\"",
            "; (",
            "#| ( |# a",
            "|(|",
            "a\\(",
            "(a ; )\n)",
            "#(1 2)",
            "#c(1 2)",
            "`(a ,@b)",
            "#\\Space",
            "#| #| ( |# ( |# a",
            "#'car",
        ] {
            assert!(is_whole(text), "{text}");
        }
        for text in [
            "(",
            "(a (b)",
            "\"",
            "\"a\\\"",
            "#|",
            "#| |",
            "|a",
            "'",
            "#'",
            ",@",
            "(a ; )",
            "#(",
            "' ; quoted\n",
        ] {
            assert!(!is_whole(text), "{text}");
        }
    }

    #[test]
    fn what_follows_an_open_quote_belongs_to_it() {
        for text in ["\"a", "(f \"a\nb", "(f #| a", "(f |a"] {
            assert!(ends_in_quotes(text), "{text}");
        }
        for text in ["(f \"a\"", "(f '", "a", "(f #\\\"", "(f ; \"\n"] {
            assert!(!ends_in_quotes(text), "{text}");
        }
    }

    #[test]
    fn a_parenthesis_that_closes_nothing_ends_the_input() {
        assert!(is_whole(")"));
        assert!(is_whole("(a)) (b"));
    }
}

//! Detecting the end of an input.

use crate::lisp::reader::{Completeness, is_complete};

/// Whether the text is a complete input. One with too many closing parentheses is complete,
/// but wrong.
pub(crate) fn is_whole(text: &str) -> bool {
    !matches!(is_complete(text), Completeness::Incomplete { .. })
}

#[cfg(test)]
mod tests {
    use crate::session::dialogue::input::*;

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
    fn a_parenthesis_that_closes_nothing_ends_the_input() {
        assert!(is_whole(")"));
        assert!(is_whole("(a)) (b"));
    }
}

//! What is known about the name at the cursor.

use super::assistant::Assistant;
use super::context::Context;
use lisp::builtins::help;
use lisp::reader::{Lexer, TokenKind};

impl Assistant<'_> {
    /// All that is known about the name at byte `at` of an input, or about the operator of the
    /// innermost form there.
    pub(crate) fn description_at(&self, text: &str, at: usize) -> Option<String> {
        let context = Context::of(text, at);
        if context.in_string || context.in_comment {
            return None;
        }
        let operator = context.lists.last().and_then(|list| list.operator);
        let mut names = name_at(text, at).into_iter().chain(operator);
        let found = names.find_map(|name| self.symbol_typed(name.trim_start_matches('?')));
        found.map(|sym| help::of_symbol(self.image, sym) + &help::topics_of(self.image, sym))
    }
}

/// The name that the cursor is in or at the end of.
fn name_at(text: &str, at: usize) -> Option<&str> {
    let mut tokens = Lexer::new(text);
    let token = tokens
        .find(|token| token.kind == TokenKind::Atom && (token.start..=token.end).contains(&at))?;
    text.get(token.start..token.end)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_name_around_the_cursor_counts() {
        for (at, name) in [
            (0, None),
            (1, Some("car")),
            (3, Some("car")),
            (4, Some("car")),
        ] {
            assert_eq!(name_at("(car xs)", at), name, "{at}");
        }
        assert_eq!(name_at("(car xs)", 7), Some("xs"));
        assert_eq!(name_at("", 5), None);
    }
}

//! Shorthand for forms, which people type at a prompt.

use super::evaluator::Evaluator;
use crate::dialogue::screen::is_input_name;
use lisp::value::symbol::FunctionCell;

/// What is said to `q` where nothing has stopped.
const NOTHING_STOPPED: &str =
    r#"(progn (format t "; Nothing has stopped; (quit) or Ctrl-D leaves.~%") (values))"#;

impl Evaluator {
    /// The form that an input at a prompt is short for, whoever types it: `?name` asks for
    /// documentation, `help` and the like are calls, `_` is the last value, and the functions of
    /// package `PLANWRIGHT` can be called from every package. A variable with a value is meant as
    /// such.
    pub(crate) fn in_full(&self, source_name: &str, text: &str) -> Option<String> {
        if !is_input_name(source_name) {
            return None;
        }
        self.call_meant(text)
            .or_else(|| self.documentation_asked(text))
            .or_else(|| self.call_of_prompt(text))
    }

    /// A call that is written as in other systems.
    fn call_meant(&self, text: &str) -> Option<String> {
        let word = text.trim();
        let name = word.strip_suffix("()").unwrap_or(word);
        let form = match name.to_lowercase().as_str() {
            "help" | ":help" | ":h" | "?" => "(pw:help)",
            "quit" | "exit" | ":quit" | ":exit" => "(cl-user::quit)",
            "q" | ":q" => NOTHING_STOPPED,
            "_" => "cl:*",
            _ => return None,
        };
        (!self.is_variable(name)).then(|| form.to_owned())
    }

    /// Whether a name is that of a variable with a value in the current package.
    fn is_variable(&self, name: &str) -> bool {
        let current = self.image.current_package();
        let variable = self
            .image
            .packages
            .find_symbol(current, &name.to_uppercase());
        variable.is_some_and(|(sym, _)| !self.image.special(sym).is_unbound())
    }

    /// `(rewind …)` as `(pw:rewind …)` if that name has no meaning in the current package.
    fn call_of_prompt(&self, text: &str) -> Option<String> {
        let rest = text.trim_start().strip_prefix('(')?;
        let end = rest.find(|c: char| c.is_whitespace() || c == ')')?;
        let (name, arguments) = rest.split_at_checked(end)?;
        let upper = name.to_uppercase();
        let (current, own) = (
            self.image.current_package(),
            self.image.packages.find("PLANWRIGHT")?,
        );
        let known = self.image.packages.find_symbol(current, &upper);
        let is_defined = known.is_some_and(|(sym, _)| {
            !matches!(self.image.symbol(sym).function, FunctionCell::Unbound)
        });
        let package = self.image.packages.get(own);
        let is_offered = package
            .symbols
            .get(upper.as_str())
            .is_some_and(|(_, external)| *external);
        (!is_defined && is_offered).then(|| format!("(pw:{name}{arguments}"))
    }

    fn documentation_asked(&self, text: &str) -> Option<String> {
        let name = text.trim().strip_prefix('?')?;
        let is_name = !name.is_empty()
            && name
                .chars()
                .all(|c| !c.is_whitespace() && !"()\"';`,|".contains(c));
        if !is_name {
            return None;
        }
        let is_variable = self.is_variable(text.trim());
        (!is_variable).then(|| format!("(pw:doc {name})"))
    }
}

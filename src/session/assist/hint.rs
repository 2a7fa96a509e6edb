//! The signature of the form being typed.

use super::context::{Context, Open, bare};
use super::designators::{self, Spot};
use super::lower;
use crate::lisp::builtins::help;
use crate::session::Session;

/// Maximum length of a hint in characters.
const LONGEST: usize = 100;

impl Session {
    /// The signature of the form being typed at byte `at`, with the current argument
    /// between two `*`.
    pub(in crate::session) fn hint_at(&self, text: &str, at: usize) -> Option<String> {
        let context = Context::of(text, at);
        if context.in_comment || (context.lists.is_empty()) {
            return None;
        }
        let hint = match designators::spot(&context) {
            Some(Spot::Class) => return None,
            Some(Spot::Key(described)) => {
                let keys = described.keys(&self.image).into_iter();
                let names: Vec<String> = keys.map(|key| lower(&key.name)).collect();
                (!names.is_empty()).then(|| format!("keys: {}", names.join(", ")))
            }
            Some(Spot::Value(described, name)) => {
                let key = described.key(&self.image, name);
                key.map(|key| format!("({} …) {}", lower(&key.name), key.doc))
            }
            None => {
                let list = context.lists.last()?;
                self.keys_of_type(&context)
                    .or_else(|| self.shape_of_call(list))
            }
        };
        hint.map(|hint| shortened(&hint))
    }

    /// The keys of a designator form, between its properties.
    fn keys_of_type(&self, context: &Context<'_>) -> Option<String> {
        let list = context.lists.last()?;
        let name = lower(bare(list.operator?));
        if !matches!(name.as_str(), "a" | "an" | "all") || list.elements < 2 {
            return None;
        }
        let mut inner = context.clone();
        inner.lists.push(Open::default());
        match designators::spot(&inner) {
            Some(Spot::Key(described)) => {
                let keys: Vec<String> = described
                    .keys(&self.image)
                    .into_iter()
                    .map(|key| {
                        let name = lower(&key.name);
                        if key.is_required {
                            format!("({name} …)")
                        } else {
                            format!("[({name} …)]")
                        }
                    })
                    .collect();
                (!keys.is_empty()).then(|| keys.join(" "))
            }
            _ => None,
        }
    }

    fn shape_of_call(&self, list: &Open<'_>) -> Option<String> {
        let name = list.operator?;
        let sym = self.symbol_typed(name)?;
        let signature = help::signature(&self.image, sym)?;
        let words = parameters(&signature.lambda_list);
        let current = current_parameter(&words, list.elements.saturating_sub(1), list.last);
        let mut shape = format!("({}", lower(name));
        for (at, word) in words.iter().enumerate() {
            if Some(at) == current {
                shape.push_str(&format!(" *{word}*"));
            } else {
                shape.push_str(&format!(" {word}"));
            }
        }
        shape.push(')');
        Some(shape)
    }
}

/// The elements of a lambda list.
fn parameters(lambda_list: &str) -> Vec<&str> {
    let mut words = Vec::new();
    let mut depth = 0usize;
    let mut start = None;
    for (at, c) in lambda_list.char_indices() {
        if c.is_whitespace() && depth == 0 {
            if let Some(begin) = start.take() {
                words.extend(lambda_list.get(begin..at));
            }
            continue;
        }
        match c {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ => {}
        }
        start.get_or_insert(at);
    }
    words.extend(start.and_then(|begin| lambda_list.get(begin..)));
    words
}

/// The element of the lambda list to which the argument at that position belongs.
fn current_parameter(words: &[&str], position: usize, last: Option<&str>) -> Option<usize> {
    let mut left = position;
    let mut in_keys = false;
    for (at, word) in words.iter().enumerate() {
        match *word {
            "&optional" | "&allow-other-keys" | "&aux" | "&environment" => {}
            "&rest" | "&body" => return Some(at + 1).filter(|next| *next < words.len()),
            "&key" => in_keys = true,
            word if in_keys => {
                let name = word.trim_matches(['(', ')']).split_whitespace().next()?;
                let wanted = last?.trim_start_matches(':');
                if name.trim_start_matches(':').eq_ignore_ascii_case(wanted) {
                    return Some(at);
                }
            }
            _ if left == 0 => return Some(at),
            _ => left -= 1,
        }
    }
    None
}

fn shortened(text: &str) -> String {
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}…", text.get(..end).unwrap_or(text)),
        None => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_current_parameter_is_found() {
        let words = parameters("pose &optional type (name x) &key color");
        assert_eq!(
            words,
            ["pose", "&optional", "type", "(name x)", "&key", "color"]
        );
        assert_eq!(current_parameter(&words, 0, None), Some(0));
        assert_eq!(current_parameter(&words, 1, None), Some(2));
        assert_eq!(current_parameter(&words, 2, None), Some(3));
        assert_eq!(current_parameter(&words, 4, Some(":color")), Some(5));
        assert_eq!(current_parameter(&words, 3, Some("x")), None);
        let rest = parameters("test &body body");
        assert_eq!(current_parameter(&rest, 5, None), Some(2));
    }
}

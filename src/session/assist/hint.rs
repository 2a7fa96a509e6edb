//! The signature of the form being typed.

use super::assistant::Assistant;
use super::context::{Context, Open, bare};
use super::designators::{self, Spot};
use super::wording::lower;
use crate::dialogue::{current_parameter, parameters};
use lisp::builtins::help;

/// Maximum length of a hint in characters.
const LONGEST: usize = 100;

impl Assistant<'_> {
    /// The signature of the form being typed at byte `at`, with the current argument
    /// between two `*`.
    pub(crate) fn hint_at(&self, text: &str, at: usize) -> Option<String> {
        let context = Context::of(text, at);
        if context.in_comment || (context.lists.is_empty()) {
            return None;
        }
        let hint = match designators::spot(&context) {
            Some(Spot::Class) => return None,
            Some(Spot::Key(described)) => {
                let keys = described.keys(self.image).into_iter();
                let names: Vec<String> = keys.map(|key| lower(&key.name)).collect();
                (!names.is_empty()).then(|| format!("keys: {}", names.join(", ")))
            }
            Some(Spot::Value(described, name)) => {
                let key = described.key(self.image, name);
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
                    .keys(self.image)
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
        let signature = help::signature(self.image, sym)?;
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

fn shortened(text: &str) -> String {
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}…", text.get(..end).unwrap_or(text)),
        None => text.to_owned(),
    }
}

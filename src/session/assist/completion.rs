//! Completions at the cursor.

use super::assistant::Assistant;
use super::context::Context;
use super::designators::{self, Spot};
use super::files;
use crate::dialogue::{Candidate, Completions};

impl Assistant<'_> {
    /// The completions at byte `at` of an input.
    pub(crate) fn complete(&self, text: &str, at: usize) -> Completions {
        let context = Context::of(text, at);
        if context.in_comment {
            return Completions::default();
        }
        if context.in_string {
            return files::completions(&*self.image.files, context.word, context.word_start);
        }
        // `?name` alone asks for documentation.
        if context.lists.is_empty() && context.word.starts_with('?') {
            return self.complete_question(&context);
        }
        let special = match designators::spot(&context) {
            Some(Spot::Class) => designators::classes(),
            Some(Spot::Key(described)) => designators::keys(self.image, &described),
            Some(Spot::Value(described, key)) => self.values_of_key(&described, key, &context),
            None => Vec::new(),
        };
        let word = context.word.trim_start_matches(':').to_lowercase();
        let colon = if context.word.starts_with(':') {
            ":"
        } else {
            ""
        };
        let fits = |c: &Candidate| c.text.to_lowercase().starts_with(&word);
        let mut candidates: Vec<Candidate> = special.into_iter().filter(fits).collect();
        for candidate in &mut candidates {
            if !colon.is_empty() {
                candidate.text.insert_str(0, colon);
            }
        }
        if candidates.is_empty() {
            candidates = self.names(&context);
        }
        Completions {
            start: context.word_start,
            candidates,
        }
    }

    fn complete_question(&self, context: &Context<'_>) -> Completions {
        let rest = context.word.get(1..).unwrap_or("");
        let asked = Context {
            lists: Vec::new(),
            word: rest,
            word_start: context.word_start + 1,
            ..context.clone()
        };
        let mut candidates = self.names(&asked);
        let own = self.names(context).into_iter();
        candidates.extend(own.filter_map(|mut c| {
            c.text = c.text.strip_prefix('?')?.to_owned();
            Some(c)
        }));
        Completions {
            start: asked.word_start,
            candidates,
        }
    }
}

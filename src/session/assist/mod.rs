//! Help while typing: completion, and the signature of the form being typed. Both read the
//! tables and the image without changing anything.

mod completion;
mod context;
mod definitions;
mod description;
mod designators;
mod files;
mod hint;
mod locals;
mod names;
mod symbols;
mod uses;

pub(super) use names::ToldNames;

use super::Session;
use cram::designator::schema;
use cram::designator::value::Class;

/// A name as users type it.
fn lower(name: &str) -> String {
    name.to_lowercase()
}

/// The first sentence of a text, on one line.
fn first_sentence(text: &str) -> String {
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    match line.find(". ") {
        Some(end) => line.get(..=end).unwrap_or(&line).to_owned(),
        None => line,
    }
}

impl Session {
    /// Whether the name is that of a type of action, motion or object.
    pub(super) fn is_type_name(&self, name: &str) -> bool {
        let upper = name.to_uppercase();
        let mut described = [Class::Action, Class::Motion].into_iter();
        described.any(|class| schema::is_type(&self.image, class, &upper))
            || self
                .host
                .simulation
                .object_types()
                .get(&lower(name))
                .is_some()
    }
}

//! One type of action or motion, and one of its keys.

use std::borrow::Cow;

use super::Kind;
use crate::designator::value::Class;
use lisp::value::symbol::Sym;

/// A name or a text in a row: either built in, or from a definition that was evaluated.
pub type Text = Cow<'static, str>;

/// One key.
#[derive(Clone, Debug)]
pub struct Key {
    /// The name in upper case.
    pub name: Text,
    /// Other names for it.
    pub aliases: Vec<Text>,
    /// The kind of its value.
    pub kind: Kind,
    /// Whether it is required.
    pub is_required: bool,
    /// What it means.
    pub doc: Text,
}

impl Key {
    /// Whether this is the key's name or one of its aliases.
    pub fn is_named(&self, name: &str) -> bool {
        self.name == name || self.aliases.iter().any(|alias| alias == name)
    }

    /// Its names, aliases last.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        std::iter::once(&self.name)
            .chain(&self.aliases)
            .map(|name| &**name)
    }
}

/// One type of action or motion.
#[derive(Clone, Debug)]
pub struct TypeRow {
    /// Action or motion.
    pub class: Class,
    /// The type's name in upper case.
    pub name: Text,
    /// Which of several rows with that name this is; they are distinguished by the keys they
    /// require.
    pub variant: Option<Text>,
    /// Other names for it.
    pub aliases: Vec<Text>,
    /// The function that is an action's plan; `NIL` for a motion, which has none.
    pub plan: Sym,
    /// The keys that it reads.
    pub keys: Vec<Key>,
    /// At least one of these keys is required; none if the list is empty.
    pub one_of: Vec<Text>,
    /// Whether a designator that lacks required keys is treated as one of an unknown type.
    pub is_known_by_keys: bool,
    /// What it does.
    pub doc: Text,
    /// An example of a designator of the type.
    pub example: Option<Text>,
}

impl TypeRow {
    /// Whether this is the type's name or one of its aliases.
    pub fn is_named(&self, name: &str) -> bool {
        self.names().any(|known| known == name)
    }

    /// Its names, aliases last.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        std::iter::once(&self.name)
            .chain(&self.aliases)
            .map(|name| &**name)
    }

    /// The key of that name.
    pub fn key(&self, name: &str) -> Option<&Key> {
        self.keys.iter().find(|key| key.is_named(name))
    }

    /// All key names, with aliases.
    pub(crate) fn key_names(&self) -> impl Iterator<Item = &str> {
        self.keys.iter().flat_map(Key::names)
    }

    /// What is required but missing, as shown to users: a key, or one of several.
    pub(crate) fn lacking(&self, is_there: impl Fn(&str) -> bool) -> Option<String> {
        let is_given = |key: &Key| key.names().any(&is_there);
        if let Some(key) = self.keys.iter().find(|k| k.is_required && !is_given(k)) {
            let meaning = match &*key.doc {
                "" => String::new(),
                doc => format!(": {doc}"),
            };
            return Some(format!("({} …){meaning}", key.name.to_lowercase()));
        }
        let mut choices = self.one_of.iter().filter_map(|name| self.key(name));
        if self.one_of.is_empty() || choices.any(is_given) {
            return None;
        }
        let names: Vec<String> = self.one_of.iter().map(|n| n.to_lowercase()).collect();
        Some(format!("one of {}", names.join(", ")))
    }

    /// The syntax of a designator of the type; optional keys are in brackets.
    pub fn shape(&self) -> String {
        let article = match self.class {
            Class::Motion => "a motion",
            _ => "an action",
        };
        let mut shape = format!("({article} (type {})", self.name.to_lowercase());
        for key in &self.keys {
            let name = key.name.to_lowercase();
            shape.push_str(&match key.is_required {
                true => format!(" ({name} …)"),
                false => format!(" [({name} …)]"),
            });
        }
        shape.push(')');
        shape
    }
}

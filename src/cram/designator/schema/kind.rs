//! The kinds of values that keys of designators take, and their names in `def-action`.

use std::borrow::Cow;

use closest_name::closest_name;

/// The kind of value that a key takes.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Kind {
    /// A location designator.
    Location,
    /// A location designator, or a pose, which stands for the location at that pose.
    Place,
    /// An object designator.
    Object,
    /// The designator of a detected object.
    DetectedObject,
    /// An object designator or a list of them.
    Objects,
    /// A real number.
    Number,
    /// A keyword or a list of keywords.
    Keywords,
    /// A keyword.
    Keyword,
    /// One of these keywords; upper case.
    Member(Vec<Cow<'static, str>>),
    /// A symbol.
    Symbol,
    /// A string.
    Text,
    /// A list.
    List,
    /// A pose, or a list of poses.
    Poses,
    /// A pose with a frame.
    PoseStamped,
    /// A keyword or an object designator.
    KeywordOrObject,
    /// An action designator.
    Action,
    /// Anything.
    Anything,
}

/// The kinds by the names used in definitions, each with a description.
static KINDS: &[(&str, Kind, &str)] = &[
    ("LOCATION", Kind::Location, "a location"),
    ("PLACE", Kind::Place, "a location or a pose"),
    ("OBJECT", Kind::Object, "an object"),
    (
        "DETECTED-OBJECT",
        Kind::DetectedObject,
        "an object that was detected",
    ),
    ("OBJECTS", Kind::Objects, "an object, or a list of them"),
    ("NUMBER", Kind::Number, "a number"),
    ("KEYWORDS", Kind::Keywords, "a keyword, or a list of them"),
    ("KEYWORD", Kind::Keyword, "a keyword"),
    ("SYMBOL", Kind::Symbol, "a symbol"),
    ("STRING", Kind::Text, "a string"),
    ("LIST", Kind::List, "a list"),
    ("POSES", Kind::Poses, "a pose, or a list of them"),
    ("POSE", Kind::PoseStamped, "a pose with a frame"),
    (
        "KEYWORD-OR-OBJECT",
        Kind::KeywordOrObject,
        "a keyword or an object",
    ),
    ("ACTION", Kind::Action, "an action"),
    ("T", Kind::Anything, "anything"),
];

impl Kind {
    /// The kind with that name in definitions, which does not include `(member …)`.
    pub fn named(name: &str) -> Option<Kind> {
        KINDS
            .iter()
            .find(|(known, ..)| *known == name)
            .map(|(_, kind, _)| kind.clone())
    }

    /// The names that can be used in definitions.
    pub fn names() -> impl Iterator<Item = &'static str> {
        KINDS.iter().map(|(name, ..)| *name)
    }

    /// The name of a kind that was probably meant.
    pub(crate) fn nearest_name(name: &str) -> Option<&'static str> {
        closest_name(name, Kind::names())
    }

    /// What the key takes, as shown to users.
    pub fn taken(&self) -> Cow<'static, str> {
        if let Kind::Member(members) = self {
            let names: Vec<String> = members.iter().map(|m| m.to_lowercase()).collect();
            return Cow::Owned(format!("one of {}", names.join(", ")));
        }
        let row = KINDS.iter().find(|(_, kind, _)| kind == self);
        Cow::Borrowed(row.map_or("anything", |(_, _, doc)| doc))
    }
}

//! The keys of object and location designators, which do not depend on their types.

use std::borrow::Cow;

use super::{Key, Kind};

const fn optional(name: &'static str, kind: Kind, doc: &'static str) -> Key {
    Key {
        name: Cow::Borrowed(name),
        aliases: Vec::new(),
        kind,
        is_required: false,
        doc: Cow::Borrowed(doc),
    }
}

/// Keys of object designators.
pub static OBJECT_KEYS: &[Key] = &[
    optional("TYPE", Kind::Keyword, "the type"),
    optional("NAME", Kind::Symbol, "the name in the world"),
    optional("URDF-NAME", Kind::Symbol, "the name of a link"),
    optional("PART-OF", Kind::Keyword, "what it is a part of"),
    optional("COLOR", Kind::Anything, "the colour"),
    optional("SIZE", Kind::Anything, "the size"),
    optional("POSE", Kind::Anything, "where it was seen"),
    optional("LOCATION", Kind::Anything, "where it is"),
    optional("CAD-MODEL", Kind::Anything, "a model of its shape"),
];

/// Keys of location designators.
pub static LOCATION_KEYS: &[Key] = &[
    optional("POSE", Kind::PoseStamped, "the pose itself"),
    optional("POSES", Kind::Poses, "the poses, in this order"),
    optional("OBJECT", Kind::Object, "the object to reach or see"),
    optional("ARM", Kind::Keywords, "the arms one of which is to reach"),
    optional(
        "GRASP",
        Kind::Keywords,
        "the grasps one of which is to be possible",
    ),
    optional("OF", Kind::Anything, "the object whose location it is"),
    optional("ON", Kind::Anything, "the surface it is on"),
    optional("IN", Kind::Anything, "the container it is in"),
    optional("ABOVE", Kind::Anything, "what it is above of"),
    optional("LOCATION", Kind::Anything, "the location to reach or see"),
    optional("REACHABLE-FOR", Kind::Anything, "who is to reach it"),
    optional("VISIBLE-FOR", Kind::Anything, "who is to see it"),
    optional("SIDE", Kind::Anything, "left, right, front or back"),
    optional("RANGE", Kind::Anything, "how far away at most (m)"),
    optional(
        "LEVEL",
        Kind::Anything,
        "which board: topmost, middle, bottommost, or its number from below",
    ),
    optional(
        "LEVEL-INVERT",
        Kind::Anything,
        "which board, counted from above",
    ),
    optional(
        "THRESHOLD",
        Kind::Number,
        "how exactly left-of, right-of, in-front-of and behind are meant, 0 to 1",
    ),
    optional(
        "REACHABLE-FROM",
        Kind::Anything,
        "robot, or the base pose from which it is to be within reach",
    ),
    optional(
        "ATTACHMENT",
        Kind::Anything,
        "how it is fixed to what it is on",
    ),
    optional("Z-OFFSET", Kind::Number, "how high above it (m)"),
    optional(
        "ORIENTATION",
        Kind::Keyword,
        "support-aligned, axis-aligned, random or upside-down",
    ),
    optional("RANGE-INVERT", Kind::Anything, "how far away at least (m)"),
    optional(
        "CENTERED-WITH-PADDING",
        Kind::Anything,
        "how far from the edges (m)",
    ),
    optional("LEFT-OF", Kind::Anything, "what it is left of"),
    optional("RIGHT-OF", Kind::Anything, "what it is right of"),
    optional("IN-FRONT-OF", Kind::Anything, "what it is in front of"),
    optional("BEHIND", Kind::Anything, "what it is behind of"),
    optional("NEAR", Kind::Anything, "what it is near to"),
    optional("FAR-FROM", Kind::Anything, "what it is far from"),
    optional(
        "DISTANCE",
        Kind::Number,
        "how far open (m or rad) what is to be opened or closed from there is to be",
    ),
    optional("FOR", Kind::Anything, "what it is for"),
    optional("CONTEXT", Kind::Anything, "what it is used for"),
    optional(
        "OBJECT-COUNT",
        Kind::Anything,
        "how many objects are to fit",
    ),
];

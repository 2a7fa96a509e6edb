//! Descriptions of types of motions and of their keys.

use super::argument::ArgumentKind;

/// A type of motions.
#[derive(Clone, Copy, Debug)]
pub struct MotionType {
    /// The name in upper case.
    pub name: &'static str,
    /// Other names for it.
    pub aliases: &'static [&'static str],
    /// What it takes.
    pub keys: &'static [MotionKey],
    /// At least one of these keys is required; none if the list is empty.
    pub one_of: &'static [&'static str],
    /// Failures are about the value of the first of these keys that is given, or else about the
    /// motion as a whole.
    pub about: &'static [&'static str],
    /// Whether a motion that lacks required keys is treated as one of an unknown type.
    pub is_known_by_keys: bool,
    /// What it does.
    pub doc: &'static str,
    /// A motion of the type, as plans write it.
    pub example: &'static str,
}

/// A key of a type of motions.
#[derive(Clone, Copy, Debug)]
pub struct MotionKey {
    /// The name in upper case.
    pub name: &'static str,
    /// Other names for it.
    pub aliases: &'static [&'static str],
    /// What it takes.
    pub kind: ArgumentKind,
    /// Whether it is required.
    pub is_required: bool,
    /// What it means.
    pub doc: &'static str,
}

impl MotionKey {
    /// A required key.
    pub(super) const fn required(
        name: &'static str,
        kind: ArgumentKind,
        doc: &'static str,
    ) -> MotionKey {
        MotionKey {
            name,
            aliases: &[],
            kind,
            is_required: true,
            doc,
        }
    }

    /// An optional key.
    pub(super) const fn optional(
        name: &'static str,
        kind: ArgumentKind,
        doc: &'static str,
    ) -> MotionKey {
        MotionKey {
            is_required: false,
            ..MotionKey::required(name, kind, doc)
        }
    }

    /// The key with aliases.
    pub(super) const fn also(self, aliases: &'static [&'static str]) -> MotionKey {
        MotionKey { aliases, ..self }
    }
}

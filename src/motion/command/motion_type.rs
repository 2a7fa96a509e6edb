//! Descriptions of types of motions and of their keys.

use super::ArgumentKind;

/// A type of motions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MotionType {
    /// The name in upper case.
    pub(crate) name: &'static str,
    /// Other names for it.
    pub(crate) aliases: &'static [&'static str],
    /// What it takes.
    pub(crate) keys: &'static [MotionKey],
    /// At least one of these keys is required; none if the list is empty.
    pub(crate) one_of: &'static [&'static str],
    /// Failures are about the value of the first of these keys that is given, or else about the
    /// motion as a whole.
    pub(crate) about: &'static [&'static str],
    /// Whether a motion that lacks required keys is treated as one of an unknown type.
    pub(crate) is_known_by_keys: bool,
    /// What it does.
    pub(crate) doc: &'static str,
    /// A motion of the type, as plans write it.
    pub(crate) example: &'static str,
}

/// A key of a type of motions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MotionKey {
    /// The name in upper case.
    pub(crate) name: &'static str,
    /// Other names for it.
    pub(crate) aliases: &'static [&'static str],
    /// What it takes.
    pub(crate) kind: ArgumentKind,
    /// Whether it is required.
    pub(crate) is_required: bool,
    /// What it means.
    pub(crate) doc: &'static str,
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

//! What is known of a type of motions, and of its keys.

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
    /// Of these keys at least one must be there; none if the list is empty.
    pub(crate) one_of: &'static [&'static str],
    /// Failures are about the value of the first of these keys that is there; else about the
    /// motion as a whole.
    pub(crate) about: &'static [&'static str],
    /// Does nobody take the motion who does not find the keys that are needed?
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
    /// Must it be there?
    pub(crate) is_required: bool,
    /// What it means.
    pub(crate) doc: &'static str,
}

impl MotionKey {
    /// A key that must be there.
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

    /// A key that need not be there.
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

    /// The key with other names.
    pub(super) const fn also(self, aliases: &'static [&'static str]) -> MotionKey {
        MotionKey { aliases, ..self }
    }
}

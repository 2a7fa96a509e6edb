//! The body that a primitive belongs to, small enough to be stored with every primitive.

use crate::robot::LinkId;

/// The owner of a primitive. Links are numbered as in their tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum PartKey {
    /// The floor.
    Floor,
    /// A link of the kitchen, by its index in the tree.
    Furniture(u32),
    /// A link of the robot, by its index in the tree.
    Robot(u32),
    /// An object, by the number assigned when it was spawned. Numbers are never reused.
    Object(u32),
    /// A grain; all are the same.
    Grain,
}

impl PartKey {
    /// The key as one number; [`PartKey::from_code`] is the inverse.
    pub fn code(self) -> u64 {
        let (kind, index) = match self {
            Self::Floor => (0, 0),
            Self::Furniture(i) => (1, i),
            Self::Robot(i) => (2, i),
            Self::Object(i) => (3, i),
            Self::Grain => (4, 0),
        };
        (kind << 32) | u64::from(index)
    }

    /// The key with that number; numbers that belong to no key count as the floor.
    pub(crate) fn from_code(code: u64) -> Self {
        // The low half is the index by construction.
        let index = (code & u64::from(u32::MAX)) as u32;
        match code >> 32 {
            1 => Self::Furniture(index),
            2 => Self::Robot(index),
            3 => Self::Object(index),
            4 => Self::Grain,
            _ => Self::Floor,
        }
    }
}

/// The link's index in its tree, as used in keys.
pub(super) fn index(link: LinkId) -> u32 {
    // A tree of four billion links does not fit into memory.
    u32::try_from(link.index()).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::PartKey;

    #[test]
    fn a_key_survives_being_a_number() {
        let keys = [
            PartKey::Floor,
            PartKey::Furniture(7),
            PartKey::Robot(87),
            PartKey::Object(u32::MAX),
            PartKey::Grain,
        ];
        assert_eq!(keys.map(|k| PartKey::from_code(k.code())), keys);
    }
}

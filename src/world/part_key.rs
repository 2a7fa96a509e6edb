//! Which body a primitive belongs to, small enough to be carried by every primitive.

use crate::robot::LinkId;

/// The owner of a primitive. Links are counted as in their tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum PartKey {
    /// The floor.
    Floor,
    /// A link of the kitchen, by its place in the tree.
    Furniture(u32),
    /// A link of the robot, by its place in the tree.
    Robot(u32),
    /// An object, by the number that it got when it appeared. Numbers are not used twice.
    Object(u32),
}

impl PartKey {
    /// The key as one number, and back by [`PartKey::from_code`].
    pub(crate) fn code(self) -> u64 {
        let (kind, index) = match self {
            Self::Floor => (0, 0),
            Self::Furniture(i) => (1, i),
            Self::Robot(i) => (2, i),
            Self::Object(i) => (3, i),
        };
        (kind << 32) | u64::from(index)
    }

    /// The key of the number; numbers that no key has count as the floor.
    pub(crate) fn from_code(code: u64) -> Self {
        // The low half is the index by construction.
        let index = (code & u64::from(u32::MAX)) as u32;
        match code >> 32 {
            1 => Self::Furniture(index),
            2 => Self::Robot(index),
            3 => Self::Object(index),
            _ => Self::Floor,
        }
    }
}

/// The link's place in its tree as keys count it.
pub(crate) fn index(link: LinkId) -> u32 {
    // A tree of four milliard links does not fit into memory.
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
        ];
        assert_eq!(keys.map(|k| PartKey::from_code(k.code())), keys);
    }
}

//! Pairs of bodies that are expected to touch during a motion.

use super::body_name::BodyName;

/// Pairs that collision queries ignore, such as the fingers and the object to grasp, or
/// an object and the surface it stands on.
///
/// An object that is attached to a gripper needs no entry for that gripper: the two are
/// expected to touch.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct AllowedPairs {
    pairs: Vec<(BodyName, BodyName)>,
}

impl AllowedPairs {
    /// No pair may touch.
    pub(crate) fn none() -> Self {
        Self::default()
    }

    /// Also allows the two to touch, in either order.
    #[must_use]
    pub(crate) fn and(mut self, a: BodyName, b: BodyName) -> Self {
        self.pairs.push((a, b));
        self
    }

    /// Also allows each of the bodies to touch `other`.
    #[must_use]
    pub(crate) fn and_all(
        mut self,
        bodies: impl IntoIterator<Item = BodyName>,
        other: &BodyName,
    ) -> Self {
        self.pairs
            .extend(bodies.into_iter().map(|b| (b, other.clone())));
        self
    }

    /// All pairs, in the order in which they were added.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &(BodyName, BodyName)> {
        self.pairs.iter()
    }
}

//! Pairs of bodies that are expected to touch during a motion.

use std::sync::Arc;

use super::body_name::BodyName;

/// Pairs that collision queries ignore, such as the fingers and the object to grasp, or
/// an object and the surface it stands on.
///
/// An object that is attached to a gripper needs no entry for that gripper: the two are
/// expected to touch.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AllowedPairs {
    pairs: Arc<Vec<(BodyName, BodyName)>>,
}

impl AllowedPairs {
    /// No pair may touch.
    pub fn none() -> Self {
        Self::default()
    }

    /// Also allows the two to touch, in either order.
    #[must_use]
    pub fn and(mut self, a: BodyName, b: BodyName) -> Self {
        Arc::make_mut(&mut self.pairs).push((a, b));
        self
    }

    /// Also allows each of the bodies to touch `other`.
    #[must_use]
    pub fn and_all(mut self, bodies: impl IntoIterator<Item = BodyName>, other: &BodyName) -> Self {
        let pairs = bodies.into_iter().map(|b| (b, other.clone()));
        Arc::make_mut(&mut self.pairs).extend(pairs);
        self
    }

    /// Whether both are the same list, which is quick to tell; equal lists need not be.
    pub fn is_same(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.pairs, &other.pairs)
    }

    /// All pairs, in the order in which they were added.
    pub fn iter(&self) -> impl Iterator<Item = &(BodyName, BodyName)> {
        self.pairs.iter()
    }
}

//! Identifiers of the links and joints of a tree.

use serde::Serialize;

/// A link of one [`KinematicTree`](super::KinematicTree).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
pub struct LinkId(pub(super) usize);

impl LinkId {
    /// Index of the link in [`KinematicTree::links`](super::KinematicTree::links).
    pub fn index(self) -> usize {
        self.0
    }
}

/// A joint of one [`KinematicTree`](super::KinematicTree).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct JointId(pub(super) usize);

impl JointId {
    /// Index of the joint in [`KinematicTree::joints`](super::KinematicTree::joints).
    pub fn index(self) -> usize {
        self.0
    }
}

//! Identifiers of the links and joints of a tree.

use serde::Serialize;

/// A link of one [`KinematicTree`](super::KinematicTree).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
pub(crate) struct LinkId(pub(super) usize);

impl LinkId {
    /// Index of the link in [`KinematicTree::links`](super::KinematicTree::links).
    pub(crate) fn index(self) -> usize {
        self.0
    }
}

/// A joint of one [`KinematicTree`](super::KinematicTree).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct JointId(pub(super) usize);

impl JointId {
    /// Index of the joint in [`KinematicTree::joints`](super::KinematicTree::joints).
    pub(crate) fn index(self) -> usize {
        self.0
    }
}

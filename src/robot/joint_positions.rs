//! One position per joint of a kinematic tree.

use super::JointId;

/// Positions of the joints of one [`KinematicTree`](super::KinematicTree): rad for
/// revolute and continuous joints, m for prismatic ones, nothing of interest for fixed ones.
///
/// The entry of a joint that mimics another is not looked at; ask
/// [`KinematicTree::position`](super::KinematicTree::position) for what it really is.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct JointPositions(Vec<f64>);

impl JointPositions {
    /// Every joint at zero.
    pub(crate) fn zero(joint_count: usize) -> Self {
        Self(vec![0.0; joint_count])
    }

    /// Position that was set for the joint (rad or m); zero for a joint of another tree.
    pub(crate) fn get(&self, joint: JointId) -> f64 {
        self.0.get(joint.index()).copied().unwrap_or(0.0)
    }

    /// Sets the position of the joint (rad or m); no limit is applied.
    pub(crate) fn set(&mut self, joint: JointId, position: f64) {
        if joint.index() >= self.0.len() {
            self.0.resize(joint.index() + 1, 0.0);
        }
        self.0[joint.index()] = position;
    }

    /// All positions in the order of [`JointId::index`].
    pub(crate) fn as_slice(&self) -> &[f64] {
        &self.0
    }
}

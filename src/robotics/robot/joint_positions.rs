//! One position per joint of a kinematic tree.

use serde::{Deserialize, Serialize};

use super::ids::JointId;

/// Positions of the joints of one [`KinematicTree`](super::KinematicTree): rad for
/// revolute and continuous joints, m for prismatic ones, unused for fixed ones.
///
/// The entry of a joint that mimics another is ignored; use
/// [`KinematicTree::position`](super::KinematicTree::position) to get its actual position.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct JointPositions(Vec<f64>);

impl JointPositions {
    /// Every joint at zero.
    pub fn zero(joint_count: usize) -> Self {
        Self(vec![0.0; joint_count])
    }

    /// Position set for the joint (rad or m); zero for a joint of another tree.
    pub fn get(&self, joint: JointId) -> f64 {
        self.0.get(joint.index()).copied().unwrap_or(0.0)
    }

    /// Sets the position of the joint (rad or m); no limit is applied.
    pub fn set(&mut self, joint: JointId, position: f64) {
        if joint.index() >= self.0.len() {
            self.0.resize(joint.index() + 1, 0.0);
        }
        self.0[joint.index()] = position;
    }

    /// All positions in the order of [`JointId::index`].
    pub fn as_slice(&self) -> &[f64] {
        &self.0
    }
}

//! The joints and links that motions work with.

use crate::motion::Side;
use crate::robot::{ArmKinematics, JointId, LinkId};
use crate::spatial::Pose;

/// One arm with its hand.
#[derive(Clone, Debug, PartialEq)]
pub struct ArmBody {
    /// Inverse kinematics from the torso's link to the wrist.
    pub kinematics: ArmKinematics,
    /// The wrist: the tip of the kinematics.
    pub wrist: LinkId,
    /// Distance (m) of the tool centre point from the wrist, along the wrist's x axis.
    pub tool: f64,
    /// The link that held objects are welded to.
    pub palm: LinkId,
    /// Palm, fingers and what is fixed to them.
    pub hand: Vec<LinkId>,
    /// Joints of the fingers that can be set, left one first; a finger that follows the
    /// other one is left out.
    pub fingers: Vec<JointId>,
    /// Position of the finger joints (rad) per metre of opening.
    pub finger_factor: f64,
}

impl ArmBody {
    /// Pose of the wrist when the tool centre point is at `tcp`.
    pub fn wrist_of_tcp(&self, tcp: &Pose) -> Pose {
        tcp * Pose::translation(-self.tool, 0.0, 0.0)
    }

    /// Pose of the tool centre point when the wrist is at `wrist`.
    pub fn tcp_of_wrist(&self, wrist: &Pose) -> Pose {
        wrist * Pose::translation(self.tool, 0.0, 0.0)
    }
}

/// The parts of the robot that motions set, and their measures.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// The lift of the torso.
    pub torso: JointId,
    /// The link that the torso lifts: the base of both arms' kinematics.
    pub torso_link: LinkId,
    /// Pan and tilt of the head.
    pub neck: [JointId; 2],
    /// The optical frame of the camera (z forward, y down).
    pub camera: LinkId,
    /// The left and the right arm.
    pub arms: [ArmBody; 2],
}

impl Body {
    /// The arm of that side.
    pub fn arm(&self, side: Side) -> &ArmBody {
        match side {
            Side::Left => &self.arms[0],
            Side::Right => &self.arms[1],
        }
    }
}

//! What the links and joints of the robot are for: base, torso, neck, cameras, arms,
//! grippers, postures, speeds, and which links may touch.
//!
//! Read from `world/pr2.sexp` or a file like it, and checked against the kinematic tree,
//! so that every name in it is a link or joint of that tree. The rest of the program
//! uses this description and never names a link itself.

use super::{
    Alias, ArmKinematics, ArmPositions, JointId, JointPositions, KinematicTree, Limits, LinkId,
    Side,
};
use nalgebra::{Translation3, UnitQuaternion};
use spatial::{Pose, trig};

/// Greatest velocity and acceleration of an axis (rad or m, and s).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Speed {
    /// Greatest velocity (rad/s or m/s).
    pub velocity: f64,
    /// Greatest acceleration (rad/s² or m/s²).
    pub acceleration: f64,
}

/// The mobile base.
#[derive(Clone, Debug, PartialEq)]
pub struct Base {
    /// The frame on the floor whose pose in the map is the robot's pose; the tree's root.
    pub frame: LinkId,
    /// The body.
    pub body: LinkId,
    /// Over the floor (m).
    pub drive: Speed,
    /// About the vertical axis (rad).
    pub turn: Speed,
    /// The frame in which the base measures its way, if it has a name; here it is the map.
    pub odometry: Option<String>,
}

/// The torso lift.
#[derive(Clone, Debug, PartialEq)]
pub struct Torso {
    /// The link that the joint raises.
    pub link: LinkId,
    /// The joint.
    pub joint: JointId,
    /// Range of heights (m), the hard limits of the URDF.
    pub limits: Limits,
    /// Height after start-up (m).
    pub start: f64,
}

/// The neck, which turns the head sideways (pan), then up and down (tilt).
#[derive(Clone, Debug, PartialEq)]
pub struct Neck {
    /// Turns the head sideways, positive to the left.
    pub pan_joint: JointId,
    /// What the pan joint turns.
    pub(crate) pan_link: LinkId,
    /// Turns the head up and down, positive downwards.
    pub tilt_joint: JointId,
    /// What the tilt joint turns.
    pub(crate) tilt_link: LinkId,
}

/// A camera of pinhole type.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// Name.
    pub name: String,
    /// The optical frame: z forward, x to the right, y down.
    pub frame: LinkId,
    /// Width of the picture in pixels.
    pub width: usize,
    /// Height of the picture in pixels.
    pub height: usize,
    /// Angle (rad) from the picture's lower to its upper edge; pixels are square.
    pub vertical_view: f64,
    /// Nearest distance (m) that is seen.
    pub near: f64,
    /// Farthest distance (m) that is seen.
    pub far: f64,
    /// Share of an object's pixels that must be visible for it to be seen.
    pub(crate) visible_share: f64,
}

/// An arm without its gripper.
#[derive(Clone, Debug, PartialEq)]
pub struct Arm {
    /// Which one it is.
    pub side: Side,
    /// The link that the arm is mounted on.
    pub base: LinkId,
    /// The last link, the tip of the inverse kinematics.
    pub wrist: LinkId,
    /// The frame between the fingers, as the URDF gives it.
    pub tool: LinkId,
    /// From the wrist to where grasps place the tool (m), along the wrist's x axis.
    pub(crate) tool_offset: f64,
    /// Orientation of the tool (x forward) in the frame in which grasps are given (z
    /// forward, x across the palm).
    pub tool_axes: UnitQuaternion<f64>,
    /// Inverse kinematics from `base` to `wrist`.
    pub kinematics: ArmKinematics,
    /// Named joint positions, in the order of the file.
    pub(crate) postures: Vec<(String, ArmPositions)>,
    /// The posture after start-up.
    pub start: ArmPositions,
    /// Greatest mass (kg) that the arm's maker allows it to carry, if known.
    pub payload: Option<f64>,
    /// The gripper.
    pub gripper: Gripper,
}

impl Arm {
    /// The joint positions of the named posture.
    pub fn posture(&self, name: &str) -> Option<&ArmPositions> {
        let posture = self.postures.iter().find(|(n, _)| n == name);
        posture.map(|(_, positions)| positions)
    }

    /// The joints from the shoulder to the wrist.
    pub fn joints(&self) -> &[JointId; 7] {
        self.kinematics.joints()
    }

    /// Positions of the arm's joints.
    pub fn positions(&self, q: &JointPositions) -> ArmPositions {
        self.joints().map(|joint| q.get(joint))
    }

    /// Sets the arm's joints to the positions.
    pub fn set_positions(&self, q: &mut JointPositions, positions: &ArmPositions) {
        for (joint, position) in self.joints().iter().zip(positions) {
            q.set(*joint, *position);
        }
    }

    /// The wrist pose that brings the tool to `tool`, in the same frame.
    pub fn wrist_for_tool(&self, tool: &Pose) -> Pose {
        tool * Translation3::new(-self.tool_offset, 0.0, 0.0)
    }

    /// The tool pose when the wrist is at `wrist`, in the same frame.
    pub fn tool_for_wrist(&self, wrist: &Pose) -> Pose {
        wrist * Translation3::new(self.tool_offset, 0.0, 0.0)
    }
}

/// A gripper with two parallel jaws that one joint moves.
#[derive(Clone, Debug, PartialEq)]
pub struct Gripper {
    /// The link that the fingers are mounted on.
    pub palm: LinkId,
    /// The joint that moves both fingers (rad, 0 is closed).
    pub joint: JointId,
    /// Limits of the joint (rad).
    pub limits: Limits,
    /// The links of the finger that closes from the left, then of the one from the right.
    pub fingers: [Vec<LinkId>; 2],
    /// Joint position (rad) per metre of opening that CRAM asks for.
    pub joint_per_metre: f64,
    /// Greatest force (N) with which each finger presses.
    pub effort: f64,
    /// Length along the finger and width (m) of the face of a pad, if they are known.
    pub pad_size: Option<[f64; 2]>,
    /// From a finger's joint to its tip, along the closed finger and across it (m).
    pub(super) tip: [f64; 2],
    /// From the middle of the palm to a finger's joint, minus from the tip to the face of
    /// its pad (m).
    pub(super) pad: f64,
}

impl Gripper {
    /// Gap (m) between the pads at a joint position (rad); slightly negative when closed.
    pub fn gap(&self, position: f64) -> f64 {
        let (s, c) = trig::sin_cos(position);
        2.0 * (self.tip[0] * s + self.tip[1] * c + self.pad)
    }

    /// Joint position (rad), within its limits, whose gap is nearest to the given one (m).
    pub fn position_for_gap(&self, gap: f64) -> f64 {
        let [along, across] = self.tip;
        let aside = (0.5 * gap - self.pad) / libm::hypot(along, across);
        self.limits
            .clamp(trig::asin(aside) - trig::atan2(across, along))
    }

    /// Joint position (rad), within its limits, that CRAM sets for an opening (m). Its
    /// real gap is 14 to 18 % smaller.
    pub fn position_for_opening(&self, opening: f64) -> f64 {
        self.limits.clamp(opening * self.joint_per_metre)
    }

    /// Palm and fingers.
    pub fn links(&self) -> impl Iterator<Item = LinkId> {
        let [left, right] = &self.fingers;
        std::iter::once(self.palm)
            .chain(left.iter().copied())
            .chain(right.iter().copied())
    }
}

/// What the links and joints of a robot are for.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotDescription {
    /// Name of the robot.
    pub name: String,
    /// The mobile base.
    pub base: Base,
    /// The torso lift.
    pub torso: Torso,
    /// The neck.
    pub neck: Neck,
    /// The cameras, the one in use first; never empty.
    pub(crate) cameras: Vec<Camera>,
    /// The left and the right arm.
    pub arms: [Arm; 2],
    /// Links within one group are never checked against each other.
    pub touching: Vec<Vec<LinkId>>,
    /// Links that roll on the floor; never checked against it or the robot.
    pub(crate) wheels: Vec<LinkId>,
    /// Joints that could move but never do.
    pub(crate) idle_joints: Vec<JointId>,
    /// Names by which users call links and joints, besides those in the URDF.
    pub aliases: Vec<Alias>,
    /// Greatest velocity and acceleration of each joint, at its index.
    pub(super) speeds: Vec<Speed>,
}

impl RobotDescription {
    /// The arm of that side.
    pub fn arm(&self, side: Side) -> &Arm {
        &self.arms[side.index()]
    }

    /// The camera in use.
    pub fn camera(&self) -> &Camera {
        // The reader refuses a file without cameras.
        &self.cameras[0]
    }

    /// Greatest velocity and acceleration of the joint (rad or m, and s).
    pub fn speed(&self, joint: JointId) -> Speed {
        self.speeds.get(joint.index()).copied().unwrap_or(Speed {
            velocity: 1.0,
            acceleration: 1.0,
        })
    }

    /// The description with no joint faster than its URDF says.
    #[must_use]
    pub fn as_fast_as_urdf(mut self, tree: &KinematicTree) -> Self {
        for (speed, (_, joint)) in self.speeds.iter_mut().zip(tree.joints()) {
            if let Some(limit) = joint.max_velocity {
                speed.velocity = speed.velocity.min(limit);
            }
        }
        self
    }

    /// Positions of all joints after start-up.
    pub fn start_positions(&self, tree: &KinematicTree) -> JointPositions {
        let mut q = tree.zero_positions();
        q.set(self.torso.joint, self.torso.start);
        for arm in &self.arms {
            arm.set_positions(&mut q, &arm.start);
        }
        q
    }
}

//! What the links and joints of the robot are for: base, torso, neck, cameras, arms,
//! grippers, postures, speeds, and which links may touch.
//!
//! Read from `world/pr2.sexp` or a file like it, and checked against the kinematic tree,
//! so that every name in it is a link or joint of that tree. The rest of the program
//! uses this description and never names a link itself.

use super::interface::RobotInterface;
use super::jaw_gap::JawGap;
use super::{
    Alias, ArmKinematics, ArmPositions, JointId, JointPositions, KinematicTree, Limits, LinkId,
    MountedFrame, NumericKinematics, ReachMap, Side,
};
use nalgebra::{Translation3, UnitQuaternion, Vector3};
use spatial::{Pose, trig};

/// Greatest velocity and acceleration of an axis (rad or m, and s).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Speed {
    /// Greatest velocity (rad/s or m/s).
    pub velocity: f64,
    /// Greatest acceleration (rad/s² or m/s²).
    pub acceleration: f64,
}

/// How a base drives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DriveKind {
    /// In any direction, turning meanwhile.
    Omnidirectional,
    /// Ahead and back, and it turns on the spot.
    Differential,
    /// Not at all.
    Fixed,
}

impl DriveKind {
    /// All, with the names that descriptions give them.
    pub(super) const NAMED: [(&'static str, Self); 3] = [
        ("omnidirectional", Self::Omnidirectional),
        ("differential", Self::Differential),
        ("fixed", Self::Fixed),
    ];
}

/// The mobile base.
#[derive(Clone, Debug, PartialEq)]
pub struct Base {
    /// The frame on the floor whose pose in the map is the robot's pose; the tree's root.
    pub frame: LinkId,
    /// The body.
    pub body: LinkId,
    /// How it drives.
    pub kind: DriveKind,
    /// Over the floor (m).
    pub drive: Speed,
    /// About the vertical axis (rad).
    pub turn: Speed,
    /// The frame in which the base measures its way, if it has a name; here it is the map.
    pub odometry: Option<String>,
    /// Where its frame is in the map after start-up (m); above the floor only if it does not drive.
    pub start: Pose,
}

/// The torso, which a lift may raise.
#[derive(Clone, Debug, PartialEq)]
pub struct Torso {
    /// The link that the joint raises; the body of a robot without a lift.
    pub link: LinkId,
    /// The joint of the lift, if there is one.
    pub joint: Option<JointId>,
    /// Range of heights (m), the hard limits of the URDF; from 0 to 0 without a lift.
    pub limits: Limits,
    /// Height after start-up (m).
    pub start: f64,
}

impl Torso {
    /// Its height (m).
    pub fn height(&self, q: &JointPositions) -> f64 {
        self.joint.map_or(0.0, |joint| q.get(joint))
    }

    /// Sets its height (m), if it has a lift.
    pub fn set_height(&self, q: &mut JointPositions, height: f64) {
        if let Some(joint) = self.joint {
            q.set(joint, height);
        }
    }
}

/// The neck, which turns the camera.
#[derive(Clone, Debug, PartialEq)]
pub struct Neck {
    /// Its joints, from the body on; none if the camera does not move.
    pub joints: Vec<JointId>,
    /// What it aims.
    pub(crate) aim: Aim,
}

/// What a neck aims at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Aim {
    /// The head, which turns sideways (pan, about z, positive to the left), then up and down (tilt, about y,
    /// positive downwards).
    PanTilt {
        /// What the pan joint turns.
        pan: LinkId,
        /// What the tilt joint turns.
        tilt: LinkId,
    },
    /// The z axis of a camera's optical frame.
    Camera(LinkId),
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
    /// From the wrist to where grasps place the tool (m), ahead of the hand.
    pub(crate) tool_offset: f64,
    /// Where that is (m), in the frame of the wrist.
    pub(super) tool_at: Vector3<f64>,
    /// Orientation of the tool (x forward) in the frame in which grasps are given (z
    /// forward, x across the palm).
    pub tool_axes: UnitQuaternion<f64>,
    /// Inverse kinematics from `base` to `wrist`.
    pub kinematics: ArmKinematics,
    /// The same from the base's frame on the floor, with the lift of the torso as its first joint, where the arm is
    /// solved numerically and there is one.
    pub(super) with_lift: Option<NumericKinematics>,
    /// Where it may bring its hand, if it is solved numerically.
    pub(super) map: Option<ReachMap>,
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

    /// The names of its postures, in the order of the file.
    pub fn posture_names(&self) -> impl Iterator<Item = &str> {
        self.postures.iter().map(|(name, _)| name.as_str())
    }

    /// Where its hand points, in the frame of the wrist and of the tool.
    pub(crate) fn ahead(&self) -> Vector3<f64> {
        let ahead = self.tool_at.try_normalize(1e-9);
        ahead.unwrap_or_else(Vector3::x)
    }

    /// The link that the first of its joints moves.
    pub fn shoulder(&self, tree: &KinematicTree) -> LinkId {
        // An arm has at least one joint.
        let first = self.joints().first();
        first.map_or(self.wrist, |joint| tree.joint(*joint).child)
    }

    /// The joints from the shoulder to the wrist.
    pub fn joints(&self) -> &[JointId] {
        self.kinematics.joints()
    }

    /// Positions of the arm's joints.
    pub fn positions(&self, q: &JointPositions) -> ArmPositions {
        self.joints().iter().map(|joint| q.get(*joint)).collect()
    }

    /// Sets the arm's joints to the positions.
    pub fn set_positions(&self, q: &mut JointPositions, positions: &ArmPositions) {
        for (joint, position) in self.joints().iter().zip(positions) {
            q.set(*joint, *position);
        }
    }

    /// The wrist pose that brings the tool to `tool`, in the same frame.
    pub fn wrist_for_tool(&self, tool: &Pose) -> Pose {
        // Without a negative zero, which would be another bit.
        let back = self.tool_at.map(|at| if at == 0.0 { 0.0 } else { -at });
        tool * Translation3::from(back)
    }

    /// The tool pose when the wrist is at `wrist`, in the same frame.
    pub fn tool_for_wrist(&self, wrist: &Pose) -> Pose {
        wrist * Translation3::from(self.tool_at)
    }
}

/// A gripper with two parallel jaws that one joint moves.
#[derive(Clone, Debug, PartialEq)]
pub struct Gripper {
    /// The link that the fingers are mounted on.
    pub palm: LinkId,
    /// The joint that moves both fingers (rad or m, closed at its lower limit).
    pub joint: JointId,
    /// Limits of the joint (rad or m).
    pub limits: Limits,
    /// The links of the finger that closes from the left, then of the one from the right.
    pub fingers: [Vec<LinkId>; 2],
    /// Joint position (rad) per metre of opening that CRAM asks for; without it, the opening is the gap.
    pub(super) joint_per_metre: Option<f64>,
    /// Greatest force (N) with which each finger presses.
    pub effort: f64,
    /// Length along the finger and width (m) of the face of a pad, if they are known.
    pub pad_size: Option<[f64; 2]>,
    /// How its fingers move.
    pub(super) jaws: Jaws,
}

/// How the fingers of a gripper move apart.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Jaws {
    /// They turn, and their tips stay parallel.
    Turning {
        /// From a finger's joint to its tip, along the closed finger and across it (m).
        tip: [f64; 2],
        /// From the middle of the palm to a finger's joint, minus from the tip to the face of
        /// its pad (m).
        pad: f64,
    },
    /// As their shapes show.
    Measured(JawGap),
}

/// The range (rad) of a joint that closes and opens fingers as fast as its speed says; others are
/// that much faster or slower as their range is larger or smaller.
const USUAL_RANGE: f64 = 0.548;

impl Gripper {
    /// Gap (m) between the pads at a joint position (rad); slightly negative when closed.
    pub fn gap(&self, position: f64) -> f64 {
        match &self.jaws {
            Jaws::Turning { tip, pad } => {
                let (s, c) = trig::sin_cos(position);
                2.0 * (tip[0] * s + tip[1] * c + pad)
            }
            Jaws::Measured(gap) => gap.gap(position),
        }
    }

    /// Joint position (rad), within its limits, whose gap is nearest to the given one (m).
    pub fn position_for_gap(&self, gap: f64) -> f64 {
        let position = match &self.jaws {
            Jaws::Turning { tip, pad } => {
                let [along, across] = *tip;
                let aside = (0.5 * gap - pad) / libm::hypot(along, across);
                trig::asin(aside) - trig::atan2(across, along)
            }
            Jaws::Measured(measured) => measured.position_for_gap(gap),
        };
        self.limits.clamp(position)
    }

    /// Joint position (rad or m), also beyond its limits, that CRAM sets for an opening (m). The PR2's
    /// real gap is 14 to 18 % smaller.
    pub(crate) fn wanted_for_opening(&self, opening: f64) -> f64 {
        match self.joint_per_metre {
            Some(per_metre) => opening * per_metre,
            None => {
                let position = self.position_for_gap(opening);
                // Beyond its range, a finger moves half as far as the gap grows.
                position + 0.5 * (opening - self.gap(position))
            }
        }
    }

    /// As [`Self::wanted_for_opening`], within the limits.
    pub fn position_for_opening(&self, opening: f64) -> f64 {
        self.limits.clamp(self.wanted_for_opening(opening))
    }

    /// The opening (m), as CRAM counts it, at a joint position (rad or m).
    pub fn opening_at(&self, position: f64) -> f64 {
        match self.joint_per_metre {
            Some(per_metre) => position / per_metre,
            None => self.gap(position),
        }
    }

    /// What speeds of a joint that turns are multiplied by (rad or m, per rad).
    pub(crate) fn scale(&self) -> f64 {
        match &self.jaws {
            Jaws::Turning { .. } => 1.0,
            Jaws::Measured(_) => (self.limits.upper - self.limits.lower) / USUAL_RANGE,
        }
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
    /// The arms, the left one first; never empty.
    pub arms: Vec<Arm>,
    /// Links within one group are never checked against each other.
    pub touching: Vec<Vec<LinkId>>,
    /// Links that roll on the floor; never checked against it or the robot.
    pub(crate) wheels: Vec<LinkId>,
    /// Joints that could move but never do.
    pub(crate) idle_joints: Vec<JointId>,
    /// Joints that move as another one does, though the URDF does not say so, each with that one.
    pub(crate) joined: Vec<(JointId, JointId)>,
    /// Frames that the URDF lacks.
    pub(crate) frames: Vec<MountedFrame>,
    /// Names by which users call links and joints, besides those in the URDF.
    pub aliases: Vec<Alias>,
    /// By which names it is driven from outside.
    pub interface: RobotInterface,
    /// Greatest velocity and acceleration of each joint, at its index.
    pub(super) speeds: Vec<Speed>,
}

impl RobotDescription {
    /// The arm of that side. A side without an arm is refused where plans name it; here, it stands
    /// for the only arm.
    pub fn arm(&self, side: Side) -> &Arm {
        let own = self.arms.iter().find(|arm| arm.side == side);
        // The reader refuses a file without arms.
        own.unwrap_or(&self.arms[0])
    }

    /// The sides that have an arm, left first.
    pub fn sides(&self) -> impl Iterator<Item = Side> + Clone + '_ {
        self.arms.iter().map(|arm| arm.side)
    }

    /// The sides that have an arm, right first: the right arm is preferred.
    pub fn preferred_sides(&self) -> Vec<Side> {
        let mut sides: Vec<Side> = self.sides().collect();
        sides.reverse();
        sides
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
        self.torso.set_height(&mut q, self.torso.start);
        for arm in &self.arms {
            arm.set_positions(&mut q, &arm.start);
        }
        q
    }
}

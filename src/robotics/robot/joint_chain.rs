//! A chain of moving joints between two links: where its tip is, and how each joint moves it.
//!
//! Axes and origins are arbitrary, and fixed joints may stand between. A joint that follows another one
//! of the chain moves with it and has no position of its own.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use thiserror::Error;

use super::arm_positions::MOST_ARM_JOINTS;
use super::{JointId, JointKind, KinematicTree, Limits, LinkId};
use spatial::{Pose, trig};

/// Cosine from which on two axes are one line.
const PARALLEL: f64 = 1.0 - 1e-9;

/// Positions of the joints of a chain; those beyond their number are 0.
pub(super) type ChainPositions = [f64; MOST_ARM_JOINTS];

/// How fast the tip moves (m, then rad) with each joint; those beyond their number are 0.
pub(super) type Columns = [[f64; 6]; MOST_ARM_JOINTS];

/// Why two links are not the ends of a chain that can be solved.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum JointChainError {
    /// The tip is not a descendant of the base.
    #[error(
        "link \"{tip}\" does not hang on link \"{base}\"; an arm goes from its base to its tip"
    )]
    NotConnected {
        /// Name of the base link.
        base: String,
        /// Name of the tip link.
        tip: String,
    },
    /// There are no joints, or more than an arm may have.
    #[error(
        "the arm from \"{base}\" to \"{tip}\" has {found} moving joints; \
         it may have 1 to {MOST_ARM_JOINTS}"
    )]
    JointCount {
        /// Name of the base link.
        base: String,
        /// Name of the tip link.
        tip: String,
        /// Number of moving joints.
        found: usize,
    },
    /// A joint follows one that is not part of the chain.
    #[error(
        "joint \"{joint}\" of the arm follows joint \"{leader}\", which is not between \
         \"{base}\" and \"{tip}\""
    )]
    LeaderOutside {
        /// Name of the joint.
        joint: String,
        /// Name of the joint that it follows.
        leader: String,
        /// Name of the base link.
        base: String,
        /// Name of the tip link.
        tip: String,
    },
}

/// One moving joint of the chain, with what is fixed in front of it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ChainSegment {
    /// Pose at 0 in the frame behind the moving joint before, or in that of the base.
    pub(super) origin: Pose,
    /// Unit axis in its own frame.
    pub(super) axis: Vector3<f64>,
    /// Whether it slides along the axis instead of turning about it.
    pub(super) slides: bool,
    /// Which joint of the chain moves it.
    pub(super) leader: usize,
    /// Factor on the position of that joint.
    multiplier: f64,
    /// Position when that joint is at 0.
    offset: f64,
}

impl ChainSegment {
    /// Its own position, given the joints of the chain.
    pub(super) fn position(&self, positions: &[f64]) -> f64 {
        let leader = positions.get(self.leader).copied().unwrap_or(0.0);
        self.multiplier * leader + self.offset
    }

    /// The frame behind the joint, in the frame in which the one before it is given.
    fn after(&self, before: &Pose, position: f64) -> Pose {
        let mut pose = before * self.origin;
        if self.slides {
            pose.translation.vector += pose.rotation * (self.axis * position);
        } else {
            let (s, c) = trig::sin_cos(position / 2.0);
            let axis = self.axis * s;
            // A unit axis and a point of the unit circle make a unit quaternion.
            pose.rotation *=
                UnitQuaternion::new_unchecked(Quaternion::new(c, axis.x, axis.y, axis.z));
        }
        pose
    }
}

/// The moving joints from a link to another one.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct JointChain {
    /// The joints that move on their own, from the base to the tip.
    pub(super) joints: Vec<JointId>,
    /// Their limits, soft limits where the URDF gives them; `None` for continuous joints.
    pub(super) limits: Vec<Option<Limits>>,
    /// Whether a full turn of the joint changes nothing.
    pub(super) is_turn: Vec<bool>,
    /// All joints that move, followers as well.
    pub(super) segments: Vec<ChainSegment>,
    /// The tip behind the last moving joint.
    pub(super) tail: Pose,
}

impl JointChain {
    /// In how many ways the tip moves: the pieces of a telescope, which slide along one line one after the
    /// other, count once.
    pub(super) fn freedoms(&self) -> usize {
        let (frames, _) = self.frames(&[0.0; MOST_ARM_JOINTS]);
        let line = |(frame, segment): (&Pose, &ChainSegment)| {
            segment.slides.then(|| frame.rotation * segment.axis)
        };
        let lines: Vec<_> = frames.iter().zip(&self.segments).map(line).collect();
        let pairs = lines.windows(2).zip(self.segments.windows(2));
        let repeated = pairs.filter(|(lines, segments)| match (lines, segments) {
            ([Some(a), Some(b)], [one, next]) => {
                one.leader != next.leader && a.dot(b).abs() > PARALLEL
            }
            _ => false,
        });
        self.joints.len() - repeated.count()
    }

    /// Reads the chain from `base` to `tip`.
    pub(super) fn read(
        tree: &KinematicTree,
        base: LinkId,
        tip: LinkId,
    ) -> Result<Self, JointChainError> {
        let name = |link: LinkId| tree.link(link).name.clone();
        if !tree.carries(base, tip) {
            return Err(JointChainError::NotConnected {
                base: name(base),
                tip: name(tip),
            });
        }
        let mut path: Vec<JointId> = tree
            .ancestors(tip)
            .take_while(|j| tree.carries(base, tree.joint(*j).parent))
            .collect();
        path.reverse();
        let leads = |id: &JointId| tree.joint(*id).is_actuated();
        let joints: Vec<JointId> = path.iter().copied().filter(leads).collect();
        let mut segments = Vec::new();
        let mut behind = Pose::identity();
        for id in path {
            let joint = tree.joint(id);
            let origin = behind * joint.origin;
            if joint.kind == JointKind::Fixed {
                behind = origin;
                continue;
            }
            let (leading, multiplier, offset) = match joint.mimic {
                Some(mimic) => (mimic.joint, mimic.multiplier, mimic.offset),
                None => (id, 1.0, 0.0),
            };
            let leader = joints.iter().position(|j| *j == leading);
            let leader = leader.ok_or_else(|| JointChainError::LeaderOutside {
                joint: joint.name.clone(),
                leader: tree.joint(leading).name.clone(),
                base: name(base),
                tip: name(tip),
            })?;
            segments.push(ChainSegment {
                origin,
                axis: joint.axis.into_inner(),
                slides: joint.kind == JointKind::Prismatic,
                leader,
                multiplier,
                offset,
            });
            behind = Pose::identity();
        }
        if joints.is_empty() || joints.len() > MOST_ARM_JOINTS {
            return Err(JointChainError::JointCount {
                base: name(base),
                tip: name(tip),
                found: joints.len(),
            });
        }
        let limits = joints.iter().map(|id| {
            let joint = tree.joint(*id);
            joint.soft_limits.or(joint.limits)
        });
        let is_turn = (0..joints.len()).map(|leader| {
            let mut moved = segments.iter().filter(|s| s.leader == leader);
            moved.all(|s| !s.slides && s.multiplier.fract() == 0.0)
        });
        Ok(Self {
            limits: limits.collect(),
            is_turn: is_turn.collect(),
            joints,
            segments,
            tail: behind,
        })
    }

    /// The frame behind each moving joint, and the pose of the tip, all in the frame of the base.
    pub(super) fn frames(&self, positions: &[f64]) -> (Vec<Pose>, Pose) {
        let mut pose = Pose::identity();
        let frames = self.segments.iter().map(|segment| {
            pose = segment.after(&pose, segment.position(positions));
            pose
        });
        let frames = frames.collect();
        (frames, pose * self.tail)
    }

    /// Pose of the tip in the frame of the base. Joints without a position are at 0.
    pub(super) fn forward(&self, positions: &[f64]) -> Pose {
        let mut pose = Pose::identity();
        for segment in &self.segments {
            pose = segment.after(&pose, segment.position(positions));
        }
        pose * self.tail
    }

    /// Pose of the tip in the frame of the base, and how it moves with each joint, in that frame.
    pub(super) fn forward_and_columns(&self, positions: &ChainPositions) -> (Pose, Columns) {
        let mut pose = Pose::identity();
        // What turns, moves the tip at p by the cross product of the axis w and p - o, o being a point of
        // the axis: the sums of w, and those of the slides minus w x o, are known before p is.
        let mut turns = [Vector3::zeros(); MOST_ARM_JOINTS];
        let mut slides = [Vector3::zeros(); MOST_ARM_JOINTS];
        for segment in &self.segments {
            pose = segment.after(&pose, segment.position(positions));
            let axis = pose.rotation * segment.axis * segment.multiplier;
            let (Some(turn), Some(slide)) = (
                turns.get_mut(segment.leader),
                slides.get_mut(segment.leader),
            ) else {
                continue;
            };
            if segment.slides {
                *slide += axis;
            } else {
                *turn += axis;
                *slide -= axis.cross(&pose.translation.vector);
            }
        }
        let tip = pose * self.tail;
        let mut columns = [[0.0; 6]; MOST_ARM_JOINTS];
        for ((column, turn), slide) in columns.iter_mut().zip(&turns).zip(&slides) {
            let shift = turn.cross(&tip.translation.vector) + slide;
            *column = [shift.x, shift.y, shift.z, turn.x, turn.y, turn.z];
        }
        (tip, columns)
    }
}

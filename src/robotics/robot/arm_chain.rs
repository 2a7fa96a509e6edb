//! The dimensions of an arm with the PR2's joint layout, read from the kinematic tree.

use nalgebra::Vector3;
use thiserror::Error;

use super::{JointId, JointKind, KinematicTree, Limits, LinkId};

/// Joints of an arm, from the shoulder to the wrist: shoulder pan, shoulder lift, upper
/// arm roll, elbow flex, forearm roll, wrist flex, wrist roll.
pub(super) const ARM_JOINTS: usize = 7;

/// Indices into [`super::ArmPositions`].
pub(super) const PAN: usize = 0;
pub(super) const LIFT: usize = 1;
pub(super) const ROLL: usize = 2;
pub(super) const ELBOW: usize = 3;
pub(super) const FOREARM: usize = 4;
pub(super) const FLEX: usize = 5;
pub(super) const WRIST: usize = 6;

/// Axis of each joint, and whether its origin may be shifted along x.
const LAYOUT: [(char, bool); ARM_JOINTS] = [
    ('z', true),
    ('y', true),
    ('x', false),
    ('y', true),
    ('x', false),
    ('y', true),
    ('x', false),
];

/// Why the inverse kinematics cannot work with a chain of joints.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ArmChainError {
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
    /// The chain does not have seven moving joints.
    #[error(
        "the arm from \"{base}\" to \"{tip}\" has {found} moving joints; \
         the inverse kinematics needs {ARM_JOINTS}"
    )]
    JointCount {
        /// Name of the base link.
        base: String,
        /// Name of the tip link.
        tip: String,
        /// Number of moving joints.
        found: usize,
    },
    /// A joint does not have the form that the closed-form solution requires.
    #[error("joint \"{joint}\" does not suit the inverse kinematics of the arm: it needs {needed}")]
    Layout {
        /// Name of the joint.
        joint: String,
        /// What the solution requires.
        needed: String,
    },
}

/// Dimensions of an arm: lengths in m, angles in rad.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ArmChain {
    /// The joints from the shoulder to the wrist.
    pub joints: [JointId; ARM_JOINTS],
    /// Their names.
    pub names: [String; ARM_JOINTS],
    /// Their limits, soft limits where the URDF gives them; `None` for continuous joints.
    pub limits: [Option<Limits>; ARM_JOINTS],
    /// Position of the pan axis in the frame of the arm's base, at the height of the lift axis.
    pub shoulder: Vector3<f64>,
    /// From the pan axis to the lift axis.
    pub(crate) shoulder_offset: f64,
    /// From the shoulder to the elbow.
    pub(crate) upper_arm: f64,
    /// From the elbow to the wrist.
    pub(crate) forearm: f64,
}

impl ArmChain {
    /// Maximum distance (m) of the wrist from the shoulder's pan axis, where that begins.
    pub(super) fn length(&self) -> f64 {
        self.shoulder_offset + self.upper_arm + self.forearm
    }

    /// Reads the chain from `base` to `tip`.
    pub(super) fn read(
        tree: &KinematicTree,
        base: LinkId,
        tip: LinkId,
    ) -> Result<Self, ArmChainError> {
        let name = |link: LinkId| tree.link(link).name.clone();
        if !tree.carries(base, tip) {
            return Err(ArmChainError::NotConnected {
                base: name(base),
                tip: name(tip),
            });
        }
        let mut chain: Vec<JointId> = tree
            .ancestors(tip)
            .take_while(|j| tree.carries(base, tree.joint(*j).parent))
            .collect();
        chain.reverse();
        let mut moving = Vec::new();
        for &id in &chain {
            let joint = tree.joint(id);
            if joint.kind != JointKind::Fixed {
                moving.push(id);
            } else if joint.origin.translation.vector.norm() > 1e-9
                || joint.origin.rotation.angle() > 1e-9
            {
                return Err(layout(
                    &joint.name,
                    "an origin of zero, as a fixed joint of the arm",
                ));
            }
        }
        let Ok(joints) = <[JointId; ARM_JOINTS]>::try_from(moving.as_slice()) else {
            return Err(ArmChainError::JointCount {
                base: name(base),
                tip: name(tip),
                found: moving.len(),
            });
        };
        let mut limits = [None; ARM_JOINTS];
        for (i, &id) in joints.iter().enumerate() {
            check_joint(tree, id, i)?;
            let joint = tree.joint(id);
            limits[i] = joint.soft_limits.or(joint.limits);
        }
        let origin = |i: usize| tree.joint(joints[i]).origin.translation.vector;
        let chain = Self {
            joints,
            names: joints.map(|j| tree.joint(j).name.clone()),
            limits,
            shoulder: origin(PAN),
            shoulder_offset: origin(LIFT).x,
            upper_arm: origin(ELBOW).x,
            forearm: origin(FLEX).x,
        };
        chain.check_measures()?;
        Ok(chain)
    }

    /// Limits of a joint; unbounded for a continuous one.
    pub(super) fn limits(&self, joint: usize) -> Limits {
        self.limits[joint].unwrap_or(Limits {
            lower: f64::NEG_INFINITY,
            upper: f64::INFINITY,
        })
    }

    /// The closed-form solution requires links of nonzero length, an elbow and a wrist that
    /// bend one way only, and an upper arm that never points back over the pan axis.
    fn check_measures(&self) -> Result<(), ArmChainError> {
        for (i, length) in [
            (LIFT, self.shoulder_offset),
            (ELBOW, self.upper_arm),
            (FLEX, self.forearm),
        ] {
            if length < 1e-3 {
                return Err(layout(&self.names[i], "an origin of at least 1 mm along x"));
            }
        }
        for i in [ELBOW, FLEX] {
            let limits = self.limits(i);
            if limits.upper > 0.0 || limits.lower < -std::f64::consts::PI {
                return Err(layout(&self.names[i], "limits within -pi..0"));
            }
        }
        let lift = self.limits(LIFT);
        let span = lift.lower.abs().max(lift.upper.abs());
        let behind = self.shoulder_offset + self.upper_arm * spatial::trig::cos(span);
        if span > 3.0 || behind < 1e-3 {
            let needed = "limits that keep the elbow in front of the pan axis";
            return Err(layout(&self.names[LIFT], needed));
        }
        Ok(())
    }
}

fn layout(joint: &str, needed: &str) -> ArmChainError {
    ArmChainError::Layout {
        joint: joint.to_owned(),
        needed: needed.to_owned(),
    }
}

fn check_joint(tree: &KinematicTree, id: JointId, place: usize) -> Result<(), ArmChainError> {
    let joint = tree.joint(id);
    let (axis, shifted) = LAYOUT[place];
    let direction = match axis {
        'x' => Vector3::x(),
        'y' => Vector3::y(),
        _ => Vector3::z(),
    };
    if (joint.axis.into_inner() - direction).norm() > 1e-9 {
        return Err(layout(&joint.name, &format!("the axis {axis}")));
    }
    let kind = match place {
        FOREARM | WRIST => JointKind::Continuous,
        _ => JointKind::Revolute,
    };
    if joint.kind != kind || joint.mimic.is_some() {
        let needed = format!("to be {kind:?} and to follow no other joint").to_lowercase();
        return Err(layout(&joint.name, &needed));
    }
    if joint.origin.rotation.angle() > 1e-9 {
        return Err(layout(&joint.name, "an origin without rotation"));
    }
    let at = joint.origin.translation.vector;
    let aside = match (place, shifted) {
        (PAN, _) => 0.0,
        (_, true) => at.yz().norm(),
        (_, false) => at.norm(),
    };
    if aside > 1e-9 {
        let needed = if shifted {
            "an origin on the x axis of its parent"
        } else {
            "an origin of zero"
        };
        return Err(layout(&joint.name, needed));
    }
    Ok(())
}

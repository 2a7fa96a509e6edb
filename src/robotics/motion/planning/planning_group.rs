//! The joints that a motion of the arms sets, as axes of a path.

use super::joint_path::{ALL_CHAINS, PathAxis};
use crate::robot::description::Arm;
use crate::robot::{Joint, JointId, JointKind, KinematicTree, Limits, Side};
use crate::world::World;

/// How far (m) a hand extends beyond the wrist: its own length and what it holds.
const HAND_EXTENT: f64 = 0.3;
/// Parts that turn about the wrist's own axis are at most this far (m) from it.
const HAND_WIDTH: f64 = 0.15;

/// Joints of the arms, and of the torso if it moves too.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PlanningGroup {
    pub(crate) joints: Vec<JointId>,
    pub(super) axes: Vec<PathAxis>,
}

impl PlanningGroup {
    /// The axes of the arms of those sides, preceded by the torso's if it is to move.
    pub(crate) fn new(world: &World, torso: bool, sides: &[Side]) -> Self {
        let tree = &world.models().robot;
        let body = &world.models().description;
        let mut all = Self {
            joints: Vec::new(),
            axes: Vec::new(),
        };
        if let Some(lift) = body.torso.joint.filter(|_| torso) {
            all.add(tree, lift, ALL_CHAINS, 1.0, 0.0);
        }
        for &side in sides {
            let arm = body.arm(side);
            for (joint, reach) in arm.kinematics.joints().iter().zip(reaches(tree, arm)) {
                let now = world.robot_configuration().joints.get(*joint);
                all.add(tree, *joint, side.index() + 1, reach, now);
            }
        }
        all
    }

    fn add(&mut self, tree: &KinematicTree, joint: JointId, chain: usize, reach: f64, now: f64) {
        let turn = Limits {
            lower: now - std::f64::consts::PI,
            upper: now + std::f64::consts::PI,
        };
        let Limits { lower, upper } = tree.joint(joint).limits.unwrap_or(turn);
        self.joints.push(joint);
        self.axes.push(PathAxis {
            lower,
            upper,
            reach,
            chain,
        });
    }

    /// Current positions of the joints.
    pub(crate) fn now(&self, world: &World) -> Vec<f64> {
        let joints = &world.robot_configuration().joints;
        self.joints.iter().map(|j| joints.get(*j)).collect()
    }
}

/// Upper bound (m) on how far any part of arm and hand moves per unit of each joint (rad or m).
fn reaches(tree: &KinematicTree, arm: &Arm) -> Vec<f64> {
    let joints: Vec<&Joint> = arm.joints().iter().map(|id| tree.joint(*id)).collect();
    let length = |i: usize| {
        let joint = joints.get(i);
        joint.map_or(0.0, |joint| joint.origin.translation.vector.norm())
    };
    if arm.kinematics.is_closed_form() {
        // From the elbow, the forearm and the hand; the roll joints turn about the link before
        // the next bend, so its length does not count.
        let forearm = length(5) + HAND_EXTENT;
        let arm = length(3) + length(2) + forearm;
        return vec![
            length(1) + arm,
            arm,
            forearm,
            forearm,
            HAND_EXTENT,
            HAND_EXTENT,
            HAND_WIDTH,
        ];
    }
    let mut reach = HAND_EXTENT;
    let mut all = Vec::new();
    for (i, joint) in joints.iter().enumerate().rev() {
        let slides = joint.kind == JointKind::Prismatic;
        all.push(if slides { 1.0 } else { reach });
        reach += length(i);
        if slides {
            reach += joint
                .limits
                .map_or(0.0, |l| l.lower.abs().max(l.upper.abs()));
        }
    }
    all.reverse();
    all
}

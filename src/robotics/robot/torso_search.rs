//! Reaching with the help of the torso: the heights at which the arm can bring its wrist to
//! a pose.

use super::description::{Arm, RobotDescription, Torso};
use super::{ArmPositions, JointPositions, KinematicTree, Limits, LinkId, Side, Unreachable};
use spatial::Pose;

/// Distance (m) between the heights that are tried.
pub(crate) const TORSO_STEP: f64 = 0.01;

/// The heights (m) to try, nearest to the current one first: the current one itself, then
/// those at multiples of [`TORSO_STEP`] above the lower limit and the upper limit itself.
///
/// Of two equally near heights the higher one comes first. (CRAM tries the current height,
/// then all others from the top down; the set is the same, but the torso moves less here.)
pub(crate) fn torso_heights(current: f64, limits: Limits) -> Vec<f64> {
    let current = limits.clamp(current);
    let steps = ((limits.upper - limits.lower) / TORSO_STEP + 1e-9)
        .floor()
        .max(0.0) as u32;
    let mut heights: Vec<f64> = (0..=steps)
        .map(|i| limits.lower + f64::from(i) * TORSO_STEP)
        .chain([limits.upper])
        .map(|height| limits.clamp(height))
        .filter(|height| (height - current).abs() > 1e-6)
        .collect();
    heights.sort_by(|a, b| b.total_cmp(a));
    heights.dedup_by(|a, b| (*a - *b).abs() < 1e-6);
    // A stable sort keeps the higher one first where two are equally near.
    let nearness = |height: f64| ((height - current).abs() * 1e6).round();
    heights.sort_by(|a, b| nearness(*a).total_cmp(&nearness(*b)));
    heights.insert(0, current);
    heights
}

/// A solution for a wrist pose: the torso's height (m) and the arm's joint positions (rad).
#[derive(Clone, Debug, PartialEq)]
pub struct Reach {
    /// Height of the torso (m).
    pub torso: f64,
    /// Positions of the arm's joints (rad).
    pub arm: ArmPositions,
}

/// The search for a torso height from which one arm reaches a pose.
#[derive(Clone, Debug)]
pub struct TorsoSearch<'a> {
    arm: &'a Arm,
    heights: Vec<f64>,
    seed: ArmPositions,
    /// Pose of the arm's base with the torso at height 0, in the robot's frame on the floor.
    lowest: Pose,
    /// Displacement of the arm's base per metre of height.
    rise: nalgebra::Vector3<f64>,
}

impl RobotDescription {
    /// The search for a torso height from which an arm reaches, with the other joints as in `q`.
    pub fn torso_search<'a>(
        &'a self,
        tree: &'a KinematicTree,
        q: &'a JointPositions,
        side: Side,
    ) -> TorsoSearch<'a> {
        TorsoSearch::new(tree, &self.torso, self.base.frame, self.arm(side), q)
    }
}

impl<'a> TorsoSearch<'a> {
    pub(super) fn new(
        tree: &KinematicTree,
        torso: &Torso,
        frame: LinkId,
        arm: &'a Arm,
        q: &JointPositions,
    ) -> Self {
        let base_at = |height: f64| {
            let mut q = q.clone();
            torso.set_height(&mut q, height);
            // The reader has checked that the arm is a descendant of the frame.
            tree.relative_pose(frame, arm.base, &q)
                .unwrap_or_else(Pose::identity)
        };
        let lowest = base_at(0.0);
        Self {
            arm,
            heights: torso_heights(torso.height(q), torso.limits),
            seed: arm.positions(q),
            lowest,
            rise: base_at(1.0).translation.vector - lowest.translation.vector,
        }
    }

    /// The pose of the wrist in the frame of the arm's base if the torso is at `height`
    /// (m) and the wrist is at `wrist` in the robot's frame on the floor.
    pub(crate) fn in_arm_base(&self, wrist: &Pose, height: f64) -> Pose {
        let mut base = self.lowest;
        base.translation.vector += self.rise * height;
        base.inv_mul(wrist)
    }

    /// Whether the arm may reach the wrist, which is given in the robot's frame on the floor, at one of some heights (m).
    /// Known at once; next to none that it reaches are missed.
    pub(crate) fn may_reach(&self, wrist: &Pose, mut heights: impl Iterator<Item = f64>) -> bool {
        let map = self.arm.map.as_ref();
        map.is_none_or(|map| heights.any(|height| map.holds(&self.in_arm_base(wrist, height))))
    }

    /// Whether the arm reaches the wrist, which is given in the robot's frame on the floor, at some height within the
    /// lift's limits; `None` if only each height can be asked. Few that it reaches are missed.
    pub(crate) fn any_height_reaches(&self, wrist: &Pose) -> Option<bool> {
        let lifted = self.arm.with_lift.as_ref()?;
        Some(lifted.reaches_soon(wrist))
    }

    /// All heights (m) that are tried, in order.
    pub fn heights(&self) -> &[f64] {
        &self.heights
    }

    /// The reach with the torso at `height` (m), or why there is none; `wrist` is given in
    /// the robot's frame on the floor.
    pub(crate) fn reach_at(&self, wrist: &Pose, height: f64) -> Result<Reach, Unreachable> {
        let wrist = self.in_arm_base(wrist, height);
        let arm = self.arm.kinematics.nearest(&wrist, &self.seed)?;
        Ok(Reach { torso: height, arm })
    }

    /// As [`Self::reach`], without a reason if there is none, which takes much longer to find.
    pub fn any_reach(&self, wrist: &Pose) -> Option<Reach> {
        let mut heights = self.heights.iter().copied();
        heights.find_map(|height| {
            let is_missed = self
                .arm
                .kinematics
                .surely_misses(&self.in_arm_base(wrist, height));
            match is_missed {
                true => None,
                false => self.reach_at(wrist, height).ok(),
            }
        })
    }

    /// Whether [`Self::any_reach`] finds the wrist's pose for a tool in the robot's frame on the floor.
    pub fn reaches_tool(&self, tool: &Pose) -> bool {
        self.any_reach(&self.arm.wrist_for_tool(tool)).is_some()
    }

    /// Whether a tool in the robot's frame on the floor is farther than the arm is long, at every height.
    pub fn is_too_far(&self, tool: &Pose) -> bool {
        let wrist = self.arm.wrist_for_tool(tool);
        let mut heights = self.heights.iter();
        heights.all(|height| {
            self.arm
                .kinematics
                .is_too_far(&self.in_arm_base(&wrist, *height))
        })
    }

    /// The reach whose height is nearest to the current one; `wrist` is given in the
    /// robot's frame on the floor. If no height works, the reason is that of the height
    /// that comes nearest to reaching it.
    pub fn reach(&self, wrist: &Pose) -> Result<Reach, Unreachable> {
        if let Some(reach) = self.any_reach(wrist) {
            return Ok(reach);
        }
        let mut nearest: Option<Unreachable> = None;
        for &height in &self.heights {
            match self.reach_at(wrist, height) {
                Ok(reach) => return Ok(reach),
                Err(reason) => {
                    let badness = reason.badness();
                    if nearest.as_ref().is_none_or(|n| badness < n.badness()) {
                        nearest = Some(reason);
                    }
                }
            }
        }
        // There is always at least the current height.
        Err(nearest.unwrap_or(Unreachable::OutOfReach { missing: 0.0 }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heights_come_nearest_first() {
        let limits = Limits {
            lower: 0.0,
            upper: 0.045,
        };
        let heights = torso_heights(0.02, limits);
        let expected = [0.02, 0.03, 0.01, 0.04, 0.0, 0.045];
        assert_eq!(heights.len(), expected.len());
        for (height, expected) in heights.iter().zip(expected) {
            assert!((height - expected).abs() < 1e-12, "{heights:?}");
        }
    }
}

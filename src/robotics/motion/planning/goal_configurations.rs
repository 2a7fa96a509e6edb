//! The configurations of arms and torso with which hands are at their goals.

use std::ops::ControlFlow;

use super::planning_group::PlanningGroup;
use super::pose_goal::PoseGoalTask;
use crate::robot::{ArmPositions, Limits, Side};
use spatial::{Pose, trig};

/// Distance of neighbouring configurations over the redundant angle (rad).
pub(crate) const CONFIGURATION_STEP: f64 = 0.15;
/// Distance (rad) from a joint's limit below which configurations cost more, and how much more.
const LIMIT_MARGIN: (f64, f64) = (0.2, 1.0);

/// A configuration that reaches the goals.
pub(crate) struct GoalConfiguration {
    pub(super) cost: f64,
    /// Positions of the axes, the torso's first if it moves.
    pub(crate) positions: Vec<f64>,
}

impl PoseGoalTask<'_> {
    /// All configurations at the height, the best one first; collisions are not checked.
    pub(crate) fn configurations(
        &self,
        height: f64,
        group: &PlanningGroup,
    ) -> Vec<GoalConfiguration> {
        let now = group.now(self.world);
        let mut all = vec![GoalConfiguration {
            cost: 0.0,
            positions: self.torso_at(height, &now),
        }];
        for (side, tcp) in &self.goals {
            let kinematics = &self.body().arm(*side).kinematics;
            let found = self.arm_solutions(*side, tcp, height);
            let mut next = Vec::with_capacity(all.len() * found.len());
            for before in &all {
                for solution in &found {
                    let mut positions = Vec::with_capacity(now.len());
                    positions.extend_from_slice(&before.positions);
                    let mut cost = before.cost;
                    for (q, limits) in solution.iter().zip(kinematics.limits()) {
                        // There is one axis per joint of every arm with a goal, so one is left.
                        let from = now[positions.len()];
                        let to = turned_to(*q, *limits, from);
                        cost += (to - from).abs() + limits.map_or(0.0, |l| limit_cost(&l, to));
                        positions.push(to);
                    }
                    next.push(GoalConfiguration { cost, positions });
                }
            }
            next.sort_by(|a, b| a.cost.total_cmp(&b.cost));
            // For two arms, the product of all configurations of both would be too large.
            next.truncate(400);
            all = next;
        }
        all
    }

    /// The position of the torso at the height, if it is one of the axes, which are where they are `now`.
    fn torso_at(&self, height: f64, now: &[f64]) -> Vec<f64> {
        let arms = self.goals.iter();
        let joints = arms.map(|(side, _)| self.body().arm(*side).joints().len());
        match now.len() > joints.sum::<usize>() {
            true => vec![height],
            false => Vec::new(),
        }
    }

    fn arm_solutions(&self, side: Side, tcp: &Pose, height: f64) -> Vec<ArmPositions> {
        let kinematics = &self.body().arm(side).kinematics;
        let wrist = self.wrist(side, tcp, height);
        kinematics.solutions(&wrist, CONFIGURATION_STEP)
    }

    /// As [`Self::configurations`] of a single arm, in no order, until `visit` has enough.
    pub(crate) fn visit_configurations(
        &self,
        height: f64,
        now: &[f64],
        mut visit: impl FnMut(&[f64]) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let Some((side, tcp)) = self.goals.first() else {
            return ControlFlow::Continue(());
        };
        let mut positions = self.torso_at(height, now);
        let lead = positions.len();
        let limits = self.body().arm(*side).kinematics.limits();
        for solution in self.arm_solutions(*side, tcp, height) {
            positions.truncate(lead);
            let axes = solution.iter().zip(limits).zip(now.iter().skip(lead));
            positions.extend(axes.map(|((q, limits), from)| turned_to(*q, *limits, *from)));
            visit(&positions)?;
        }
        ControlFlow::Continue(())
    }
}

/// The position of an axis nearest to where it is `from`: without limits, it turns the short way.
fn turned_to(q: f64, limits: Option<Limits>, from: f64) -> f64 {
    match limits {
        Some(_) => q,
        None => from + trig::wrap(q - from),
    }
}

/// Cost (rad) of a position near its limit.
fn limit_cost(limits: &Limits, position: f64) -> f64 {
    let (margin, cost) = LIMIT_MARGIN;
    let room = (position - limits.lower).min(limits.upper - position);
    cost * (1.0 - room / margin).max(0.0)
}

//! Moving one or both arms to given joint positions, around obstacles.

use super::job::{Job, check_finite};
use super::joint_motion::{JointGoal, JointMotion};
use crate::motion::contact::expected_contacts::ExpectedContacts;
use crate::motion::contact::level::LevelHands;
use crate::motion::failure::joint_limit::violation;
use crate::motion::failure::motion_failure::MotionFailure;
use crate::motion::failure::process_module::ProcessModule;
use crate::motion::planning::configuration_checker::ConfigurationChecker;
use crate::motion::planning::joint_path::JointPathEffort;
use crate::motion::planning::joint_plan::JointPlan;
use crate::motion::planning::joint_trajectory::plan_joint_trajectory;
use crate::motion::planning::opening_hands::with_room_for_fingers;
use crate::motion::planning::planning_group::PlanningGroup;
use crate::robot::Side;
use crate::world::{AllowedPairs, CollisionHit, World};
use spatial::trig;

/// Moves the joints of one or both arms. Both arrive at the same time.
pub type MoveJoints = Job<JointMotion<ArmGoal>>;

/// Positions of the joints of one or both arms.
#[derive(Clone, Debug)]
pub struct ArmGoal {
    /// Goals of the left and of the right arm.
    positions: [Option<Vec<f64>>; 2],
}

impl MoveJoints {
    /// Moves to the positions (rad) of the left and of the right arm, from the shoulder to the
    /// wrist; an arm without positions stays. Continuous joints turn in the shorter direction.
    pub fn new(left: Option<Vec<f64>>, right: Option<Vec<f64>>) -> Self {
        Self::begin(JointMotion::to(ArmGoal {
            positions: [left, right],
        }))
    }
}

impl ArmGoal {
    fn sides(&self) -> Vec<Side> {
        Side::BOTH
            .into_iter()
            .filter(|s| self.positions[s.index()].is_some())
            .collect()
    }

    /// The goals of all axes in order, within hard limits.
    fn goal(&self, world: &World, group: &PlanningGroup) -> Result<Vec<f64>, MotionFailure> {
        let mut goal = Vec::new();
        for (side, given) in Side::BOTH.into_iter().zip(&self.positions) {
            let Some(given) = given else { continue };
            let expected = world.models().description.arm(side).joints().len();
            if given.len() != expected {
                let given = given.len();
                return Err(MotionFailure::JointCount {
                    side,
                    given,
                    expected,
                });
            }
            goal.extend(given);
        }
        check_finite(Self::MODULE, &goal)?;
        let tree = &world.models().robot;
        let joints = group.joints.iter().zip(group.now(world));
        for ((&id, now), wanted) in joints.zip(&mut goal) {
            let joint = tree.joint(id);
            match joint.limits {
                Some(l) if l.excess(*wanted) > 0.0 => {
                    let violation = violation(joint, l, *wanted);
                    return Err(MotionFailure::JointLimit { violation });
                }
                Some(_) => {}
                None => *wanted = now + trig::wrap(*wanted - now),
            }
        }
        Ok(goal)
    }
}

impl JointGoal for ArmGoal {
    const MODULE: ProcessModule = ProcessModule::Arms;
    const BLOCKED_TIMEOUT: f64 = 0.3;
    const MAX_PLANS: u32 = 4;
    const SEARCHES: bool = true;

    fn what(&self) -> &'static str {
        "moving the arms"
    }

    fn plan(&mut self, world: &World, _: u32) -> Result<JointPlan, MotionFailure> {
        let group = PlanningGroup::new(world, false, &self.sides());
        let goal = self.goal(world, &group)?;
        let contacts = ExpectedContacts::default();
        with_room_for_fingers(world, |leaves_room| {
            // What is to be tilted may be; else it stays upright on the way.
            let level = LevelHands::of(world, &group.joints).level_at(&goal);
            let checker = ConfigurationChecker::new(world, group.joints.clone(), &contacts);
            let checker = match leaves_room {
                true => checker.beside_opening_fingers(world),
                false => checker,
            };
            let mut checker = checker.keeping(level);
            checker.accept_goal(&goal);
            let effort = JointPathEffort::default();
            let trajectory = plan_joint_trajectory(world, &group, &goal, &mut checker, effort)?;
            let none = AllowedPairs::none();
            Ok(JointPlan::new(group.joints.clone(), trajectory, none))
        })
    }

    fn blocked(&self, _: &World, hit: CollisionHit) -> MotionFailure {
        MotionFailure::ArmBlocked { hit: hit.into() }
    }
}
